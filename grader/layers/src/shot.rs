//! A program's picture of a case beside its sheet.

use super::colour::{Colour, apart};
use super::counts::Counts;
use super::marks::Marks;
use super::sheet::{LIKE, Layer, Sheet};

/// Levels by which a pixel may differ from the colour of two mistakes together, whose stored
/// colours are rounded twice.
const LIKE_BOTH: i16 = 9;

/// A picture, the pixels of it that are wrong, and what the named mistakes do to it.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// The answer.
    pub sheet: &'a Sheet,
    /// The picture, row by row from the top.
    pub seen: Vec<Colour>,
    /// Whether each pixel is out.
    pub out: Vec<bool>,
    /// The distance of each pixel from its right colour.
    pub off: Vec<i16>,
    /// The pixels from this index on are not written, and are no evidence.
    end: usize,
    /// What the named mistakes do to the picture.
    pub marks: Marks,
}

impl<'a> Shot<'a> {
    /// Returns the picture `seen`, of which the pixels from `end` on are not written. Its size is
    /// that of the sheet.
    pub fn new(sheet: &'a Sheet, seen: Vec<Colour>, end: usize) -> Self {
        let is_out = |(n, one): (usize, &Colour)| n < end && sheet.is_out(n, *one);
        let out = seen.iter().enumerate().map(is_out).collect();
        let off: Vec<i16> =
            seen.iter().zip(&sheet.expected).map(|(one, right)| apart(*one, *right)).collect();
        Self { sheet, out, marks: Marks::none(&off), off, seen, end }
    }

    /// Forgets all named mistakes.
    pub fn clear(&mut self) {
        self.marks = Marks::none(&self.off);
    }

    /// Marks the mistake of a layer as named. It explains the pixels `hits`.
    pub fn mark(&mut self, layer: &Layer, hits: &[u32]) {
        self.marks.add(self.sheet, &self.seen, layer, hits);
    }

    /// Returns the counts for and against the mistake of a layer beside the named ones, and the
    /// indices of the pixels that it explains. Only strong pixels are counted.
    pub fn count(&self, layer: &Layer) -> (Counts, Vec<u32>) {
        let mut counts = Counts::default();
        let mut hits = vec![];
        for (at, pixel) in layer.pixels.iter().enumerate() {
            let n = *pixel as usize;
            if n >= self.end {
                break;
            }
            let one = u32::from(layer.is_strong[at]);
            if !self.out[n] {
                counts.right += one;
                continue;
            }
            let distance = apart(self.seen[n], layer.colours[at]);
            if self.marks.explained[n] {
                counts.other += one * u32::from(distance > LIKE);
            } else if self.is_hit(n, layer.colours[at], distance) {
                counts.hits += one;
                hits.push(*pixel);
            } else if self.marks.touched[n] {
                counts.mixed += one;
            } else {
                counts.open += one;
            }
        }
        (counts, hits)
    }

    /// Returns whether out pixel `n` has the colour `mistaken`, at this distance, or the colour
    /// that the mistake and the named ones give together. That colour must be clearly nearer than
    /// the one without the mistake.
    fn is_hit(&self, n: usize, mistaken: Colour, distance: i16) -> bool {
        let is_nearer = |distance: i16, other: i16| 5 * distance < 3 * other;
        if distance <= LIKE && is_nearer(distance, self.off[n]) {
            return true;
        }
        if !self.marks.touched[n] {
            return false;
        }
        let both = self.marks.off_with(n, self.seen[n], mistaken, LIKE_BOTH);
        both.is_some_and(|both| is_nearer(both, self.marks.off[n]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::sheet::tests::sheet;
    use super::*;

    fn greys(levels: &[i16]) -> Vec<Colour> {
        levels.iter().map(|level| [*level; 3]).collect()
    }

    #[test]
    fn pixels_count_by_what_they_show() {
        let sheet = sheet("a", 6, &[100; 6], &[("m", &[40, 40, 40, 104, 40, 0])]);
        let seen = greys(&[44, 100, 160, 104, 70, 160]);
        let shot = Shot::new(&sheet, seen.clone(), 6);
        let (counts, hits) = shot.count(&sheet.layers[0]);
        // The fourth pixel is changed too faintly to count, and the last one is not changed.
        assert_eq!(counts, Counts { hits: 1, right: 1, open: 2, ..Counts::default() });
        assert_eq!(hits, [0, 3]);
        let (counts, hits) = Shot::new(&sheet, seen, 1).count(&sheet.layers[0]);
        assert_eq!((counts.all(), hits), (1, vec![0]), "unwritten pixels are no evidence");
    }

    #[test]
    fn a_pixel_that_a_named_mistake_explains_speaks_against_other_colours() {
        let layers: [(&str, &[u8]); 2] = [("m", &[40, 40, 40]), ("o", &[42, 80, 160])];
        let sheet = sheet("a", 3, &[100; 3], &layers);
        let mut shot = Shot::new(&sheet, greys(&[40, 40, 100]), 3);
        let (_, hits) = shot.count(&sheet.layers[0]);
        shot.mark(&sheet.layers[0], &hits);
        let (counts, hits) = shot.count(&sheet.layers[1]);
        assert_eq!((counts, hits.len()), (Counts { right: 1, other: 1, ..Counts::default() }, 0));
        shot.clear();
        assert_eq!(shot.count(&sheet.layers[1]).0.open, 1);
    }

    #[test]
    fn two_mistakes_at_one_pixel_are_recognised_by_their_sum() {
        let layers: [(&str, &[u8]); 2] = [("m", &[60, 60]), ("o", &[70, 70])];
        let sheet = sheet("a", 2, &[100; 2], &layers);
        let mut shot = Shot::new(&sheet, greys(&[30, 5]), 2);
        assert_eq!(shot.count(&sheet.layers[1]).0.open, 2);
        shot.mark(&sheet.layers[0], &[]);
        let (counts, hits) = shot.count(&sheet.layers[1]);
        assert_eq!((counts.hits, counts.mixed, hits), (1, 1, vec![0]));
    }
}
