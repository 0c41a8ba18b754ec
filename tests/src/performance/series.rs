//! Statistics over rounds: medians, ratios, and the exponent by which a cost grows.

use cases::maths::ln;

/// Returns the median of `values`, which is the mean of the middle two if their number is even. NaN
/// for no values.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => (sorted[n / 2 - 1] + sorted[n / 2]) / 2.0,
    }
}

/// Returns the factor by which we are faster than a peer, from seconds. If we cast fewer rays than
/// the peer, the factor is multiplied by the ratio of the rays, because work that is left out is no
/// speed. `rays` holds our number and the peer's, if both are known.
pub fn times_as_fast(ours_s: f64, peer_s: f64, rays: Option<(u64, u64)>) -> f64 {
    let share = rays.map_or(1.0, |(ours, peer)| ours as f64 / peer as f64);
    peer_s / ours_s * share.min(1.0)
}

/// Returns the exponent p for which y ~ x^p fits the points (x, y) best, by least squares of
/// logarithms. NaN for fewer than two points.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (ln(*x), ln(*y))).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let slope = |of: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>();
    slope(&|p| (p.0 - x) * (p.1 - y)) / slope(&|p| (p.0 - x) * (p.0 - x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_the_middle() {
        for (values, middle) in
            [(&[3.0, 1.0, 2.0][..], 2.0), (&[4.0, 1.0, 2.0, 3.0], 2.5), (&[7.0], 7.0)]
        {
            assert_eq!(median(values), middle);
        }
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn rays_that_are_not_cast_are_no_speed() {
        assert_eq!(times_as_fast(1.0, 8.0, None), 8.0);
        assert_eq!(times_as_fast(1.0, 8.0, Some((50, 100))), 4.0);
        assert_eq!(
            times_as_fast(1.0, 8.0, Some((200, 100))),
            8.0,
            "more rays than the peer's are our loss"
        );
    }

    #[test]
    fn exponents_are_those_of_powers() {
        for p in [0.0, 0.5, 1.0, 2.0] {
            let points: Vec<(f64, f64)> =
                [1.0, 10.0, 100.0].map(|x| (x, 3.0 * cases::maths::pow(x, p))).to_vec();
            assert!((exponent(&points) - p).abs() < 1e-12, "{p}");
        }
        assert!(exponent(&[(1.0, 1.0)]).is_nan());
    }
}
