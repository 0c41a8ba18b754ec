//! A curve through which all levels pass: gamma, tone mapping, exposure, fewer bits.

use rayon::prelude::*;

use super::super::colour::{Colour, apart};
use super::frame::Frame;

/// The share of all pixels that must be out before a curve is looked for.
const OUT: f64 = 0.3;
/// The share of the wrong pixels that the curve must explain, and the share of the pictures in
/// which it must do so.
const EXPLAINED: f64 = 0.5;
const PICTURES: f64 = 0.6;
/// The number of pictures that are needed.
const FEW: usize = 3;
/// Levels by which a pixel may differ from the curve.
const NEAR: i16 = 2;
/// The mean difference in levels of a channel from which a curve is no rounding.
const BENT: f64 = 1.5;
/// The number of pixels of a level from which its median counts.
const ENOUGH: u32 = 50;

/// The level that each level of each channel becomes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve([Vec<i16>; 3]);

impl Curve {
    /// Returns the curve of these pictures, or `None` if there is none or too little is wrong.
    pub(crate) fn find(frames: &[Frame]) -> Option<Self> {
        let n_out: usize = frames.par_iter().map(Frame::n_out).sum();
        let n_pixels: usize = frames.iter().map(|frame| frame.end).sum();
        if frames.len() < FEW || (n_out as f64) < OUT * n_pixels as f64 {
            return None;
        }
        let channels: Vec<(Vec<i16>, f64)> =
            (0..3).into_par_iter().map(|channel| medians(frames, channel)).collect();
        if channels.iter().all(|(_, bend)| *bend < BENT) {
            return None;
        }
        let channels: Vec<Vec<i16>> = channels.into_iter().map(|(levels, _)| levels).collect();
        let curve = Self(channels.try_into().ok()?);
        let counts: Vec<(usize, usize)> =
            frames.par_iter().map(|frame| curve.explained(frame)).collect();
        let (n_explained, n_wrong) =
            counts.iter().fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        let is_explained = |(explained, wrong): &&(usize, usize)| {
            *explained as f64 > EXPLAINED * (*wrong).max(1) as f64
        };
        let n_pictures = counts.iter().filter(is_explained).count();
        let is_found = n_explained as f64 > EXPLAINED * n_wrong as f64
            && n_pictures as f64 > PICTURES * frames.len() as f64;
        is_found.then_some(curve)
    }

    /// Returns the colour that the curve makes of a right colour.
    pub(crate) fn of(&self, colour: Colour) -> Colour {
        [0, 1, 2].map(|at| self.0[at][colour[at].clamp(0, 255) as usize])
    }

    /// Returns the numbers of wrong pixels that the curve explains, and of all wrong ones.
    pub(crate) fn explained(&self, frame: &Frame) -> (usize, usize) {
        let (mut n_explained, mut n_wrong) = (0, 0);
        for (seen, right) in frame.seen.iter().zip(&frame.sheet.expected).take(frame.end) {
            if apart(*seen, *right) > 1 {
                n_wrong += 1;
                n_explained += usize::from(apart(*seen, self.of(*right)) <= NEAR);
            }
        }
        (n_explained, n_wrong)
    }
}

/// Returns, for each right level of a channel, the median of the levels that the pictures show
/// there, and the mean difference of both over all pixels. Rare levels are interpolated.
fn medians(frames: &[Frame], channel: usize) -> (Vec<i16>, f64) {
    let mut counts = vec![[0u32; 256]; 256];
    for frame in frames {
        let pixels = frame.seen.iter().zip(&frame.sheet.expected).take(frame.end);
        for (seen, right) in pixels.filter(|(seen, _)| seen[channel] >= 0) {
            counts[right[channel] as usize][seen[channel] as usize] += 1;
        }
    }
    let sums: Vec<u32> = counts.iter().map(|row| row.iter().sum()).collect();
    let known: Vec<(usize, i16)> = (0..256)
        .filter(|level| sums[*level] >= ENOUGH)
        .map(|level| (level, median(&counts[level], sums[level])))
        .collect();
    let bend: f64 = known
        .iter()
        .map(|(level, median)| f64::from(sums[*level]) * (f64::from(*median) - *level as f64).abs())
        .sum();
    let n: u32 = known.iter().map(|(level, _)| sums[*level]).sum();
    ((0..256).map(|level| interpolated(&known, level)).collect(), bend / f64::from(n.max(1)))
}

/// Returns the lower median of `n` levels with these counts.
fn median(counts: &[u32; 256], n: u32) -> i16 {
    let mut below = 0;
    let is_reached = |count: &u32| {
        below += count;
        2 * below >= n
    };
    counts.iter().position(is_reached).unwrap_or(0) as i16
}

/// Returns the value at `level` of the line through known points, ordered by level. It is constant
/// beyond the first and the last one, and `level` itself if there are none.
fn interpolated(known: &[(usize, i16)], level: usize) -> i16 {
    let at = known.partition_point(|(one, _)| *one < level);
    match (at.checked_sub(1).map(|at| known[at]), known.get(at)) {
        (None, None) => level as i16,
        (None, Some(&(_, value))) | (Some((_, value)), None) => value,
        (Some((low, below)), Some(&(high, above))) => {
            let share = (level - low) as f64 / (high - low) as f64;
            (f64::from(below) + share * f64::from(above - below)).round() as i16
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::sheet::tests::sheet;
    use super::super::frame::tests::{SIDE, frames};
    use super::*;

    #[test]
    fn a_curve_of_all_levels_is_found() {
        // Eight greys from 40 to 180, each on enough pixels.
        let greys: Vec<u8> = (0..16 * 16).map(|n| 40 + 20 * (n % 16 / 2) as u8).collect();
        let sheets: Vec<_> = (0..4).map(|n| sheet(&n.to_string(), SIDE, &greys, &[])).collect();
        let find = |curve: &dyn Fn(i16, usize) -> i16| {
            Curve::find(&frames(&sheets, |right, i, j| {
                right[j * 16 + i].map(|level| curve(level, i * 31 + j * 17))
            }))
        };
        let dark = find(&|level, _| level * 4 / 5).unwrap();
        assert_eq!(dark.of([110, 255, 0]), [88, 144, 32]);
        assert!(find(&|level, _| level + 4).is_some());
        assert_eq!(find(&|level, _| level), None);
        assert_eq!(find(&|level, _| level + 1), None, "rounding");
        assert_eq!(find(&|level, n| (level + n as i16 * 37) % 256), None, "noise");
    }

    #[test]
    fn rare_levels_are_interpolated() {
        let known = [(10, 20), (20, 40)];
        assert_eq!([0, 10, 15, 20, 200].map(|n| interpolated(&known, n)), [20, 20, 30, 40, 40]);
        assert_eq!(interpolated(&[], 7), 7);
    }
}
