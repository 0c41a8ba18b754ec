//! The stored answer to an image case: the expected picture and its envelope.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Digest;
use super::levels::{Levels, UNIT, byte_plane};
use super::wrong::{self, Wrong};
use crate::film::exr::{self, Part, Plane, plane_name};
use crate::film::{Image, PictureError, byte, level};

/// The answer to an image case, stored as `CASE.answer.exr` beside it. All lists are row by row
/// from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageAnswer {
    /// The expected picture in linear light. The file stores it in whole levels.
    pub expected: Image,
    /// Least levels that a correct tracer gives, rounded down.
    pub lo: Vec<Levels>,
    /// Greatest levels that a correct tracer gives, rounded up.
    pub hi: Vec<Levels>,
    /// Weight of each pixel for partial points: 255 where the stage's effect is plain to see.
    pub weight: Vec<u8>,
    /// Limits on the pixels that may be out.
    pub limits: Limits,
}

/// The limits of a correct picture, and where partial points begin. They belong to the answer, not
/// to the judge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Levels by which a channel may lie beyond the envelope without being out. They allow for the
    /// quantiser.
    pub slack: f64,
    /// Largest cluster of out pixels, corners included, with which a picture passes.
    pub cluster: u32,
    /// Largest count of out pixels with which a picture passes.
    pub count: u32,
    /// Largest cluster that a correct tracer is known to leave: each variation, judged by the
    /// others.
    pub legal_cluster: u32,
    /// Largest count of out pixels that a correct tracer is known to leave.
    pub legal_count: u32,
    /// Weighted share of pixels that are right without the stage's effect. It earns nothing.
    pub unearned: f64,
}

/// The note in the file, as JSON.
#[derive(Serialize, Deserialize)]
struct Notes {
    made_from: Digest,
    #[serde(flatten)]
    limits: Limits,
}

/// Width in levels beyond which the envelope of a pixel makes it contested: correct tracers do not
/// agree on it.
const CONTESTED: u8 = 4;
const ANSWER: &str = "answer";
const WEIGHT: &str = "weight.Y";

impl ImageAnswer {
    /// Returns an answer with no freedom but `slack` levels and `count` out pixels anywhere. All
    /// pixels have the same weight.
    pub fn exact(expected: Image, slack: f64, count: u32) -> Self {
        let round =
            |round: fn(f64) -> f64| expected.pixels().iter().map(|p| levels(*p, round)).collect();
        let (lo, hi) = (round(f64::floor), round(f64::ceil));
        let weight = vec![u8::MAX; expected.pixels().len()];
        let limits = Limits {
            slack,
            cluster: count,
            count,
            legal_cluster: 0,
            legal_count: 0,
            unearned: 1.0,
        };
        Self { expected, lo, hi, weight, limits }
    }

    /// Returns by how many levels `colour` lies beyond the envelope of the pixel with index `n`. It
    /// is the maximum over the channels: 0 within the envelope, infinite if one is not finite.
    pub fn beyond(&self, n: usize, colour: DVec3) -> f64 {
        if !colour.is_finite() {
            return f64::INFINITY;
        }
        let channel = |at: usize| {
            let level = level(colour[at]);
            (f64::from(self.lo[n][at]) - level).max(level - f64::from(self.hi[n][at])).max(0.0)
        };
        channel(0).max(channel(1)).max(channel(2))
    }

    /// Returns whether the pixel with index `n` is out when it has this colour.
    pub fn is_out(&self, n: usize, colour: DVec3) -> bool {
        self.beyond(n, colour) > self.limits.slack
    }

    /// Returns for every pixel of `actual` whether it is out, row by row from the top.
    pub fn out(&self, actual: &Image) -> Vec<bool> {
        actual.pixels().iter().enumerate().map(|(n, colour)| self.is_out(n, *colour)).collect()
    }

    /// Returns whether a picture passes whose largest cluster and count of out pixels are these.
    pub fn allows(&self, cluster: u32, count: u32) -> bool {
        cluster <= self.limits.cluster && count <= self.limits.count
    }

    /// Returns the weighted share of pixels that are not out.
    pub fn share(&self, out: &[bool]) -> f64 {
        let sum = |wanted: fn(&bool) -> bool| -> u64 {
            self.weight
                .iter()
                .zip(out)
                .filter(|(_, out)| wanted(out))
                .map(|(weight, _)| u64::from(*weight))
                .sum()
        };
        sum(|out| !out) as f64 / sum(|_| true).max(1) as f64
    }

    /// Returns whether correct tracers disagree on the pixel with index `n`.
    pub fn is_contested(&self, n: usize) -> bool {
        self.lo[n].iter().zip(self.hi[n]).any(|(lo, hi)| hi.saturating_sub(*lo) > CONTESTED)
    }

    /// Returns the share of contested pixels.
    pub fn contested_share(&self) -> f64 {
        let n = (0..self.lo.len()).filter(|n| self.is_contested(*n)).count();
        n as f64 / self.lo.len() as f64
    }

    /// Returns the bytes to store: an OpenEXR file of the parts `answer` and, unless `wrong` is
    /// empty, `mistakes`. Its note has the limits and `made_from`. Equal arguments give equal
    /// bytes.
    ///
    /// # Errors
    /// A list whose length differs from the picture's, or an error of the encoder.
    pub fn encode(&self, made_from: &Digest, wrong: &[Wrong]) -> Result<Vec<u8>, PictureError> {
        let notes = Notes { made_from: made_from.clone(), limits: self.limits };
        let notes =
            serde_json::to_string(&notes).map_err(|why| PictureError::Broken(why.to_string()))?;
        let expected: Vec<Levels> =
            self.expected.pixels().iter().map(|light| light.to_array().map(byte)).collect();
        let mut planes = Vec::from(layer("", &expected));
        planes.extend(layer("lo", &self.lo));
        planes.extend(layer("hi", &self.hi));
        planes.push(byte_plane(WEIGHT.to_owned(), self.weight.iter().copied()));
        let mut parts = vec![Part { name: ANSWER.to_owned(), planes, attached: Vec::new() }];
        parts.extend(wrong::part(wrong, expected.len())?);
        exr::encode((self.expected.width(), self.expected.height()), &parts, &notes)
    }

    /// Returns the digest that the answer in `bytes` was made from, or `None` for a file without
    /// one. Only the header is read.
    ///
    /// # Errors
    /// The file is broken.
    pub fn made_from(bytes: &[u8]) -> Result<Option<Digest>, PictureError> {
        let notes = exr::notes(bytes)?;
        Ok(serde_json::from_str::<Notes>(&notes).ok().map(|notes| notes.made_from))
    }

    /// Decodes an answer whose size has to be `width` × `height`. The size is checked before
    /// anything is decompressed. The pictures of mistakes stay compressed.
    ///
    /// # Errors
    /// Another size, a missing plane, missing limits, or a broken file.
    pub fn decode(bytes: &[u8], width: u32, height: u32) -> Result<Self, PictureError> {
        let (part, notes) = exr::decode_first(bytes, width, height)?;
        let Notes { limits, .. } = serde_json::from_str(&notes)
            .map_err(|why| PictureError::Broken(format!("it holds no limits: {why}")))?;
        let light = levels_of(&part, "")?
            .into_iter()
            .map(|levels| DVec3::from(levels.map(f64::from)) / 255.0);
        let expected = Image::from_pixels(width, height, light.collect())
            .ok_or_else(|| PictureError::Broken("the picture lacks pixels".to_owned()))?;
        let weight = part.plane(WEIGHT)?.iter().map(|share| to_byte(*share)).collect();
        Ok(Self {
            expected,
            lo: levels_of(&part, "lo")?,
            hi: levels_of(&part, "hi")?,
            weight,
            limits,
        })
    }
}

/// Returns the sample of full light in the part `part` of an EXR file.
///
/// It is 255/256 in a stored answer, and 1 elsewhere.
pub fn full_light(part: &str) -> f64 {
    if part == ANSWER { 255.0 / f64::from(UNIT) } else { 1.0 }
}

/// Converts light to levels and rounds them with `round`.
fn levels(light: DVec3, round: fn(f64) -> f64) -> Levels {
    light.to_array().map(|channel| round(level(channel)) as u8)
}

fn layer(name: &str, levels: &[Levels]) -> [Plane; 3] {
    let plane = |channel: &str, at: usize| {
        byte_plane(plane_name(name, channel), levels.iter().map(|pixel| pixel[at]))
    };
    [plane("R", 0), plane("G", 1), plane("B", 2)]
}

fn to_byte(share: f32) -> u8 {
    // Adding a half and cutting is rounding, for a share of at least 0.
    (share * UNIT + 0.5) as u8
}

fn levels_of(part: &Part, name: &str) -> Result<Vec<Levels>, PictureError> {
    let plane = |channel: &str| part.plane(&plane_name(name, channel));
    let (red, green, blue) = (plane("R")?, plane("G")?, plane("B")?);
    Ok(red.iter().zip(green).zip(blue).map(|((r, g), b)| [*r, *g, *b].map(to_byte)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Course;

    /// All 256 levels in a row, and light above 1.
    fn answer() -> ImageAnswer {
        let expected =
            Image::from_fn(256, 2, |i, j| DVec3::new(f64::from(i) / 255.0, f64::from(j), 1.0));
        let mut answer = ImageAnswer::exact(expected, 1.0, 3);
        answer.hi[7] = [8, 0, 255];
        answer.hi[9] = [14, 0, 255];
        answer.weight[3] = 128;
        answer
    }

    #[test]
    fn an_answer_comes_back_with_and_without_mistakes() {
        let changes = (0..512).map(|n| (n < 256).then_some([8, 0, 248]));
        let wrong = Wrong::new("no_shadows", changes);
        let made_from = Digest::of_mistakes(&Course::default());
        for wrong in [vec![], vec![wrong]] {
            let bytes = answer().encode(&made_from, &wrong).unwrap();
            assert_eq!(ImageAnswer::made_from(&bytes).unwrap(), Some(made_from.clone()));
            assert_eq!(ImageAnswer::decode(&bytes, 256, 2).unwrap(), answer());
            assert_eq!(Wrong::decode_all(&bytes, 256, 2).unwrap(), wrong);
            assert!(ImageAnswer::decode(&bytes, 2, 256).is_err());
        }
    }

    #[test]
    fn an_exact_answer_takes_in_both_neighbouring_levels() {
        let grey = Image::from_fn(1, 1, |_, _| DVec3::new(0.5, 1.0, 7.0));
        let answer = ImageAnswer::exact(grey, 1.0, 0);
        assert_eq!((answer.lo[0], answer.hi[0]), ([127, 255, 255], [128, 255, 255]));
    }

    #[test]
    fn a_pixel_is_out_beyond_the_slack_only_and_weighs_what_it_weighs() {
        let answer = answer();
        let blue_and = |level: f64| DVec3::new(level / 255.0, 0.0, 1.0);
        for (n, level, is_out) in
            [(7, 6.0, false), (7, 5.9, true), (7, 9.0, false), (7, 9.1, true), (9, 15.0, false)]
        {
            assert_eq!(answer.is_out(n, blue_and(level)), is_out, "{n} {level}");
        }
        assert!(answer.is_out(0, DVec3::NAN) && answer.is_out(511, DVec3::INFINITY));
        let mut out = vec![false; 512];
        out[3] = true;
        let all = 511.0 * 255.0 + 128.0;
        assert_eq!(answer.share(&out), (all - 128.0) / all);
    }

    #[test]
    fn a_pixel_is_contested_where_the_envelope_is_wide() {
        let contested: Vec<usize> = (0..512).filter(|n| answer().is_contested(*n)).collect();
        assert_eq!(contested, [9]);
        assert_eq!(answer().contested_share(), 1.0 / 512.0);
    }
}
