//! Finds the move that puts most pixels right.

use rayon::prelude::*;

use super::frame::Frame;
use super::moves::{self, Move};

/// The share of all pixels that must be out before a move is looked for.
const OUT: f64 = 0.02;
/// The share of the out pixels that a move may leave.
const LEFT: f64 = 0.5;
/// The share of the wrong pictures that a move must improve.
const IMPROVED: f64 = 0.6;
/// The number of wrong pictures that are needed.
const FEW: usize = 3;
/// The number of pictures on which all moves are tried.
const SAMPLE: usize = 10;

/// Returns the move that leaves the fewest out pixels, if it leaves less than half of them.
pub(crate) fn find(frames: &[Frame]) -> Option<Move> {
    let before: Vec<usize> = frames.par_iter().map(Frame::n_out).collect();
    let n_pixels: usize = frames.iter().map(|frame| frame.end).sum();
    let (n_out, n_wrong) =
        (before.iter().sum::<usize>(), before.iter().filter(|n| **n > 0).count());
    if n_wrong < FEW || (n_out as f64) < OUT * n_pixels as f64 {
        return None;
    }
    let step = frames.len().div_ceil(SAMPLE);
    let sample: Vec<&Frame> = frames.iter().step_by(step).collect();
    let n_left = |one: &Move| sample.iter().map(|frame| left(*one, frame)).sum::<usize>();
    let tried: Vec<(usize, Move)> =
        moves::all().into_par_iter().map(|one| (n_left(&one), one)).collect();
    let (_, best) = tried.into_iter().min_by_key(|(n_left, _)| *n_left)?;
    let after: Vec<usize> = frames.par_iter().map(|frame| left(best, frame)).collect();
    let n_improved = before.iter().zip(&after).filter(|(before, after)| after < before).count();
    let is_found = (after.iter().sum::<usize>() as f64) < LEFT * n_out as f64
        && n_improved as f64 > IMPROVED * n_wrong as f64;
    is_found.then_some(best)
}

/// Returns the number of out pixels without the move.
fn left(one: Move, frame: &Frame) -> usize {
    frame.sheet.n_out(&one.undone(frame)[..frame.end])
}

#[cfg(test)]
mod tests {
    use super::super::frame::tests::{frames, sheets};
    use super::*;

    #[test]
    fn a_move_of_all_pictures_is_found() {
        let sheets = sheets();
        let found = |place: &dyn Fn(usize, usize) -> usize| {
            find(&frames(&sheets, |right, i, j| right[place(i, j).min(255)]))
        };
        assert_eq!(found(&|i, j| j * 16 + i), None, "nothing is out");
        assert_eq!(found(&|i, j| j * 16 + 15 - i), Some(Move::Mirrored));
        assert_eq!(found(&|i, j| (15 - j) * 16 + i), Some(Move::UpsideDown(0)));
        assert_eq!(found(&|i, j| i * 16 + j), Some(Move::Exchanged));
        assert_eq!(found(&|i, j| j * 16 + i + 1), Some(Move::Shifted(-1, 0)));
        assert_eq!(found(&|i, j| (i * 7 + j * 5) % 256), None, "nonsense");
    }

    #[test]
    fn a_move_of_a_few_pictures_is_not_named() {
        let sheets = sheets();
        let mirrored = frames(&sheets, |right, i, j| right[j * 16 + 15 - i]);
        assert_eq!(find(&mirrored[..2]), None);
    }
}
