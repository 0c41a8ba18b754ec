//! Computes points, in integer thousandths. This module sees verdicts and shares, never pixels.

use crate::record::{Score, Verdict};

/// Returns the score of a check with this verdict that is worth `points`.
///
/// `Partial` earns `share` thousandths of the points, but no more than all, rounded down. `Ours`
/// earns 0 of 0, so that it costs nothing.
pub fn score(verdict: Verdict, share: u32, points: u64) -> Score {
    match verdict {
        Verdict::Pass => Score { earned: points, possible: points },
        Verdict::Partial => {
            Score { earned: points * u64::from(share.min(1000)) / 1000, possible: points }
        }
        Verdict::Fail | Verdict::NotRun => Score { earned: 0, possible: points },
        Verdict::Ours => Score::default(),
    }
}

/// Splits `points` over `n` checks as evenly as thousandths allow: the first ones get one more
/// each. The list is empty if `n` is 0.
pub fn split(points: u64, n: usize) -> Vec<u64> {
    let n = n as u64;
    (0..n).map(|at| points / n + u64::from(at < points % n)).collect()
}

/// Returns the sum of the scores.
pub fn total(scores: impl IntoIterator<Item = Score>) -> Score {
    scores.into_iter().fold(Score::default(), |sum, one| Score {
        earned: sum.earned + one.earned,
        possible: sum.possible + one.possible,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_in_splitting() {
        assert_eq!(split(10, 4), [3, 3, 2, 2]);
        assert_eq!(split(9000, 7).iter().sum::<u64>(), 9000);
        assert_eq!(split(9000, 0), [0; 0]);
    }

    #[test]
    fn our_fault_costs_nothing() {
        let ours = score(Verdict::Ours, 0, 2000);
        let sum = total([score(Verdict::Pass, 0, 2000), ours, score(Verdict::NotRun, 0, 1000)]);
        assert_eq!(sum, Score { earned: 2000, possible: 3000 });
    }

    #[test]
    fn a_part_is_rounded_down_and_never_more_than_all() {
        for (share, points, earned) in
            [(900, 2000, 1800), (1, 2000, 2), (1, 999, 0), (333, 1000, 333), (5000, 70, 70)]
        {
            assert_eq!(
                score(Verdict::Partial, share, points),
                Score { earned, possible: points },
                "{share}"
            );
        }
        assert_eq!(score(Verdict::Fail, 900, 2000).earned, 0);
    }
}
