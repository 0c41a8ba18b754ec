//! The surroundings of what a mistake explains. A mistake explains a region only if the error ends
//! where the region ends.

use super::sheet::Layer;
use super::shot::Shot;

/// The width of the ring, in pixels.
const WIDTH: usize = 2;
/// Number of ring pixels below which the ring shows nothing.
const FEW: usize = 10;
/// The part of a wrong pixel that counts if a named mistake changes it too.
const TOUCHED: f64 = 0.3;

/// Returns the share of wrong pixels around `hits`, 0 to 1.
///
/// Pixels that the mistake changes, and pixels that named mistakes explain, are left out. A pixel
/// is wrong here if it is out by at least half of the median error of the hits.
pub fn wrong_share(shot: &Shot, layer: &Layer, hits: &[u32]) -> f64 {
    if hits.is_empty() {
        return 0.0;
    }
    let mut ring = around(hits, shot.sheet.width, shot.seen.len());
    layer.pixels.iter().for_each(|n| ring[*n as usize] = false);
    let mut errors: Vec<i16> = hits.iter().map(|n| shot.off[*n as usize]).collect();
    let middle = errors.len() / 2;
    let median = *errors.select_nth_unstable(middle).1;
    let (mut n_ring, mut wrong) = (0, 0.0);
    for n in (0..ring.len()).filter(|n| ring[*n] && !shot.marks.explained[*n]) {
        n_ring += 1;
        if shot.out[n] && 2 * shot.off[n] >= median {
            wrong += if shot.marks.touched[n] { TOUCHED } else { 1.0 };
        }
    }
    if n_ring < FEW { 0.0 } else { wrong / n_ring as f64 }
}

/// Returns, for each of `n` pixels in rows of `width`, whether it lies at most `WIDTH` columns
/// and rows from a hit.
pub fn around(hits: &[u32], width: usize, n: usize) -> Vec<bool> {
    let mut mask = vec![false; n];
    hits.iter().for_each(|at| mask[*at as usize] = true);
    for row in mask.chunks_mut(width.max(1)) {
        widen(row, 1, row.len());
    }
    for column in 0..width.min(n) {
        let height = n / width;
        widen(&mut mask[column..], width, height);
    }
    mask
}

/// Widens what is set in a line of `n` pixels, `step` apart, by `WIDTH` at both ends.
fn widen(line: &mut [bool], step: usize, n: usize) {
    let set: Vec<bool> = (0..n).map(|at| line[at * step]).collect();
    for at in 0..n {
        let near = at.saturating_sub(WIDTH)..=(at + WIDTH).min(n - 1);
        line[at * step] = set[near].contains(&true);
    }
}

#[cfg(test)]
mod tests {
    use super::super::sheet::tests::sheet;
    use super::*;

    #[test]
    fn a_ring_is_two_pixels_wide() {
        let mask = around(&[0, 13], 7, 42);
        let set: Vec<usize> = (0..42).filter(|n| mask[*n]).collect();
        let rows = [0..=2, 4..=6, 7..=9, 11..=13, 14..=16, 18..=20, 25..=27];
        assert_eq!(set, rows.into_iter().flatten().collect::<Vec<usize>>());
    }

    /// Returns the share for a mistake that gives 40 in the middle column of three, where the
    /// picture shows `side` in the others.
    fn share(side: i16, is_named: bool) -> f64 {
        let middle = [0, 40, 0].repeat(8);
        let sides = [40, 0, 40].repeat(8);
        let layers: [(&str, &[u8]); 2] = [("m", &middle), ("o", &sides)];
        let sheet = sheet("a", 3, &[100; 24], &layers);
        let seen = [[side; 3], [40; 3], [side; 3]].repeat(8);
        let mut shot = Shot::new(&sheet, seen, 24);
        let (_, hits) = shot.count(&sheet.layers[0]);
        if is_named {
            shot.mark(&sheet.layers[1], &[]);
        }
        wrong_share(&shot, &sheet.layers[0], &hits)
    }

    #[test]
    fn what_is_wrong_around_the_region_counts_if_it_is_about_as_wrong() {
        assert_eq!(share(100, false), 0.0);
        assert_eq!(share(75, false), 0.0);
        assert_eq!(share(70, false), 1.0);
        assert!((share(70, true) - TOUCHED).abs() < 1e-9);
    }
}
