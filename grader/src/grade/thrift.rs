//! Limits the machine time of one submission: earlier runs may shorten later ones, or cause them to
//! be left out.
//!
//! The rules consider the runs in the order of the plan, not in the order in which they ended, so
//! that the number of jobs changes no verdict. A run that began before the rules were known for it
//! is corrected afterwards.

use std::time::Duration;

use crate::exercise::N_TIMEOUTS;

/// The time that a run took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// The index of the stage in the plan, for a picture. It is `None` for unit checks, which count
    /// their own time-outs.
    pub(super) stage: Option<usize>,
    pub(super) idle: Duration,
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
    Nothing,
}

/// Returns the share for a run of `stage` after the runs `before`, which precede it in the plan.
///
/// Some of the earlier runs may be missing, because more of them never give a run more time.
/// `most_idle` is the limit for the idle time of all runs together.
pub(super) fn share<'a>(
    before: impl Iterator<Item = &'a Taken>,
    stage: Option<usize>,
    most_idle: Duration,
) -> Share {
    let (mut idle, mut n_timeouts) = (Duration::ZERO, 0);
    for taken in before {
        idle += taken.idle;
        n_timeouts += usize::from(taken.is_timeout && stage.is_some() && taken.stage == stage);
    }
    match () {
        () if idle >= most_idle => Share::Nothing,
        () if n_timeouts >= N_TIMEOUTS => Share::Reduced,
        () => Share::Whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the share after some runs, each given as stage, idle seconds, and whether it timed
    /// out.
    fn check(before: &[(Option<usize>, u64, bool)], stage: Option<usize>, expected: Share) {
        let taken = |(stage, idle, is_timeout): &(Option<usize>, u64, bool)| Taken {
            stage: *stage,
            idle: Duration::from_secs(*idle),
            is_timeout: *is_timeout,
        };
        let all: Vec<Taken> = before.iter().map(taken).collect();
        assert_eq!(
            share(all.iter(), stage, Duration::from_secs(60)),
            expected,
            "{before:?}, then {stage:?}"
        );
    }

    #[test]
    fn time_outs_count_within_a_stage_and_idle_time_counts_everywhere() {
        let (two, three) = (Some(2), Some(3));
        check(&[], two, Share::Whole);
        check(&[(two, 0, true), (two, 0, false)], two, Share::Whole);
        check(&[(two, 0, true), (two, 0, true)], two, Share::Reduced);
        check(&[(two, 0, true), (two, 0, true)], three, Share::Whole);
        check(&[(two, 0, true), (two, 0, true)], None, Share::Whole);
        check(&[(None, 0, true), (None, 0, true)], None, Share::Whole);
        check(&[(two, 30, false), (None, 29, false)], three, Share::Whole);
        check(&[(two, 30, false), (None, 30, false)], three, Share::Nothing);
        check(&[(two, 60, true), (two, 60, true)], two, Share::Nothing);
    }
}
