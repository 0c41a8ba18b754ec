//! Finds the film mistakes of all pictures in order, and undoes them.

use super::super::sheet::Sheet;
use super::curve::Curve;
use super::frame::Frame;
use super::kind::{FilmMistake, Kind};
use super::moves::Move;
use super::{find_move, rows, wrap};

/// The pictures without their film mistakes.
pub struct Undone<'a> {
    /// The pictures.
    pub frames: Vec<Frame<'a>>,
    /// The sheets of the frames behind a curve, if there is one.
    pub curved: Option<Vec<Sheet>>,
    /// The move that was undone.
    pub moved: Option<Move>,
    /// The mistakes that were undone, in order.
    pub mistakes: Vec<FilmMistake>,
}

/// Finds and undoes film mistakes: missing rows, then a move, then either levels that wrap or a
/// curve.
pub fn undo(frames: Vec<Frame<'_>>) -> Undone<'_> {
    let mut undone = Undone { frames, curved: None, moved: None, mistakes: vec![] };
    if let Some(n_rows) = rows::missing(&undone.frames) {
        undone.change(Kind::RowsMissing(n_rows), |frame| {
            frame.end = frame.seen.len().saturating_sub(n_rows * frame.sheet.width);
        });
    }
    undone.moved = find_move::find(&undone.frames);
    if let Some(found) = undone.moved {
        undone.change(Kind::Moved(found), |frame| frame.seen = found.undone(frame));
    }
    if wrap::is_wrapped(&undone.frames) {
        undone.change(Kind::Wrapped, |frame| {
            let wrapped: Vec<usize> = wrap::wrapped(frame).collect();
            wrapped.into_iter().for_each(|n| frame.seen[n] = frame.sheet.expected[n]);
        });
    } else if let Some(curve) = Curve::find(&undone.frames) {
        undone.bend(&curve);
    }
    undone
}

impl Undone<'_> {
    /// Changes all frames, and adds the mistake of this kind with the pixels that become right.
    fn change(&mut self, kind: Kind, change: impl Fn(&mut Frame)) {
        let (mut cases, mut n_out, mut n_explained) = (vec![], 0, 0);
        for frame in &mut self.frames {
            let before = frame.n_out();
            change(frame);
            let better = before.saturating_sub(frame.n_out());
            if better > 0 {
                cases.push((frame.sheet.id.clone(), better));
            }
            n_out += before;
            n_explained += better;
        }
        let share = n_explained as f64 / n_out.max(1) as f64;
        self.mistakes.push(FilmMistake { kind, cases, share });
    }

    /// Adds a curve and the sheets behind it.
    fn bend(&mut self, curve: &Curve) {
        let (mut cases, mut n_wrong, mut n_explained) = (vec![], 0, 0);
        for frame in &self.frames {
            let (explained, wrong) = curve.explained(frame);
            if explained > 0 {
                cases.push((frame.sheet.id.clone(), explained));
            }
            n_wrong += wrong;
            n_explained += explained;
        }
        let share = n_explained as f64 / n_wrong.max(1) as f64;
        let kind = Kind::Curve(curve.of([128; 3]));
        self.mistakes.push(FilmMistake { kind, cases, share });
        let through = |frame: &Frame| frame.sheet.through(|colour| curve.of(colour));
        self.curved = Some(self.frames.iter().map(through).collect());
    }
}
