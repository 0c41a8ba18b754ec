//! The stored answers that the judge compares with. Only `reference expect` writes them.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::film::Image;
use crate::probe::Answer;

/// The answer to an image case, stored as `CASE.answer.exr` beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageAnswer {
    /// The picture in linear light, as f32.
    pub expected: Image,
    /// How far from it a right picture may be.
    pub tolerance: Tolerance,
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
