//! A picture beside its sheet.

use super::super::colour::{self, Colour};
use super::super::sheet::Sheet;
use cases::film::Image;

/// A program's picture of a case.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// The answer.
    pub sheet: &'a Sheet,
    /// The picture, row by row from the top.
    pub seen: Vec<Colour>,
    /// The pixels from this index on are not written.
    pub end: usize,
}

impl<'a> Frame<'a> {
    /// Returns the picture beside its sheet, or `None` if their sizes differ.
    pub fn new(sheet: &'a Sheet, actual: &Image) -> Option<Self> {
        let seen = colour::colours(actual);
        let is_alike = seen.len() == sheet.expected.len() && actual.width() as usize == sheet.width;
        is_alike.then_some(Self { sheet, end: seen.len(), seen })
    }

    /// Returns whether the picture has one colour all over, so that it is no evidence.
    pub fn is_mute(&self) -> bool {
        self.seen.iter().all(|one| *one == self.seen[0])
    }

    /// Returns the number of rows.
    pub fn height(&self) -> usize {
        self.seen.len() / self.sheet.width.max(1)
    }

    /// Returns the indices of the out pixels that are written.
    pub fn out(&self) -> impl Iterator<Item = usize> {
        (0..self.end).filter(|n| self.sheet.is_out(*n, self.seen[*n]))
    }

    /// Returns the number of out pixels that are written.
    pub fn n_out(&self) -> usize {
        self.out().count()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::super::sheet::tests::sheet;
    use super::*;

    /// The width and the height of [`sheets`].
    pub(crate) const SIDE: u32 = 16;

    /// Returns the sheets of four pictures with different greys at all pixels of a row or column.
    pub(crate) fn sheets() -> Vec<Sheet> {
        let grey = |case: u32, i: u32, j: u32| {
            u8::try_from(40 + 11 * i + 2 * j * (case + 1) % 37).unwrap()
        };
        let greys = |case: u32| -> Vec<u8> {
            (0..SIDE * SIDE).map(|n| grey(case, n % SIDE, n / SIDE)).collect()
        };
        (0..4).map(|case| sheet(&format!("case {case}"), SIDE, &greys(case), &[])).collect()
    }

    /// Returns frames of the sheets with the colours that `seen` gives, from the expected colours,
    /// the column and the row.
    pub(crate) fn frames<'a>(
        sheets: &'a [Sheet],
        seen: impl Fn(&[Colour], usize, usize) -> Colour,
    ) -> Vec<Frame<'a>> {
        let side = SIDE as usize;
        let frame = |sheet: &'a Sheet| {
            let seen = (0..side * side).map(|n| seen(&sheet.expected, n % side, n / side));
            Frame { sheet, seen: seen.collect(), end: side * side }
        };
        sheets.iter().map(frame).collect()
    }

    #[test]
    fn a_frame_needs_a_picture_of_the_right_size() {
        let sheets = sheets();
        let light = |_: u32, _: u32| cases::glam::DVec3::ONE;
        assert!(Frame::new(&sheets[0], &Image::from_fn(SIDE, SIDE, light)).unwrap().is_mute());
        assert!(Frame::new(&sheets[0], &Image::from_fn(SIDE / 2, SIDE * 2, light)).is_none());
        let right = frames(&sheets, |right, i, j| right[j * 16 + i]);
        assert_eq!((right[0].n_out(), right[0].is_mute(), right[0].height()), (0, false, 16));
    }
}
