//! Moves of pixels or channels, which a program makes in writing its picture.

use super::super::colour::Colour;
use super::frame::Frame;

/// A move, by which each pixel of the right picture stands in another place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// The rows are in reverse order. The number is added to the row, because a picture whose rays
    /// go through corners is off by one row.
    UpsideDown(isize),
    /// The columns are in reverse order.
    Mirrored,
    /// Rows and columns are in reverse order.
    Turned,
    /// Everything stands this number of columns to the right and of rows below.
    Shifted(isize, isize),
    /// Red, green and blue are these channels of the right picture.
    Channels([usize; 3]),
    /// The pixels are written column by column.
    Exchanged,
}

/// All moves that are tried.
pub(crate) fn all() -> Vec<Move> {
    let mut all = vec![Move::Mirrored, Move::Turned, Move::Exchanged];
    all.extend([0, -1, 1].map(Move::UpsideDown));
    let near = [-1, 0, 1];
    let shifts = near.iter().flat_map(|i| near.map(|j| (*i, j))).filter(|shift| *shift != (0, 0));
    all.extend(shifts.map(|(i, j)| Move::Shifted(i, j)));
    let orders = [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    all.extend(orders.map(Move::Channels));
    all
}

impl Move {
    /// Returns the index of the place where pixel `n` of the right picture stands in the program's
    /// picture of this size; `None` if that place lies outside.
    pub fn place(self, n: usize, width: usize, height: usize) -> Option<usize> {
        let (i, j) = ((n % width) as isize, (n / width) as isize);
        let (w, h) = (width as isize, height as isize);
        let (column, row) = match self {
            Self::UpsideDown(offset) => (i, h - 1 - j + offset),
            Self::Mirrored => (w - 1 - i, j),
            Self::Turned => (w - 1 - i, h - 1 - j),
            Self::Shifted(right, down) => (i + right, j + down),
            Self::Channels(_) => (i, j),
            Self::Exchanged => return Some((i * h + j) as usize),
        };
        let is_inside = (0..w).contains(&column) && (0..h).contains(&row);
        is_inside.then_some((row * w + column) as usize)
    }

    /// Returns the picture of `frame` without the move. Pixels that it moves out of the picture get
    /// their right colour.
    pub fn undone(self, frame: &Frame) -> Vec<Colour> {
        let (width, height) = (frame.sheet.width, frame.height());
        let colour = |n: usize| match self.place(n, width, height) {
            Some(place) => self.channels(frame.seen[place]),
            None => frame.sheet.expected[n],
        };
        (0..frame.seen.len()).map(colour).collect()
    }

    /// Returns a colour with its channels in the right order.
    fn channels(self, seen: Colour) -> Colour {
        let Self::Channels(order) = self else { return seen };
        let mut colour = seen;
        for (at, channel) in order.into_iter().enumerate() {
            colour[channel] = seen[at];
        }
        colour
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::sheet::tests::sheet;
    use super::*;

    #[test]
    fn a_move_is_undone() {
        let right: Vec<u8> = (1..=6).map(|n| n * 20).collect();
        let sheet = sheet("a", 3, &right, &[]);
        let table: [(Move, [i16; 6]); 6] = [
            (Move::UpsideDown(0), [80, 100, 120, 20, 40, 60]),
            (Move::Mirrored, [60, 40, 20, 120, 100, 80]),
            (Move::Turned, [120, 100, 80, 60, 40, 20]),
            (Move::Exchanged, [20, 80, 40, 100, 60, 120]),
            (Move::Shifted(1, 0), [0, 20, 40, 0, 80, 100]),
            (Move::UpsideDown(1), [0, 0, 0, 80, 100, 120]),
        ];
        for (one, seen) in table {
            let seen = seen.map(|level| [level; 3]).to_vec();
            let undone = one.undone(&Frame { sheet: &sheet, end: 6, seen });
            assert_eq!(undone, sheet.expected, "{one:?}");
        }
        let seen = vec![[9, 7, 8]; 6];
        let undone = Move::Channels([2, 0, 1]).undone(&Frame { sheet: &sheet, end: 6, seen });
        assert_eq!(undone[0], [7, 8, 9]);
    }

    #[test]
    fn every_move_is_tried_once() {
        let all = all();
        assert_eq!(all.len(), 19);
        assert!((1..all.len()).all(|n| !all[..n].contains(&all[n])));
    }
}
