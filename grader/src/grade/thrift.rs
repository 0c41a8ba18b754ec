//! Limits the machine time of one submission: earlier runs may shorten later ones, or cause them to
//! be left out.
//!
//! The time of a run is its CPU time plus the time in which it was idle. That is its wall time on a
//! machine with one free core, whatever else this machine does.
//!
//! The rules consider the runs in the order of the plan, not in the order in which they ended, so
//! that the number of jobs changes no verdict. A run that began before the rules were known for it
//! is corrected afterwards.

use std::time::Duration;

use crate::exercise::{Allowance, N_TIMEOUTS};

/// The time that a run took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// The index of the stage in the plan.
    pub(super) stage: usize,
    /// CPU time and idle time. That of a second run does not count: the program did its task.
    pub(super) time: Duration,
    /// Idle time.
    pub(super) idle: Duration,
    /// Whether a picture timed out. Unit checks count their own time-outs.
    pub(super) is_timeout: bool,
}

/// The share of the time limit that a run gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Share {
    /// All that the course allows.
    Whole,
    /// Less time, because other pictures of its stage timed out.
    Reduced,
    /// Nothing: the submission has been idle for too long.
    Idle,
    /// Nothing: the time of its stage is over.
    OutOfTime,
}

impl Share {
    /// Returns whether the run is left out.
    pub(super) fn is_nothing(self) -> bool {
        matches!(self, Self::Idle | Self::OutOfTime)
    }
}

/// Returns the share for a run of the stage with index `stage`, of `n_stages`, after the runs
/// `before`, which precede it in the plan.
///
/// A stage may use the time that earlier stages have left, divided by the number of stages that
/// remain. No stage can therefore take the time of another.
///
/// Some of the earlier runs may be missing, because more of them never give a run more time.
pub(super) fn share<'a>(
    before: impl Iterator<Item = &'a Taken>,
    (stage, n_stages): (usize, usize),
    allowance: &Allowance,
) -> Share {
    let (mut idle, mut n_timeouts) = (Duration::ZERO, 0);
    let (mut earlier, mut own) = (Duration::ZERO, Duration::ZERO);
    for taken in before {
        idle += taken.idle;
        match taken.stage.cmp(&stage) {
            std::cmp::Ordering::Less => earlier += taken.time,
            std::cmp::Ordering::Equal => {
                own += taken.time;
                n_timeouts += usize::from(taken.is_timeout);
            }
            std::cmp::Ordering::Greater => {}
        }
    }
    let n_left = n_stages.saturating_sub(stage).max(1) as u32;
    let most = allowance.whole.saturating_sub(earlier) / n_left;
    match () {
        () if idle >= allowance.most_idle() => Share::Idle,
        () if own >= most => Share::OutOfTime,
        () if n_timeouts >= N_TIMEOUTS => Share::Reduced,
        () => Share::Whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six stages share 600 s; a submission may be idle for 60 s.
    fn check(before: &[Taken], stage: usize, expected: Share) {
        let allowance = Allowance { whole: Duration::from_secs(600), ..Allowance::default() };
        assert_eq!(allowance.most_idle(), Duration::from_secs(60));
        let found = share(before.iter(), (stage, 6), &allowance);
        assert_eq!(found, expected, "{before:?}, then {stage}");
    }

    fn idle(stage: usize, seconds: u64, is_timeout: bool) -> Taken {
        Taken { stage, idle: Duration::from_secs(seconds), is_timeout, ..Taken::default() }
    }

    fn busy(stage: usize, seconds: u64) -> Taken {
        Taken { stage, time: Duration::from_secs(seconds), ..Taken::default() }
    }

    #[test]
    fn time_outs_count_within_a_stage_and_idle_time_counts_everywhere() {
        check(&[], 2, Share::Whole);
        check(&[idle(2, 0, true), idle(2, 0, false)], 2, Share::Whole);
        check(&[idle(2, 0, true), idle(2, 0, true)], 2, Share::Reduced);
        check(&[idle(2, 0, true), idle(2, 0, true)], 3, Share::Whole);
        check(&[idle(2, 30, false), idle(0, 29, false)], 3, Share::Whole);
        check(&[idle(2, 30, false), idle(0, 30, false)], 3, Share::Idle);
        check(&[idle(2, 60, true), idle(2, 60, true)], 2, Share::Idle);
    }

    #[test]
    fn no_stage_takes_the_time_of_another() {
        check(&[busy(0, 99)], 0, Share::Whole);
        check(&[busy(0, 100)], 0, Share::OutOfTime);
        check(&[busy(0, 100)], 1, Share::Whole);
        check(&[busy(0, 100), busy(1, 100)], 1, Share::OutOfTime);
        // The last run of a stage may exceed its share by its own limit.
        check(&[busy(0, 110), busy(1, 97)], 1, Share::Whole);
        check(&[busy(0, 110), busy(1, 98)], 1, Share::OutOfTime);
        // What a stage leaves goes to those behind it.
        check(&[busy(0, 10), busy(1, 117)], 1, Share::Whole);
        check(&[busy(5, 500)], 0, Share::Whole);
        check(&[busy(5, 599)], 5, Share::Whole);
        check(&[busy(5, 600)], 5, Share::OutOfTime);
    }
}
