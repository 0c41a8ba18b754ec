//! The median and the range of several times.

/// The median, the least and the greatest of several times.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Times {
    /// The time in the middle, or the mean of the two in the middle.
    pub median: f64,
    /// The least time.
    pub least: f64,
    /// The greatest time.
    pub greatest: f64,
}

impl Times {
    /// Returns the summary of `times`, in any order and unit. All three are 0 for an empty slice.
    pub fn of(times: &[f64]) -> Self {
        let mut times = times.to_vec();
        times.sort_by(f64::total_cmp);
        let (Some(least), Some(greatest)) = (times.first(), times.last()) else {
            return Self::default();
        };
        let half = times.len() / 2;
        let median =
            if times.len() % 2 == 1 { times[half] } else { (times[half - 1] + times[half]) / 2.0 };
        Self { median, least: *least, greatest: *greatest }
    }

    /// Returns whether each of these times is less than each of `other`. Where the spreads overlap,
    /// neither counts as faster.
    pub fn is_less_than(&self, other: &Self) -> bool {
        self.greatest < other.least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        let times = |median, least, greatest| Times { median, least, greatest };
        assert_eq!(Times::of(&[]), times(0.0, 0.0, 0.0));
        assert_eq!(Times::of(&[3.0]), times(3.0, 3.0, 3.0));
        assert_eq!(Times::of(&[9.0, 1.0, 4.0]), times(4.0, 1.0, 9.0));
        assert_eq!(Times::of(&[9.0, 1.0, 4.0, 2.0]), times(3.0, 1.0, 9.0));
    }

    #[test]
    fn times_that_overlap_have_no_winner() {
        let (fast, slow) = (Times::of(&[1.0, 2.0]), Times::of(&[3.0, 4.0]));
        assert!(fast.is_less_than(&slow) && !slow.is_less_than(&fast));
        let middle = Times::of(&[2.0, 3.0]);
        assert!(!fast.is_less_than(&middle) && !middle.is_less_than(&slow));
    }
}
