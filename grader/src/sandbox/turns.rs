//! Turns of programs: many of them run side by side, or one runs alone.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// The way in which a program runs beside the others of this grader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The program runs side by side with others.
    Shared,
    /// The program runs once all others have ended, and none begins until it ends.
    Alone,
}

static FLOOR: RwLock<()> = RwLock::new(());
static N_RUNNING: AtomicUsize = AtomicUsize::new(0);
static N_BEGUN: AtomicUsize = AtomicUsize::new(0);

/// The right to run a program. It is given back when this is dropped.
pub(super) struct Taken {
    _guard: Guard,
    /// Number of programs that had begun when this one did, itself included.
    n_begun: usize,
    had_overlap: bool,
}

/// The lock behind a turn. It is never read: the turn lasts as long as it is held.
enum Guard {
    Shared { _lock: RwLockReadGuard<'static, ()> },
    Alone { _lock: RwLockWriteGuard<'static, ()> },
}

impl Taken {
    /// Waits for the turn.
    pub(super) fn wait(turn: Turn) -> Self {
        let guard = match turn {
            Turn::Shared => {
                Guard::Shared { _lock: FLOOR.read().unwrap_or_else(PoisonError::into_inner) }
            }
            Turn::Alone => {
                Guard::Alone { _lock: FLOOR.write().unwrap_or_else(PoisonError::into_inner) }
            }
        };
        let n_begun = N_BEGUN.fetch_add(1, Ordering::Relaxed) + 1;
        let had_overlap = N_RUNNING.fetch_add(1, Ordering::Relaxed) > 0;
        Self { _guard: guard, n_begun, had_overlap }
    }

    /// Returns whether another program of this grader has run during the turn.
    pub(super) fn has_overlap(&self) -> bool {
        self.had_overlap || N_BEGUN.load(Ordering::Relaxed) != self.n_begun
    }

    /// Returns whether no other program of this grader can run during the turn.
    pub(super) fn is_alone(&self) -> bool {
        matches!(self._guard, Guard::Alone { .. })
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        N_RUNNING.fetch_sub(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_alone_has_no_company_and_a_shared_one_may() {
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for turn in [Turn::Shared, Turn::Alone].repeat(20) {
                        let taken = Taken::wait(turn);
                        std::thread::yield_now();
                        assert!(turn == Turn::Shared || !taken.has_overlap());
                        assert_eq!(taken.is_alone(), turn == Turn::Alone);
                    }
                });
            }
        });
        let one = Taken::wait(Turn::Shared);
        let other = Taken::wait(Turn::Shared);
        assert!(one.has_overlap() && other.has_overlap(), "either of two that overlap has company");
    }
}
