//! What threads save: the time of a picture on one thread and on several.

use pages::figures::figure;
use serde::Serialize;

use super::bench::Bench;
use super::measure::Outside;
use super::setting::Setting;
use super::times::Times;

/// The time of a picture on a number of threads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ThreadRow {
    /// The number of threads.
    pub threads: usize,
    /// Milliseconds a picture, by the wall clock.
    pub time_ms: Times,
}

/// Returns the numbers of threads to measure on a machine with `available` cores: the powers of two
/// below, and all of them.
pub fn numbers(available: usize) -> Vec<usize> {
    let powers = (0..usize::BITS).map(|n| 1 << n).take_while(|n| *n < available.max(1));
    powers.chain([available.max(1)]).collect()
}

/// Measures the picture in each of `pools`, in `n_rounds` interleaved rounds. `None` if it is
/// stopped. The clock of `outside` has to be a wall clock.
pub fn measure(
    bench: &mut Bench,
    setting: &Setting,
    pools: &[rayon::ThreadPool],
    n_rounds: usize,
    outside: &mut impl Outside,
) -> Option<Vec<ThreadRow>> {
    let mut times_ms = vec![Vec::new(); pools.len()];
    // Warms the caches, and wakes the threads.
    for pool in pools {
        pool.install(|| bench.render(setting));
    }
    for _ in 0..n_rounds {
        for (pool, times) in pools.iter().zip(&mut times_ms) {
            if !outside.goes_on() {
                return None;
            }
            let start = outside.now_s();
            std::hint::black_box(pool.install(|| bench.render(setting)));
            times.push(1e3 * (outside.now_s() - start));
            outside.done(1);
        }
    }
    let row = |(pool, times): (&rayon::ThreadPool, Vec<f64>)| ThreadRow {
        threads: pool.current_num_threads(),
        time_ms: Times::of(&times),
    };
    Some(pools.iter().zip(times_ms).map(row).collect())
}

/// Returns the sentence on the greatest number of threads. `None` for a single row.
pub fn sentence(rows: &[ThreadRow]) -> Option<String> {
    let [one, .., all] = rows else { return None };
    let (ms, one_ms) = (figure(all.time_ms.median), figure(one.time_ms.median));
    let gain = if all.time_ms.is_less_than(&one.time_ms) {
        format!("{} times as fast", figure(one.time_ms.median / all.time_ms.median))
    } else {
        "no faster beyond the spread of the times".to_owned()
    };
    Some(format!(
        "Threads: {} threads take {ms} ms by the wall clock, one takes {one_ms} ms: {gain}.",
        all.threads
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_cores_are_measured_and_powers_of_two_below() {
        assert_eq!(numbers(0), [1]);
        assert_eq!(numbers(1), [1]);
        assert_eq!(numbers(2), [1, 2]);
        assert_eq!(numbers(6), [1, 2, 4, 6]);
        assert_eq!(numbers(8), [1, 2, 4, 8]);
    }

    #[test]
    fn the_gain_is_named_where_the_spreads_are_apart() {
        let row = |threads, ms: &[f64]| ThreadRow { threads, time_ms: Times::of(ms) };
        assert_eq!(sentence(&[row(1, &[8.0])]), None);
        assert_eq!(
            sentence(&[row(1, &[8.0, 9.0, 8.0]), row(2, &[4.0, 4.0, 5.0])]).unwrap(),
            "Threads: 2 threads take 4.00 ms by the wall clock, one takes 8.00 ms: 2.00 times as \
             fast."
        );
        let close = sentence(&[row(1, &[8.0, 9.0, 8.0]), row(2, &[7.0, 8.0])]).unwrap();
        assert!(close.ends_with("no faster beyond the spread of the times."), "{close}");
    }
}
