//! Which points no other one beats.

/// Median, least and greatest of some times.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Times {
    /// The one in the middle, or the mean of the two there.
    pub median: f64,
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
}

impl Times {
    /// Of any times; all 0 for none.
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
}

/// For each (price, error), whether it is on the Pareto front: whether no other point is as good in
/// both and better in one. Of equal points the first is on it. NaN is never on it.
pub fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|n| !points[*n].0.is_nan() && !points[*n].1.is_nan()).collect();
    order.sort_by(|a, b| {
        points[*a]
            .0
            .total_cmp(&points[*b].0)
            .then(points[*a].1.total_cmp(&points[*b].1))
            .then(a.cmp(b))
    });
    let mut is_on = vec![false; points.len()];
    let mut least = f64::INFINITY;
    for n in order {
        if points[n].1 < least {
            least = points[n].1;
            is_on[n] = true;
        }
    }
    is_on
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(points: &[(f64, f64)], expected: &[usize]) {
        let on: Vec<usize> =
            front(points).iter().enumerate().filter(|(_, on)| **on).map(|(n, _)| n).collect();
        assert_eq!(on, expected, "{points:?}");
    }

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        check(&[], &[]);
        check(&[(1.0, 1.0)], &[0]);
        check(&[(1.0, 3.0), (2.0, 2.0), (3.0, 1.0)], &[0, 1, 2]);
        check(&[(1.0, 3.0), (2.0, 4.0), (3.0, 0.0), (4.0, 0.0)], &[0, 2]);
        check(&[(2.0, 2.0), (2.0, 1.0), (1.0, 2.0)], &[1, 2]);
        check(&[(1.0, 1.0), (1.0, 1.0)], &[0]);
        check(&[(f64::NAN, 0.0), (1.0, f64::NAN), (2.0, 5.0)], &[2]);
    }

    #[test]
    fn every_point_is_beaten_or_on_the_front() {
        let mut state = 1u64;
        let mut draw = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 61) as f64
        };
        for _ in 0..200 {
            let points: Vec<(f64, f64)> = (0..12).map(|_| (draw(), draw())).collect();
            let on = front(&points);
            let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1;
            for (n, point) in points.iter().enumerate() {
                let beaten = (0..12).any(|m| m != n && on[m] && beats(points[m], *point));
                let strictly =
                    (0..12).any(|m| m != n && points[m] != *point && beats(points[m], *point));
                assert!(if on[n] { !strictly } else { beaten }, "{n} of {points:?}");
            }
        }
    }

    #[test]
    fn the_median_is_in_the_middle() {
        let times = |median, least, greatest| Times { median, least, greatest };
        assert_eq!(Times::of(&[]), times(0.0, 0.0, 0.0));
        assert_eq!(Times::of(&[3.0]), times(3.0, 3.0, 3.0));
        assert_eq!(Times::of(&[9.0, 1.0, 4.0]), times(4.0, 1.0, 9.0));
        assert_eq!(Times::of(&[9.0, 1.0, 4.0, 2.0]), times(3.0, 1.0, 9.0));
    }
}
