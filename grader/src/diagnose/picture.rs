//! How much of what is wrong with a picture each known mistake explains.

use std::collections::BTreeMap;

use cases::answer::{ImageAnswer, Levels, Wrong, neighbours};
use cases::film::{Image, byte, level};

/// A colour may lie this many levels beyond those around it: what the file rounds away, and the quantiser.
const NEAR: f64 = 6.0;

/// For each mistake the share of the pixels that are out, or would be with the mistake, which show what the mistake shows. 0 to 1.
///
/// A pixel shows what the mistake shows where it has about its colour, or lies between its neighbours there: edges fall a pixel to one
/// side or the other.
///
/// # Panics
/// Where the sizes differ.
pub fn picture(actual: &Image, answer: &ImageAnswer, mistakes: &[Wrong]) -> BTreeMap<String, f64> {
    let seen = Seen { actual, out: answer.out(actual) };
    mistakes.iter().map(|mistake| (mistake.id.clone(), share(&seen, answer, mistake))).collect()
}

/// The student's picture.
struct Seen<'a> {
    actual: &'a Image,
    out: Vec<bool>,
}

fn share(seen: &Seen, answer: &ImageAnswer, mistake: &Wrong) -> f64 {
    assert_eq!(seen.out.len(), mistake.changes.len(), "pictures of one size");
    let expected = answer.expected.pixels();
    let levels = |n: usize| mistake.changes[n].unwrap_or_else(|| expected[n].to_array().map(byte));
    let mistaken: Vec<Levels> = (0..expected.len()).map(levels).collect();
    let (mut n_explained, mut n_all) = (0u32, 0u32);
    for (n, colour) in seen.actual.pixels().iter().enumerate() {
        if !seen.out[n] && mistake.changes[n].is_none() {
            continue;
        }
        let width = seen.actual.width() as usize;
        let is_alike = mistake.explains(n, *colour) || is_between(colour.to_array().map(level), &mistaken, width, n);
        n_explained += u32::from(is_alike && seen.out[n]);
        n_all += u32::from(!is_alike || seen.out[n]);
    }
    f64::from(n_explained) / f64::from(n_all.max(1))
}

/// Whether each channel lies between the least and the most of the 3 × 3 pixels around.
fn is_between(levels: [f64; 3], mistaken: &[Levels], width: usize, n: usize) -> bool {
    let (mut lo, mut hi) = (mistaken[n], mistaken[n]);
    for one in neighbours(n, width, mistaken.len()) {
        for at in 0..3 {
            (lo[at], hi[at]) = (lo[at].min(mistaken[one][at]), hi[at].max(mistaken[one][at]));
        }
    }
    (0..3).all(|at| (f64::from(lo[at]) - NEAR..=f64::from(hi[at]) + NEAR).contains(&levels[at])) // false for NaN
}
