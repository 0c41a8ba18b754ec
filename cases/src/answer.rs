//! The stored answers that the judge compares with. Only `reference expect` writes them.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::film::exr::{self, Layer};
use crate::film::{Image, PictureError};
use crate::probe::Answer;

/// The answer to an image case, stored as `CASE.answer.exr` beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageAnswer {
    /// The picture in linear light; the file has it rounded to a 64th of an 8-bit level, which makes it a third of the size.
    pub expected: Image,
    /// How far from it a right picture may be.
    pub tolerance: Tolerance,
}

/// The layer that holds [`ImageAnswer::expected`].
const EXPECTED: &str = "expected";
/// Light is stored as multiples of 1/STEPS.
const STEPS: f64 = 16384.0;

impl ImageAnswer {
    /// The bytes to store: an OpenEXR file with the layer `expected` and the tolerance as a note. They depend on the answer alone.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn encode(&self) -> Result<Vec<u8>, PictureError> {
        let notes = serde_json::to_string(&self.tolerance).map_err(|why| PictureError::Broken(why.to_string()))?;
        let light = |i, j| (self.expected.pixel(i, j) * STEPS).round() / STEPS;
        let image = Image::from_fn(self.expected.width(), self.expected.height(), light);
        exr::encode(&[Layer { name: EXPECTED.to_owned(), image }], &notes)
    }

    /// The answer that `bytes` hold, demanded to be `width` × `height` before anything is decoded.
    ///
    /// # Errors
    /// Another size, no layer `expected`, no tolerance, or a broken file.
    pub fn decode(bytes: &[u8], width: u32, height: u32) -> Result<Self, PictureError> {
        let (layers, notes) = exr::decode(bytes, width, height)?;
        let tolerance = serde_json::from_str(&notes)
            .map_err(|why| PictureError::Broken(format!("it holds no tolerance: {why}")))?;
        let found = layers.into_iter().find(|layer| layer.name == EXPECTED);
        let expected = found.ok_or_else(|| PictureError::Broken(format!("it has no layer {EXPECTED}")))?.image;
        Ok(Self { expected, tolerance })
    }
}

/// The limits of a right picture; they belong to the expectation, not to the judge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// A pixel is out where a channel differs by more than this many 8-bit levels.
    pub levels: f64,
    /// Pixels that may be out.
    pub out_pixels: u32,
}

/// The answer to a unit check, one of the list stored as `checks.answers.json` in its stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckAnswer {
    /// The check's.
    pub id: String,
    /// The right answer.
    pub answer: Answer,
    /// How far each number of the answer may be from it, absolutely: from the conditioning of the question.
    pub allowed: f64,
    /// Whether the decision (hit or miss, yes or no) flips within rounding of the inputs, so that either is right.
    pub either: bool,
}

/// The text to store for the unit checks of a stage: a JSON list, an answer a line.
///
/// # Errors
/// What the encoder says.
pub fn check_answers_to_string(answers: &[CheckAnswer]) -> Result<String, serde_json::Error> {
    let lines = answers.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

/// The answers that `text` holds.
///
/// # Errors
/// What is missing or of the wrong kind, with line and column.
pub fn check_answers_from_str(text: &str) -> Result<Vec<CheckAnswer>, serde_json::Error> {
    serde_json::from_str(text)
}

/// Where the answer to the case `id` is stored below `stages`.
pub fn image_answer_path(stages: &Path, id: &str) -> PathBuf {
    stages.join(format!("{id}.answer.exr"))
}

/// Where the picture for people of the case `id` is stored below `stages`.
pub fn expected_png_path(stages: &Path, id: &str) -> PathBuf {
    stages.join(format!("{id}.expected.png"))
}

/// Where the answers to the unit checks of a stage are stored below `stages`.
pub fn check_answers_path(stages: &Path, stage: &str) -> PathBuf {
    stages.join(stage).join("checks.answers.json")
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn an_image_answer_comes_back() {
        let expected = Image::from_fn(4, 3, |i, j| DVec3::new(f64::from(i) / 4.0, f64::from(j) / 4.0, 2.0));
        let answer = ImageAnswer { expected, tolerance: Tolerance { levels: 2.0, out_pixels: 96 } };
        let bytes = answer.encode().unwrap();
        assert_eq!(ImageAnswer::decode(&bytes, 4, 3).unwrap(), answer);
        assert!(ImageAnswer::decode(&bytes, 3, 4).is_err());
    }

    #[test]
    fn check_answers_come_back_infinities_included() {
        let to_light = Answer::ToLight { direction: DVec3::Y, t: f64::INFINITY };
        let answer = |id: &str, answer| CheckAnswer { id: id.to_owned(), answer, allowed: 1.9e-6, either: false };
        let answers = vec![answer("a/b/c", to_light), answer("a/b/d", Answer::Miss(true))];
        let text = check_answers_to_string(&answers).unwrap();
        assert_eq!(check_answers_from_str(&text).unwrap(), answers);
        assert_eq!(text.lines().count(), 4);
        assert_eq!(check_answers_from_str(&check_answers_to_string(&[]).unwrap()).unwrap(), vec![]);
    }
}
