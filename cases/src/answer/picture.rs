//! The answer to an image case: the right picture, how far a right one may be from it, and the
//! pictures of known mistakes.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Digest;
use crate::film::exr::{self, Depth, Part, Plane, plane_name};
use crate::film::{Image, PictureError, byte, level};

/// Red, green and blue in whole 8-bit levels.
pub type Levels = [u8; 3];

/// The answer to an image case, stored as `CASE.answer.exr` beside it. All lists go row by row from
/// the top.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageAnswer {
    /// The picture in linear light; the file has it in whole levels.
    pub expected: Image,
    /// The least that a right tracer gives, rounded down.
    pub lo: Vec<Levels>,
    /// The most that a right tracer gives, rounded up.
    pub hi: Vec<Levels>,
    /// What a pixel counts for partial points: 255 where the stage's effect is plain to see.
    pub weight: Vec<u8>,
    /// How much of the picture may lie outside.
    pub limits: Limits,
}

/// The limits of a right picture, and where partial points begin; they belong to the expectation,
/// not to the judge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// A channel is out beyond the envelope by more than this many levels, which takes in the
    /// quantiser.
    pub slack: f64,
    /// Most pixels that may be out side by side, corners included.
    pub cluster: u32,
    /// Most pixels that may be out in all.
    pub count: u32,
    /// The largest cluster that a right tracer is known to leave: each variation, judged by the
    /// others.
    pub legal_cluster: u32,
    /// The most pixels that a right tracer is known to leave.
    pub legal_count: u32,
    /// The weighted share of pixels that is right without the effect: what earns nothing.
    pub unearned: f64,
}

/// The note in the file.
#[derive(Serialize, Deserialize)]
struct Notes {
    made_from: Digest,
    #[serde(flatten)]
    limits: Limits,
}

/// What a known mistake changes in the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The id of the mistake.
    pub id: String,
    /// The colours it gives, row by row from the top; `None` where the picture stays right. The
    /// file has every eighth level.
    pub changes: Vec<Option<Levels>>,
}

/// A pixel whose envelope is wider than this many levels is contested: right tracers do not agree
/// on it.
const CONTESTED: u8 = 4;
/// The colours of mistakes are stored to the nearest multiple of this many levels.
const COARSE: u16 = 8;
/// A colour that differs from a mistake's by no more than this many levels is that of the mistake:
/// what the file rounds away, and the quantiser.
const ALIKE: f64 = 6.0;
/// Levels are stored as this part of full light: unlike a 255th, exact in half precision, and half
/// the size when packed.
const UNIT: f32 = 256.0;
const ANSWER: &str = "answer";
const MISTAKES: &str = "mistakes";
const WEIGHT: &str = "weight.Y";

impl ImageAnswer {
    /// The answer that leaves no freedom but `slack` levels and `count` pixels anywhere: every
    /// pixel weighs alike.
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

    /// By how many levels a channel of the pixel with index `n` lies beyond the envelope at most,
    /// when it has this colour; infinite where a channel is not finite.
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

    /// Whether the pixel with index `n` is out when it has this colour.
    pub fn is_out(&self, n: usize, colour: DVec3) -> bool {
        self.beyond(n, colour) > self.limits.slack
    }

    /// Which pixels of `actual` are out, row by row from the top.
    pub fn out(&self, actual: &Image) -> Vec<bool> {
        actual.pixels().iter().enumerate().map(|(n, colour)| self.is_out(n, *colour)).collect()
    }

    /// Whether so many pixels may be out: the largest cluster of them, and all.
    pub fn allows(&self, cluster: u32, count: u32) -> bool {
        cluster <= self.limits.cluster && count <= self.limits.count
    }

    /// The weighted share of pixels that are not out.
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

    /// Whether right tracers disagree on the pixel with index `n`.
    pub fn is_contested(&self, n: usize) -> bool {
        self.lo[n].iter().zip(self.hi[n]).any(|(lo, hi)| hi.saturating_sub(*lo) > CONTESTED)
    }

    /// The share of contested pixels.
    pub fn contested_share(&self) -> f64 {
        let n = (0..self.lo.len()).filter(|n| self.is_contested(*n)).count();
        n as f64 / self.lo.len() as f64
    }

    /// Returns the bytes to store: an OpenEXR file of the parts `answer` and `mistakes`, with the
    /// limits and the digest of what the answer was made from as a note. They depend on the content
    /// alone.
    ///
    /// # Errors
    /// A list of another length than the picture's, or what the encoder says.
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
        let mut parts = vec![Part { name: ANSWER.to_owned(), planes }];
        if !wrong.is_empty() {
            let planes = wrong.iter().flat_map(|wrong| layer(&wrong.id, &wrong.stored())).collect();
            parts.push(Part { name: MISTAKES.to_owned(), planes });
        }
        exr::encode((self.expected.width(), self.expected.height()), &parts, &notes)
    }

    /// Returns what the answer in `bytes` was made from, or `None` for a file that does not say so.
    /// Nothing but the header is read.
    ///
    /// # Errors
    /// A broken file.
    pub fn made_from(bytes: &[u8]) -> Result<Option<Digest>, PictureError> {
        let notes = exr::notes(bytes)?;
        Ok(serde_json::from_str::<Notes>(&notes).ok().map(|notes| notes.made_from))
    }

    /// Returns the answer that `bytes` hold, whose size has to be `width` × `height`, as is checked
    /// before anything is decoded. The mistakes stay packed.
    ///
    /// # Errors
    /// Another size, a plane or the limits missing, or a broken file.
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

/// Returns the sample that stands for full light in the part `part` of an EXR file.
///
/// The result is 255/256 in a stored answer, and 1 elsewhere.
pub fn full_light(part: &str) -> f64 {
    if part == ANSWER { 255.0 / f64::from(UNIT) } else { 1.0 }
}

impl Wrong {
    /// The ids of the mistakes that a stored answer holds, without unpacking their pictures: those
    /// that the case does not let pass.
    ///
    /// # Errors
    /// As [`ImageAnswer::decode`].
    pub fn ids(bytes: &[u8], width: u32, height: u32) -> Result<Vec<String>, PictureError> {
        let parts = exr::plane_names(bytes, width, height)?;
        let names =
            parts.into_iter().filter(|(part, _)| part == MISTAKES).flat_map(|(_, names)| names);
        Ok(names.filter_map(|name| name.strip_suffix(".R").map(str::to_owned)).collect())
    }

    /// Whether the mistake gives about this colour to the pixel with index `n`, and not the right
    /// one.
    pub fn explains(&self, n: usize, colour: DVec3) -> bool {
        let is_near = |levels: Levels| {
            (0..3).all(|at| (level(colour[at]) - f64::from(levels[at])).abs() <= ALIKE)
        };
        self.changes[n].is_some_and(is_near) // false for NaN
    }

    /// Black where nothing changes; what turns black is stored as nearly so.
    fn stored(&self) -> Vec<Levels> {
        let coarse = |level: u8| {
            u8::try_from((u16::from(level) + COARSE / 2) / COARSE * COARSE).unwrap_or(u8::MAX)
        };
        let stored = |change: &Option<Levels>| match change.map(|levels| levels.map(coarse)) {
            None => [0; 3],
            Some([0, 0, 0]) => [1; 3],
            Some(levels) => levels,
        };
        self.changes.iter().map(stored).collect()
    }

    /// What known mistakes change that a stored answer holds, ordered by id.
    ///
    /// # Errors
    /// As [`ImageAnswer::decode`].
    pub fn decode_all(bytes: &[u8], width: u32, height: u32) -> Result<Vec<Self>, PictureError> {
        let (parts, _) = exr::decode(bytes, width, height)?;
        let Some(part) = parts.into_iter().find(|part| part.name == MISTAKES) else {
            return Ok(vec![]);
        };
        let ids = part.planes.iter().filter_map(|plane| plane.name.strip_suffix(".R"));
        let change = |levels: Levels| (levels != [0; 3]).then_some(levels);
        let wrong = |id: &str| {
            let changes = levels_of(&part, id)?.into_iter().map(change).collect();
            Ok(Self { id: id.to_owned(), changes })
        };
        ids.map(wrong).collect()
    }
}

/// Light in levels, made whole by `round`.
fn levels(light: DVec3, round: fn(f64) -> f64) -> Levels {
    light.to_array().map(|channel| round(level(channel)) as u8)
}

fn layer(name: &str, levels: &[Levels]) -> [Plane; 3] {
    let plane = |channel: &str, at: usize| {
        byte_plane(plane_name(name, channel), levels.iter().map(|pixel| pixel[at]))
    };
    [plane("R", 0), plane("G", 1), plane("B", 2)]
}

fn byte_plane(name: String, bytes: impl Iterator<Item = u8>) -> Plane {
    Plane { name, samples: bytes.map(|byte| f32::from(byte) / UNIT).collect(), depth: Depth::Half }
}

fn to_byte(share: f32) -> u8 {
    (share * UNIT).round() as u8
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

    /// Every eighth level in the first row, nothing in the second.
    fn change(n: u32) -> Option<Levels> {
        (n < 256).then_some([n as u8 & 0xf8, 8, 248])
    }

    #[test]
    fn an_answer_and_its_mistakes_come_back() {
        let wrong = Wrong { id: "no_shadows".to_owned(), changes: (0..512).map(change).collect() };
        let made_from = Digest::of_mistakes(&Course::default());
        let bytes = answer().encode(&made_from, std::slice::from_ref(&wrong)).unwrap();
        assert_eq!(ImageAnswer::made_from(&bytes).unwrap(), Some(made_from.clone()));
        assert_eq!(ImageAnswer::decode(&bytes, 256, 2).unwrap(), answer());
        assert_eq!(Wrong::ids(&bytes, 256, 2).unwrap(), ["no_shadows"]);
        assert_eq!(Wrong::decode_all(&bytes, 256, 2).unwrap(), [wrong]);
        assert_eq!(
            Wrong::decode_all(&answer().encode(&made_from, &[]).unwrap(), 256, 2).unwrap(),
            []
        );
        assert!(ImageAnswer::decode(&bytes, 2, 256).is_err());
    }

    #[test]
    fn what_a_mistake_gives_is_known_again_when_it_was_stored() {
        let given = [[0, 0, 0], [1, 2, 3], [254, 255, 253], [130, 129, 127]];
        let wrong = Wrong {
            id: "x".to_owned(),
            changes: given.map(Some).into_iter().chain([None]).collect(),
        };
        let stored = wrong.stored();
        assert_eq!(stored[4], [0; 3]);
        let back = Wrong {
            changes: stored
                .into_iter()
                .map(|levels| (levels != [0; 3]).then_some(levels))
                .collect(),
            ..wrong
        };
        for (n, levels) in given.into_iter().enumerate() {
            let colour = DVec3::from(levels.map(f64::from)) / 255.0;
            assert!(back.explains(n, colour), "{levels:?} as {:?}", back.changes[n]);
            assert!(!back.explains(
                n,
                colour + 20.0 / 255.0 * if levels[0] > 127 { -DVec3::X } else { DVec3::X }
            ));
        }
        assert!(!back.explains(4, DVec3::ZERO) && !back.explains(0, DVec3::NAN));
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
