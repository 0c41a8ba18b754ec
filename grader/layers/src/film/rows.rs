//! The last rows of all pictures are missing: a loop ends too early.

use std::collections::BTreeMap;

use super::super::colour::{Colour, apart};
use super::frame::Frame;

/// Levels by which a right pixel may differ from the colour of missing rows and still not show that
/// a row is missing.
const NEAR: i16 = 2;
/// The number of pictures that are needed.
const FEW: usize = 3;
/// The share of the pictures that have at least the missing rows, and of those that have just
/// these.
const AT_LEAST: f64 = 0.9;
const JUST: f64 = 0.6;

/// Returns the number of last rows that all pictures lack: they have one colour there, where the
/// right pictures have several. `None` if there are none, or too few pictures, or if rows above
/// have that colour too, so that no loop ends too early.
pub(crate) fn missing(frames: &[Frame]) -> Option<usize> {
    let frames = frames.iter().filter(|frame| is_varied(frame));
    let (ends, elsewhere): (Vec<usize>, Vec<bool>) =
        frames.map(|frame| (flat_rows(frame), is_flat_above(frame))).unzip();
    let n_elsewhere = elsewhere.iter().filter(|is_flat| **is_flat).count();
    if ends.len() < FEW || n_elsewhere as f64 > (1.0 - AT_LEAST) * ends.len() as f64 {
        return None;
    }
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    ends.iter().filter(|n| **n > 0).for_each(|n| *counts.entry(*n).or_default() += 1);
    let (n_rows, n_just) = counts.into_iter().max_by_key(|(_, count)| *count)?;
    let n_at_least = ends.iter().filter(|n| **n >= n_rows).count();
    let share = |n: usize| n as f64 / ends.len() as f64;
    (share(n_at_least) >= AT_LEAST && share(n_just) >= JUST).then_some(n_rows)
}

/// Returns whether the last row of the right picture has more than one colour.
fn is_varied(frame: &Frame) -> bool {
    let last = &frame.sheet.expected[frame.seen.len() - frame.sheet.width..];
    last.iter().any(|one| *one != last[0])
}

/// Returns the number of rows at the end that have the colour of the last pixel all over.
fn flat_rows(frame: &Frame) -> usize {
    let Some(last) = frame.seen.last() else { return 0 };
    let rows = frame.seen.rchunks_exact(frame.sheet.width.max(1));
    rows.take_while(|row| row.iter().all(|one| one == last)).count()
}

/// Returns whether a row above the end has the colour of the last pixel all over, where the right
/// picture has another one.
fn is_flat_above(frame: &Frame) -> bool {
    let Some(last) = frame.seen.last() else { return false };
    let width = frame.sheet.width.max(1);
    let rows = frame.seen.rchunks_exact(width).zip(frame.sheet.expected.rchunks_exact(width));
    let above = rows.skip(flat_rows(frame));
    let is_lacking = |(row, right): (&[Colour], &[Colour])| {
        row.iter().all(|one| one == last) && right.iter().any(|one| apart(*one, *last) > NEAR)
    };
    above.into_iter().any(is_lacking)
}

#[cfg(test)]
mod tests {
    use super::super::frame::tests::{frames, sheets};
    use super::*;

    #[test]
    fn rows_that_all_pictures_lack_are_counted() {
        let sheets = sheets();
        let cut = |n: usize| {
            frames(&sheets, |right, i, j| if j >= 16 - n { [7; 3] } else { right[j * 16 + i] })
        };
        for n in [0, 1, 5] {
            assert_eq!(missing(&cut(n)), (n > 0).then_some(n));
        }
        assert_eq!(missing(&cut(5)[..2]), None, "too few pictures");
        let second =
            frames(&sheets, |right, i, j| if j % 2 == 1 { [7; 3] } else { right[j * 16 + i] });
        assert_eq!(missing(&second), None, "every second row is no end of a loop");
        let different: Vec<Frame> = (0..4).map(|n| cut(n + 1).swap_remove(n)).collect();
        assert_eq!(missing(&different), None, "rows that differ are no end of a loop");
    }
}
