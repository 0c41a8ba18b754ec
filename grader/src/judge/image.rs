//! Pictures: which pixels are out, and whether they are too many.

use cases::answer::ImageAnswer;
use cases::film::{Image, byte};
use cases::glam::DVec3;

use super::Judgement;
use super::numbers::grouped;
use crate::record::{Finding, FindingKind};

/// How two pictures of one size differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Pixels that are out.
    pub n_out: u64,
    /// The pixel farthest out, the first of equals; `None` where none is.
    pub worst: Option<[u32; 2]>,
    /// By how many levels that one differs; infinite where a channel is not finite.
    pub most: f64,
    /// First column and row, last column and row that hold a pixel that is out.
    pub bounds: Option<[u32; 4]>,
}

/// Compares channel by channel in 8-bit levels, clamped but not rounded, with what right tracers give. NaN and infinity are out.
///
/// # Panics
/// Where the sizes differ.
pub fn compare(actual: &Image, answer: &ImageAnswer) -> Difference {
    let expected = &answer.expected;
    assert_eq!((actual.width(), actual.height()), (expected.width(), expected.height()), "pictures of one size");
    let mut difference = Difference { n_out: 0, worst: None, most: 0.0, bounds: None };
    for (n, pixel) in actual.pixels().iter().enumerate() {
        let by = answer.beyond(n, *pixel);
        if by <= answer.limits.slack {
            continue;
        }
        let at = [n as u32 % actual.width(), n as u32 / actual.width()];
        if difference.worst.is_none() || by > difference.most {
            (difference.worst, difference.most) = (Some(at), by);
        }
        difference.n_out += 1;
        let [x0, y0, x1, y1] = difference.bounds.unwrap_or([at[0], at[1], at[0], at[1]]);
        difference.bounds = Some([x0.min(at[0]), y0.min(at[1]), x1.max(at[0]), y1.max(at[1])]);
    }
    difference
}

/// Judges a picture, whose size is right, by its answer: it passes iff no more pixels are out than the answer allows.
pub fn picture(actual: &Image, answer: &ImageAnswer) -> Judgement {
    let difference = compare(actual, answer);
    if difference.n_out <= u64::from(answer.limits.count) {
        return Judgement::PASS;
    }
    let message = describe(actual, &answer.expected, &difference);
    let finding = Finding::new(FindingKind::Wrong, message);
    Judgement::fail(Finding { wrong_pixels: Some(difference.n_out), worst: difference.worst, ..finding })
}

/// How many pixels differ, where, and what the worst of them shows on both sides.
fn describe(actual: &Image, expected: &Image, difference: &Difference) -> String {
    let all = actual.pixels().len() as u64;
    let verb = if difference.n_out == 1 { "pixel of {} differs" } else { "pixels of {} differ" };
    let mut text = format!("{} {}", grouped(difference.n_out), verb.replace("{}", &grouped(all)));
    if let (Some([x0, y0, x1, y1]), Some([x, y])) = (difference.bounds, difference.worst) {
        if difference.n_out < all {
            text += &format!(" (columns {x0} to {x1}, rows {y0} to {y1})");
        }
        let (yours, right) = (shown(actual.pixel(x, y)), shown(expected.pixel(x, y)));
        text += &format!(", most at ({x}, {y}): yours {yours}, expected {right}");
    }
    let first = actual.pixel(0, 0);
    if actual.pixels().iter().all(|pixel| pixel.to_array().map(byte) == first.to_array().map(byte)) {
        text += "; yours is one colour all over";
    }
    text
}

fn shown(colour: DVec3) -> String {
    let channel = |light: f64| if light.is_finite() { byte(light).to_string() } else { light.to_string() };
    colour.to_array().map(channel).join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Verdict;

    /// A grey picture of 10 × 10 in which some pixels are replaced.
    fn grey(changes: &[(u32, u32, DVec3)]) -> Image {
        Image::from_fn(10, 10, |i, j| {
            let change = changes.iter().find(|(x, y, _)| (*x, *y) == (i, j));
            change.map_or(DVec3::splat(0.5), |(_, _, colour)| *colour)
        })
    }

    fn check(changes: &[(u32, u32, DVec3)], out_pixels: u32, expected: Option<&str>) {
        let answer = ImageAnswer::exact(grey(&[]), 2.0, out_pixels);
        let judgement = picture(&grey(changes), &answer);
        let message = judgement.finding.map(|finding| finding.message);
        assert_eq!(message.as_deref(), expected, "{changes:?}");
        assert_eq!(judgement.verdict == Verdict::Pass, expected.is_none());
    }

    #[test]
    fn a_pixel_is_out_beyond_the_tolerance_only() {
        let off = |levels: f64| DVec3::new(0.5, 128.0 / 255.0 + levels / 255.0, 0.5);
        check(&[(1, 2, off(1.99))], 0, None);
        let message = "1 pixel of 100 differs (columns 1 to 1, rows 2 to 2), most at (1, 2): \
                       yours 128 130 128, expected 128 128 128";
        check(&[(1, 2, off(2.01))], 0, Some(message));
        check(&[(1, 2, off(90.0))], 1, None);
    }

    #[test]
    fn what_is_not_finite_is_out_even_where_clamping_would_hide_it() {
        let white = ImageAnswer::exact(Image::from_fn(10, 10, |_, _| DVec3::ONE), 2.0, 99);
        let infinite = Image::from_fn(10, 10, |_, _| DVec3::INFINITY);
        assert_eq!(picture(&infinite, &white).verdict, Verdict::Fail);
        let bright = Image::from_fn(10, 10, |_, _| DVec3::splat(7.0));
        assert_eq!(picture(&bright, &white), Judgement::PASS);
        let message = "2 pixels of 100 differ (columns 0 to 9, rows 0 to 9), most at (0, 0): \
                       yours NaN NaN NaN, expected 128 128 128";
        check(&[(0, 0, DVec3::NAN), (9, 9, DVec3::ZERO)], 0, Some(message));
    }

    #[test]
    fn a_picture_of_one_colour_is_called_so() {
        let black: Vec<(u32, u32, DVec3)> = (0..100).map(|n| (n % 10, n / 10, DVec3::ZERO)).collect();
        let message = "100 pixels of 100 differ, most at (0, 0): yours 0 0 0, expected 128 128 128; \
                       yours is one colour all over";
        check(&black, 0, Some(message));
    }
}
