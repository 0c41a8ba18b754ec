//! The difference between a picture and the pictures of correct tracers: counts over the out
//! pixels.

use cases::answer::{ImageAnswer, largest_cluster};
use cases::film::Image;

/// Counts over the pixels that are out.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The number of pixels that are out.
    pub n_out: u32,
    /// The size of the largest cluster, in which pixels touch by a side or a corner.
    pub cluster: u32,
    /// The number of out pixels that are contested.
    pub n_contested: u32,
    /// The column and row of the pixel farthest out, the first of equal ones. `None` if no pixel is
    /// out.
    pub worst: Option<[u32; 2]>,
    /// The first column and row, and the last column and row, that hold an out pixel. `None` if no
    /// pixel is out.
    pub bounds: Option<[u32; 4]>,
}

/// Compares a picture with its answer, channel by channel in 8-bit levels that are clamped but not
/// rounded. NaN and infinity are out.
///
/// # Panics
/// Panics if the sizes differ.
pub fn compare(actual: &Image, answer: &ImageAnswer) -> Difference {
    let expected = &answer.expected;
    assert_eq!(
        (actual.width(), actual.height()),
        (expected.width(), expected.height()),
        "pictures of one size"
    );
    measure(actual, answer, &answer.out(actual))
}

/// Counts the pixels that are marked in `out`.
pub(super) fn measure(actual: &Image, answer: &ImageAnswer, out: &[bool]) -> Difference {
    let mut difference =
        Difference { n_out: 0, cluster: 0, n_contested: 0, worst: None, bounds: None };
    let mut most = 0.0;
    for n in (0..out.len()).filter(|n| out[*n]) {
        let by = answer.beyond(n, actual.pixels()[n]);
        let [x, y] = [n as u32 % actual.width(), n as u32 / actual.width()];
        if difference.worst.is_none() || by > most {
            (difference.worst, most) = (Some([x, y]), by);
        }
        difference.n_out += 1;
        difference.n_contested += u32::from(answer.is_contested(n));
        let [x0, y0, x1, y1] = difference.bounds.unwrap_or([x, y, x, y]);
        difference.bounds = Some([x0.min(x), y0.min(y), x1.max(x), y1.max(y)]);
    }
    difference.cluster = largest_cluster(out, actual.width());
    difference
}
