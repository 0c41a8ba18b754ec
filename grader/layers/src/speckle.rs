//! The mistake whose pixels depend on rounding: without RAY_EPSILON, some of the rays that leave a
//! surface hit it again. Lit surfaces are then speckled.

use cases::answer::neighbours;

use super::counts::Counts;
use super::ring;
use super::shot::Shot;

/// The id of the mistake.
pub const MISTAKE: &str = "no_epsilon";

/// The part of the hits that must lie beside a right pixel.
const SPECKLED: usize = 2;

/// Returns the counts for and against the mistake, and the pixels that it explains. `None` if the
/// mistake changes nothing in this picture.
///
/// Which pixels of a surface are wrong depends on the rounding of the program. A right pixel near a
/// hit is therefore no evidence. Hits are hits only if at least half of them lie beside a right
/// pixel: a region that is wrong as a whole is no speckle.
pub fn count(shot: &Shot) -> Option<(Counts, Vec<u32>)> {
    let layer = shot.sheet.layer(MISTAKE)?;
    let (mut counts, hits) = shot.count(layer);
    if hits.is_empty() {
        return Some((counts, hits));
    }
    let (width, n_pixels) = (shot.sheet.width, shot.seen.len());
    let is_edge = |n: &&u32| neighbours(**n as usize, width, n_pixels).any(|at| !shot.out[at]);
    if SPECKLED * hits.iter().filter(is_edge).count() < hits.len() {
        counts.open += std::mem::take(&mut counts.hits);
        return Some((counts, vec![]));
    }
    let near = ring::around(&hits, width, n_pixels);
    let changed = layer.pixels.iter().zip(&layer.is_strong).filter(|(_, is_strong)| **is_strong);
    let is_undecided = |n: usize| near[n] && !shot.out[n];
    let n_undecided = changed.filter(|(n, _)| is_undecided(**n as usize)).count() as u32;
    counts.right = counts.right.saturating_sub(n_undecided);
    Some((counts, hits))
}

#[cfg(test)]
mod tests {
    use super::super::sheet::tests::sheet;
    use super::*;

    /// Returns the counts where the mistake would darken all of 16 × 16 pixels, and the picture is
    /// dark where `is_dark`.
    fn check(is_dark: impl Fn(usize, usize) -> bool) -> Counts {
        let sheet = sheet("a", 16, &[100; 256], &[(MISTAKE, &[40; 256])]);
        let seen = (0..256).map(|n| [if is_dark(n % 16, n / 16) { 40 } else { 100 }; 3]).collect();
        count(&Shot::new(&sheet, seen, 256)).unwrap().0
    }

    #[test]
    fn speckles_count_wherever_they_lie_and_whole_regions_do_not() {
        let none = Counts::default();
        assert_eq!(check(|i, j| (i + j) % 2 == 0), Counts { hits: 128, ..none });
        assert_eq!(check(|_, _| false), Counts { right: 256, ..none });
        assert_eq!(check(|i, _| i < 8), Counts { open: 128, right: 128, ..none });
        assert_eq!(check(|i, j| i < 8 && (i + j) % 2 == 0).right, 6 * 16);
    }
}
