//! What the mistakes that are named so far do to a picture.

use super::colour::{self, Colour, apart};
use super::sheet::{Layer, Sheet};

/// The smallest level that a factor is taken of. Below it, rounding spoils the factor.
const DARK: i16 = 4;

/// For each pixel of a picture, whether and how named mistakes change it.
#[derive(Clone, Debug)]
pub struct Marks {
    /// Whether a named mistake explains the pixel.
    pub explained: Vec<bool>,
    /// Whether a named mistake changes the pixel, if alone.
    pub touched: Vec<bool>,
    /// The sum of the changes that the named mistakes make, in levels.
    sums: Vec<Colour>,
    /// The product of the factors by which the named mistakes change each channel.
    products: Vec<[f32; 3]>,
    /// The distance of the pixel from the nearest colour that named mistakes give; from the right
    /// colour if none changes it.
    pub off: Vec<i16>,
}

impl Marks {
    /// Returns marks of no mistake. `off` is the distance of each pixel from its right colour.
    pub fn none(off: &[i16]) -> Self {
        let n = off.len();
        Self {
            explained: vec![false; n],
            touched: vec![false; n],
            sums: vec![[0; 3]; n],
            products: vec![[1.0; 3]; n],
            off: off.to_vec(),
        }
    }

    /// Adds the mistake of `layer`, which explains the pixels `hits` of the picture `seen`.
    pub fn add(&mut self, sheet: &Sheet, seen: &[Colour], layer: &Layer, hits: &[u32]) {
        hits.iter().for_each(|n| self.explained[*n as usize] = true);
        for (n, mistaken) in layer.pixels.iter().zip(&layer.colours) {
            let n = *n as usize;
            let right = sheet.expected[n];
            self.touched[n] = true;
            self.sums[n] = colour::sum(self.sums[n], colour::difference(*mistaken, right));
            for at in 0..3 {
                self.products[n][at] *= f32::from(mistaken[at]) / f32::from(right[at].max(DARK));
            }
            let both = colour::clamped(colour::sum(right, self.sums[n]));
            let nearest = apart(seen[n], *mistaken).min(apart(seen[n], both));
            self.off[n] = self.off[n].min(nearest);
        }
    }

    /// Returns the distance of `seen` from the colour that the named mistakes and a further one,
    /// which alone gives `mistaken`, give pixel `n` together: their changes added, or multiplied.
    /// `None` if it is more than `most`.
    pub fn off_with(&self, n: usize, seen: Colour, mistaken: Colour, most: i16) -> Option<i16> {
        let off_in = |at: usize| {
            let added = (mistaken[at] + self.sums[n][at]).clamp(0, 255);
            let multiplied = colour::scaled(mistaken[at], self.products[n][at]);
            [seen[at] - added, seen[at] - multiplied].map(i16::abs)
        };
        // Most pixels are far off in the first channel already.
        let first = off_in(0);
        if first[0].min(first[1]) > most {
            return None;
        }
        let (second, third) = (off_in(1), off_in(2));
        let greatest = |way: usize| first[way].max(second[way]).max(third[way]);
        Some(greatest(0).min(greatest(1))).filter(|off| *off <= most)
    }
}

#[cfg(test)]
mod tests {
    use super::super::sheet::tests::sheet;
    use super::*;

    #[test]
    fn two_mistakes_at_one_pixel_give_the_sum_or_the_product_of_their_changes() {
        let sheet = sheet("a", 2, &[100, 100], &[("half", &[50, 0]), ("darker", &[80, 80])]);
        let seen = [[30; 3], [80; 3]];
        let mut marks = Marks::none(&[70, 20]);
        assert_eq!(marks.off_with(0, [80; 3], [80; 3], 9), Some(0));
        marks.add(&sheet, &seen, sheet.layer("half").unwrap(), &[]);
        assert_eq!((marks.touched.clone(), &marks.off), (vec![true, false], &vec![20, 20]));
        // Added: 100 − 50 − 20. Multiplied: 100 · 0.5 · 0.8.
        assert_eq!(marks.off_with(0, [30; 3], [80; 3], 9), Some(0));
        assert_eq!(marks.off_with(0, [40; 3], [80; 3], 9), Some(0));
        assert_eq!(marks.off_with(0, [50; 3], [80; 3], 10), Some(10));
        assert_eq!(marks.off_with(0, [50; 3], [80; 3], 9), None);
        assert_eq!(marks.off_with(0, [40, 40, 70], [80; 3], 9), None);
        marks.add(&sheet, &seen, sheet.layer("darker").unwrap(), &[1]);
        assert_eq!((marks.explained, marks.off), (vec![false, true], vec![0, 0]));
    }
}
