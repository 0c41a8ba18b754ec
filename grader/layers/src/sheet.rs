//! The answer to an image case as a diagnosis needs it: the expected colours, and for each known
//! mistake the pixels that it changes.

use cases::answer::{ImageAnswer, Wrong};
use cases::film::Image;

use super::colour::{self, Colour, apart};

/// Difference in levels between the mistaken and the right colour from which a pixel counts. The
/// answer file rounds mistaken colours by up to 4 levels, so fainter changes cannot be recognised.
pub const STRONG: i16 = 12;

/// Levels by which a pixel may differ from a mistaken colour and still count as that colour.
pub(crate) const LIKE: i16 = 5;

/// The expected picture of a case with its envelope, and the layers of all mistakes that change it.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The id of the case.
    pub id: String,
    /// The number of columns.
    pub width: usize,
    /// The expected colours, row by row from the top.
    pub expected: Vec<Colour>,
    /// The least level of each channel of each pixel.
    pub lo: Vec<Colour>,
    /// The greatest level of each channel of each pixel.
    pub hi: Vec<Colour>,
    /// Levels by which a channel may lie beyond the envelope.
    pub slack: i16,
    /// Largest cluster and largest count of out pixels with which a picture passes.
    pub allowed: (u32, u32),
    /// The layers, ordered by the ids of their mistakes.
    pub layers: Vec<Layer>,
}

/// The pixels that a mistake changes in a picture.
#[derive(Clone, Debug)]
pub struct Layer {
    /// The id of the mistake.
    pub id: String,
    /// Indices of the pixels, ascending.
    pub pixels: Vec<u32>,
    /// The mistaken colour of each of the pixels.
    pub colours: Vec<Colour>,
    /// Whether the mistaken colour of each of the pixels differs by [`STRONG`] levels or more.
    pub is_strong: Vec<bool>,
}

impl Sheet {
    /// Returns the sheet of the case `id`. Mistakes without a changed pixel get no layer.
    pub fn new(id: &str, answer: &ImageAnswer, mistakes: &[Wrong]) -> Self {
        let expected: Vec<Colour> =
            answer.expected.pixels().iter().map(|light| colour::of_light(*light)).collect();
        let mut layers: Vec<Layer> = mistakes
            .iter()
            .filter(|wrong| !wrong.pixels.is_empty())
            .map(|wrong| {
                let colours = wrong.colours.iter().map(|levels| colour::signed(*levels)).collect();
                Layer::new(&wrong.id, wrong.pixels.clone(), colours, &expected)
            })
            .collect();
        layers.sort_by(|a, b| a.id.cmp(&b.id));
        Self {
            id: id.to_owned(),
            width: answer.expected.width() as usize,
            lo: answer.lo.iter().map(|levels| colour::signed(*levels)).collect(),
            hi: answer.hi.iter().map(|levels| colour::signed(*levels)).collect(),
            slack: answer.limits.slack as i16,
            allowed: (answer.limits.cluster, answer.limits.count),
            expected,
            layers,
        }
    }

    /// Returns the layer of a mistake, or `None` if the mistake changes nothing here.
    pub fn layer(&self, id: &str) -> Option<&Layer> {
        let at = self.layers.binary_search_by(|layer| layer.id.as_str().cmp(id)).ok()?;
        Some(&self.layers[at])
    }

    /// Returns, for each pixel of a picture of the same size, whether a mistake of `by` explains
    /// its colour. A pixel that a mistake of `except` changes counts as not explained.
    pub fn explained(&self, actual: &Image, by: &[&str], except: &[&str]) -> Vec<bool> {
        let mut explained = vec![false; self.expected.len()];
        for layer in by.iter().filter_map(|id| self.layer(id)) {
            for (n, mistaken) in layer.pixels.iter().zip(&layer.colours) {
                let seen = actual.pixels().get(*n as usize).map(|one| colour::of_light(*one));
                explained[*n as usize] |= seen.is_some_and(|seen| apart(seen, *mistaken) <= LIKE);
            }
        }
        for layer in except.iter().filter_map(|id| self.layer(id)) {
            layer.pixels.iter().for_each(|n| explained[*n as usize] = false);
        }
        explained
    }

    /// Returns whether `seen` lies outside the envelope of pixel `n` by more than the slack.
    pub fn is_out(&self, n: usize, seen: Colour) -> bool {
        (0..3).any(|at| (self.lo[n][at] - seen[at]).max(seen[at] - self.hi[n][at]) > self.slack)
    }

    /// Returns the number of out pixels of a picture.
    pub fn n_out(&self, seen: &[Colour]) -> usize {
        seen.iter().enumerate().filter(|(n, one)| self.is_out(*n, **one)).count()
    }

    /// Returns the sheet of pictures whose levels pass through `curve`, which maps each channel.
    /// The envelope becomes a level wider on both sides, because the curve rounds.
    pub fn through(&self, curve: impl Fn(Colour) -> Colour) -> Self {
        let expected: Vec<Colour> = self.expected.iter().map(|one| curve(*one)).collect();
        let ends = |at: usize| (curve(self.lo[at]), curve(self.hi[at]));
        let bound = |pick: fn(i16, i16) -> i16, wider: i16| {
            let channels = |(a, b): (Colour, Colour)| [0, 1, 2].map(|c| pick(a[c], b[c]) + wider);
            (0..self.lo.len()).map(|at| channels(ends(at))).collect()
        };
        let layers = self.layers.iter().map(|layer| {
            let colours = layer.colours.iter().map(|one| curve(*one)).collect();
            Layer::new(&layer.id, layer.pixels.clone(), colours, &expected)
        });
        Self {
            id: self.id.clone(),
            lo: bound(i16::min, -1),
            hi: bound(i16::max, 1),
            layers: layers.collect(),
            expected,
            ..*self
        }
    }
}

impl Layer {
    fn new(id: &str, pixels: Vec<u32>, colours: Vec<Colour>, expected: &[Colour]) -> Self {
        let is_strong = pixels
            .iter()
            .zip(&colours)
            .map(|(n, mistaken)| apart(*mistaken, expected[*n as usize]) >= STRONG)
            .collect();
        Self { id: id.to_owned(), pixels, colours, is_strong }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use cases::glam::DVec3;

    use super::*;

    /// Returns a sheet of greys in rows of `width`, with the greys that each mistake gives; 0 means
    /// no change.
    pub(crate) fn sheet(id: &str, width: u32, right: &[u8], mistakes: &[(&str, &[u8])]) -> Sheet {
        let light =
            |i: u32, j: u32| DVec3::splat(f64::from(right[(j * width + i) as usize]) / 255.0);
        let expected = Image::from_fn(width, right.len() as u32 / width, light);
        let wrong: Vec<Wrong> = mistakes
            .iter()
            .map(|(id, greys)| {
                Wrong::new(id, greys.iter().map(|grey| (*grey > 0).then_some([*grey; 3])))
            })
            .collect();
        Sheet::new(id, &ImageAnswer::exact(expected, 1.0, 0), &wrong)
    }

    #[test]
    fn a_layer_holds_what_a_mistake_changes_and_how_strongly() {
        let sheet = sheet("a", 4, &[100; 4], &[("b", &[0, 40, 0, 104]), ("a", &[0; 4])]);
        assert_eq!(sheet.layers.len(), 1);
        let layer = sheet.layer("b").unwrap();
        assert_eq!((&layer.pixels, &layer.is_strong), (&vec![1, 3], &vec![true, false]));
        assert_eq!(layer.colours, [[40; 3], [104; 3]]);
        assert!(sheet.layer("a").is_none() && sheet.layer("c").is_none());
    }

    #[test]
    fn what_a_mistake_explains_has_its_colour_where_no_other_shows() {
        let layers: [(&str, &[u8]); 2] = [("m", &[40, 40, 40, 0]), ("o", &[0, 0, 80, 80])];
        let sheet = sheet("a", 4, &[100; 4], &layers);
        let seen = [45, 46, 40, 40];
        let actual = Image::from_fn(4, 1, |i, _| DVec3::splat(f64::from(seen[i as usize]) / 255.0));
        assert_eq!(sheet.explained(&actual, &["m"], &[]), [true, false, true, false]);
        assert_eq!(sheet.explained(&actual, &["m"], &["o"]), [true, false, false, false]);
        assert_eq!(sheet.explained(&actual, &["x"], &[]), [false; 4]);
    }

    #[test]
    fn a_curve_moves_the_answer_and_the_layers() {
        let sheet = sheet("a", 2, &[100, 200], &[("b", &[0, 40])]);
        assert!(sheet.is_out(0, [98; 3]) && !sheet.is_out(0, [99; 3]));
        let darker = sheet.through(|colour| colour.map(|level| level / 2));
        assert_eq!(darker.expected, [[50; 3], [100; 3]]);
        assert_eq!(darker.layer("b").unwrap().colours, [[20; 3]]);
        assert!(darker.is_out(0, [47; 3]) && !darker.is_out(0, [48; 3]));
        assert_eq!((sheet.n_out(&[[100; 3]; 2]), darker.n_out(&[[100; 3]; 2])), (1, 1));
    }
}
