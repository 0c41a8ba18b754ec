//! The share of a picture's errors that each known mistake explains.

use std::collections::BTreeMap;

use cases::answer::{ImageAnswer, Levels, Wrong, neighbours};
use cases::film::{Image, byte, level};

/// The levels by which a colour may lie beyond the colours around it, because the answer file and
/// the quantiser round.
const NEAR: f64 = 6.0;

/// Returns, for each mistake, the share of the relevant pixels that look as the mistake makes them
/// look, from 0 to 1. Relevant are pixels that are out, and pixels that the mistake would change.
///
/// A pixel looks like the mistake if it has about the mistaken colour, or lies between the mistaken
/// colours of its neighbours: edges may be a pixel to one side or the other.
///
/// # Panics
/// Panics if the sizes differ.
pub fn picture(actual: &Image, answer: &ImageAnswer, mistakes: &[Wrong]) -> BTreeMap<String, f64> {
    let right = answer.expected.pixels().iter().map(|light| light.to_array().map(byte)).collect();
    let seen = Seen { actual, out: answer.out(actual), right };
    mistakes.iter().map(|mistake| (mistake.id.clone(), share(&seen, mistake))).collect()
}

/// The student's picture and the correct one.
struct Seen<'a> {
    actual: &'a Image,
    out: Vec<bool>,
    right: Vec<Levels>,
}

fn share(seen: &Seen, mistake: &Wrong) -> f64 {
    assert_eq!(seen.out.len(), mistake.changes.len(), "pictures of one size");
    let mistaken: Vec<Levels> =
        mistake.changes.iter().zip(&seen.right).map(|(one, right)| one.unwrap_or(*right)).collect();
    let (mut n_explained, mut n_all) = (0u32, 0u32);
    for (n, colour) in seen.actual.pixels().iter().enumerate() {
        if !seen.out[n] && mistake.changes[n].is_none() {
            continue;
        }
        let width = seen.actual.width() as usize;
        let is_alike = mistake.explains(n, *colour)
            || is_between(colour.to_array().map(level), &mistaken, width, n);
        n_explained += u32::from(is_alike && seen.out[n]);
        n_all += u32::from(!is_alike || seen.out[n]);
    }
    f64::from(n_explained) / f64::from(n_all.max(1))
}

/// Returns whether each channel lies within the range of the 3 × 3 mistaken pixels around `n`,
/// widened by [`NEAR`] levels.
fn is_between(levels: [f64; 3], mistaken: &[Levels], width: usize, n: usize) -> bool {
    let (mut lo, mut hi) = (mistaken[n], mistaken[n]);
    for one in neighbours(n, width, mistaken.len()) {
        for at in 0..3 {
            (lo[at], hi[at]) = (lo[at].min(mistaken[one][at]), hi[at].max(mistaken[one][at]));
        }
    }
    // false for NaN
    (0..3).all(|at| (f64::from(lo[at]) - NEAR..=f64::from(hi[at]) + NEAR).contains(&levels[at]))
}

#[cfg(test)]
mod tests {
    use cases::glam::DVec3;

    use super::*;

    const GREY: u8 = 100;

    /// Returns a picture of one row of greys.
    fn row(levels: &[u8]) -> Image {
        Image::from_fn(levels.len() as u32, 1, |i, _| {
            DVec3::splat(f64::from(levels[i as usize]) / 255.0)
        })
    }

    /// Checks the share of the row that a mistake explains. `mistaken` holds the greys that the
    /// mistake gives where [`GREY`] is correct everywhere; 0 means no change.
    fn check(actual: &[u8], mistaken: &[u8], share: f64) {
        let answer = ImageAnswer::exact(row(&vec![GREY; actual.len()]), 1.0, 0);
        let changes = mistaken.iter().map(|level| (*level > 0).then_some([*level; 3])).collect();
        let wrong = Wrong { id: "a".to_owned(), changes };
        let shares = picture(&row(actual), &answer, &[wrong]);
        assert_eq!(shares, BTreeMap::from([("a".to_owned(), share)]), "{actual:?} {mistaken:?}");
    }

    #[test]
    fn a_picture_is_explained_as_far_as_it_is_wrong_in_the_same_way() {
        check(&[100, 100, 40, 40, 40, 40], &[0, 0, 40, 40, 40, 40], 1.0);
        check(&[100, 100, 46, 46, 46, 46], &[0, 0, 40, 40, 40, 40], 1.0);
        check(&[100, 100, 160, 160, 160, 160], &[0, 0, 40, 40, 40, 40], 0.0);
        check(&[100, 100, 40, 40, 160, 160], &[0, 0, 40, 40, 40, 40], 0.5);
    }

    #[test]
    fn what_the_mistake_would_change_and_is_right_counts_against_it() {
        check(&[40, 40, 100, 100, 100, 100], &[40, 40, 40, 40, 40, 40], 2.0 / 6.0);
        check(&[100; 6], &[40; 6], 0.0);
    }

    #[test]
    fn what_is_wrong_and_the_mistake_would_not_change_counts_against_it() {
        // The third pixel counts as an edge.
        check(&[40, 40, 40, 40, 40, 40, 40, 40], &[40, 40, 0, 0, 0, 0, 0, 0], 3.0 / 8.0);
    }

    #[test]
    fn an_edge_may_fall_a_pixel_to_either_side() {
        check(&[100, 100, 100, 40, 40, 40], &[0, 0, 40, 40, 40, 40], 1.0);
        check(&[100, 40, 40, 40, 40, 40], &[0, 0, 40, 40, 40, 40], 1.0);
    }

    #[test]
    fn what_is_no_number_is_explained_by_nothing() {
        let answer = ImageAnswer::exact(row(&[GREY; 3]), 1.0, 0);
        let wrong = Wrong { id: "a".to_owned(), changes: vec![Some([40; 3]); 3] };
        let nan = Image::from_fn(3, 1, |_, _| DVec3::NAN);
        assert_eq!(picture(&nan, &answer, &[wrong])["a"], 0.0);
        assert!(picture(&nan, &answer, &[]).is_empty());
    }
}
