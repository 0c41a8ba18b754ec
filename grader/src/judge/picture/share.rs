//! The part of its points that a wrong picture earns: for the effect, not for the background.

use cases::answer::ImageAnswer;

/// The maximum for a wrong picture, in thousandths of its points.
pub(super) const MOST: u32 = 900;

/// Returns the thousandths of the points that a picture earns with the pixels `out`, rounded down:
///
/// ```text
/// f = Σ weight of pixels that are in / Σ weight,    (f − f0) / (1 − f0)    from 0 to 0.9
/// ```
///
/// where f0 is the share of a picture without the effect. The result is 0 if no pixel has a weight,
/// or if f0 is NaN or at least 1.
pub fn earned(answer: &ImageAnswer, out: &[bool]) -> u32 {
    let unearned = answer.limits.unearned;
    if unearned.is_nan() || unearned >= 1.0 {
        return 0;
    }
    let share = (answer.share(out) - unearned) / (1.0 - unearned);
    // The tolerance keeps rounding in the divisions from costing a thousandth: a share of 0.3 is
    // 300, not 299.
    ((share * 1000.0 + 1e-6).floor().max(0.0) as u32).min(MOST)
}

#[cfg(test)]
mod tests {
    use cases::answer::Limits;
    use cases::film::Image;
    use cases::glam::DVec3;

    use super::*;

    /// Checks the share for ten pixels of these weights, of which the first `n_out` are out.
    fn check(weight: [u8; 10], unearned: f64, n_out: usize, expected: u32) {
        let answer = ImageAnswer::exact(Image::from_fn(10, 1, |_, _| DVec3::ZERO), 1.0, 0);
        let answer = ImageAnswer {
            weight: weight.to_vec(),
            limits: Limits { unearned, ..answer.limits },
            ..answer
        };
        let out: Vec<bool> = (0..10).map(|n| n < n_out).collect();
        assert_eq!(earned(&answer, &out), expected, "{weight:?}, f0 = {unearned}, {n_out} out");
    }

    #[test]
    fn what_is_right_without_the_effect_earns_nothing() {
        check([255; 10], 0.5, 5, 0);
        check([255; 10], 0.5, 6, 0);
        check([255; 10], 0.5, 4, 200);
        check([255; 10], 0.2, 1, 875);
        check([255; 10], 0.0, 7, 300);
        check([255; 10], 0.3, 10, 0);
    }

    #[test]
    fn at_most_nine_tenths_are_earned() {
        check([255; 10], 0.0, 0, 900);
        check([255; 10], 0.0, 1, 900);
        check([255; 10], 0.0, 2, 800);
    }

    #[test]
    fn the_effect_weighs_and_the_background_does_not() {
        let first = [100, 0, 0, 0, 0, 0, 0, 0, 0, 200];
        check(first, 0.0, 1, 666);
        check(first, 0.0, 9, 666);
        check(first, 0.0, 10, 0);
    }

    #[test]
    fn where_nothing_can_be_earned_nothing_is() {
        check([0; 10], 0.0, 1, 0);
        check([255; 10], 1.0, 0, 0);
        check([255; 10], 2.0, 1, 0);
        check([255; 10], f64::NAN, 1, 0);
    }
}
