//! Runs a list of jobs on several threads, and contains panics.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::Builder;

/// Calls `work` on each item, on up to `jobs` threads, and returns the results in the order of the
/// items.
///
/// Items are started in order. The calling thread works as well, so all work is done even if no
/// thread can be started; 0 jobs count as 1. A panic of `work` affects its own item alone, whose
/// result is then the message of the panic.
pub fn side_by_side<T: Sync, R: Send>(
    jobs: usize,
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
) -> Vec<Result<R, Panicked>> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = vec![];
        while let Some((n, item)) = take(&next, items) {
            done.push((n, guarded(|| work(item))));
        }
        done
    };
    let mut done = std::thread::scope(|scope| {
        let others = jobs.clamp(1, items.len().max(1)) - 1;
        let started: Vec<_> =
            (0..others).map_while(|_| Builder::new().spawn_scoped(scope, worker).ok()).collect();
        let mut done = worker();
        done.extend(
            started
                .into_iter()
                .flat_map(|thread| thread.join().expect("panics are caught one by one")),
        );
        done
    });
    done.sort_by_key(|(n, _)| *n);
    done.into_iter().map(|(_, result)| result).collect()
}

fn take<'a, T>(next: &AtomicUsize, items: &'a [T]) -> Option<(usize, &'a T)> {
    let n = next.fetch_add(1, Ordering::Relaxed);
    items.get(n).map(|item| (n, item))
}

/// A panic of the grader that was caught.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the grader panicked ({0}); this is a fault of the grader")]
pub struct Panicked(String);

/// Calls `work`, and turns a panic in it into an error.
///
/// # Errors
/// Returns the message of the panic.
pub fn guarded<R>(work: impl FnOnce() -> R) -> Result<R, Panicked> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
        Panicked(crate::plain::name(text.unwrap_or("it does not say why").as_bytes()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_whatever_the_number_of_threads() {
        let items: Vec<u64> = (0..40).collect();
        for jobs in [0, 1, 2, 7, 100] {
            let squares = side_by_side(jobs, &items, |n| n * n);
            assert_eq!(squares, items.iter().map(|n| Ok(n * n)).collect::<Vec<_>>(), "{jobs} jobs");
        }
        assert_eq!(side_by_side(3, &[0; 0], |n| *n), []);
    }

    #[test]
    fn a_panic_costs_one_item() {
        for jobs in [1, 3] {
            let results = side_by_side(jobs, &[1, 2, 3], |n| assert!(*n != 2, "two is odd"));
            assert_eq!(results.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false, true]);
            let why = results[1].as_ref().unwrap_err().to_string();
            assert!(why.contains("two is odd") && why.contains("a fault of the grader"), "{why}");
        }
    }
}
