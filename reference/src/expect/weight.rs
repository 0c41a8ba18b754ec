//! Weights of pixels: a case gives points for what the stage's effect changes, not for the
//! background.

use std::collections::BTreeMap;

use cases::answer::ImageAnswer;
use cases::film::{Image, byte, level};
use cases::glam::DVec3;

/// The change in levels from which a pixel has the full weight.
const PLAIN: f64 = 32.0;
/// The weight of all unchanged pixels together, as a share of the weight of the changed ones.
const REST: f64 = 1.0 / 3.0;
/// The weight of a pixel that the effect changes plainly.
const FULL: f64 = u8::MAX as f64;
/// The number of most frequent colours that are tried as pictures of one colour.
const COLOURS: usize = 16;

/// Returns the weight of each pixel from the picture with the effect and the one without. It grows
/// with their difference and is at least 1.
///
/// Where the two do not differ at all, every pixel has the same weight.
pub(super) fn weights(with: &Image, without: &Image) -> Vec<u8> {
    let change = |(a, b): (&DVec3, &DVec3)| {
        let most = (0..3).map(|at| (level(a[at]) - level(b[at])).abs()).fold(0.0, f64::max);
        (most / PLAIN).min(1.0)
    };
    let changes: Vec<f64> = with.pixels().iter().zip(without.pixels()).map(change).collect();
    let mean = changes.iter().sum::<f64>() / changes.len() as f64;
    let least = (FULL * REST * mean).round().max(1.0);
    changes.iter().map(|change| (FULL * change).round().max(least) as u8).collect()
}

/// Returns the greatest share that a picture without the effect earns. It tries the `blanks` that
/// have the case's size, and pictures of one colour.
pub(super) fn unearned<'a>(
    answer: &ImageAnswer,
    blanks: impl IntoIterator<Item = &'a Image>,
) -> f64 {
    let size = (answer.expected.width(), answer.expected.height());
    let fits = |blank: &&Image| (blank.width(), blank.height()) == size;
    let share = |blank: &Image| answer.share(&answer.out(blank));
    let blank = blanks.into_iter().filter(fits).map(share).fold(0.0, f64::max);
    let uniform = colours(answer)
        .into_iter()
        .map(|colour| share(&Image::from_fn(size.0, size.1, |_, _| colour)));
    uniform.fold(blank, f64::max)
}

/// Returns the colours with the greatest total weight in the picture.
fn colours(answer: &ImageAnswer) -> Vec<DVec3> {
    let mut weights: BTreeMap<[u8; 3], u64> = BTreeMap::new();
    for (colour, weight) in answer.expected.pixels().iter().zip(&answer.weight) {
        *weights.entry(colour.to_array().map(byte)).or_default() += u64::from(*weight);
    }
    let mut by_weight: Vec<([u8; 3], u64)> = weights.into_iter().collect();
    by_weight.sort_by_key(|(_, weight)| std::cmp::Reverse(*weight));
    by_weight
        .into_iter()
        .take(COLOURS)
        .map(|(bytes, _)| DVec3::from(bytes.map(f64::from)) / 255.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a black picture whose first `n` of 100 pixels have the level `level`.
    fn lit(n: u32, level: f64) -> Image {
        Image::from_fn(10, 10, |i, j| {
            if j * 10 + i < n { DVec3::splat(level / 255.0) } else { DVec3::ZERO }
        })
    }

    #[test]
    fn what_the_effect_changes_weighs_three_times_the_rest() {
        let weights = weights(&lit(20, 200.0), &lit(0, 0.0));
        assert_eq!((weights[0], weights[99]), (255, 17)); // 255 · 0.2 / 3
        assert_eq!(super::weights(&lit(20, 16.0), &lit(0, 0.0))[0], 128);
        assert_eq!(super::weights(&lit(0, 0.0), &lit(0, 0.0)), [1; 100]);
    }

    #[test]
    fn neither_a_blank_nor_a_colour_earns_anything() {
        let mut answer = ImageAnswer::exact(lit(20, 200.0), 1.0, 0);
        answer.weight = weights(&answer.expected, &lit(0, 0.0));
        let total = 20.0 * 255.0 + 80.0 * 17.0;
        // white all over: the lit part is right
        assert_eq!(unearned(&answer, []), 20.0 * 255.0 / total);
        assert_eq!(unearned(&answer, [&lit(10, 200.0)]), 20.0 * 255.0 / total);
        assert_eq!(unearned(&answer, [&lit(19, 200.0)]), (19.0 * 255.0 + 80.0 * 17.0) / total);
    }
}
