//! Reads stored answers and rejects those whose inputs have changed.

use std::collections::BTreeMap;
use std::path::Path;

use super::{
    CheckAnswer, Digest, ImageAnswer, Mistake, check_answers_from_str, check_answers_path,
    image_answer_path, mistakes_from_str, mistakes_path,
};
use crate::course::Course;
use crate::files::{self, ReadError};
use crate::film::PictureError;
use crate::stage::{Base, Case, Stage};

/// Largest size of a file of answers that is read, in bytes.
const MAX_BYTES: u64 = 64 << 20;

/// The reason why there is no answer that can be trusted.
#[derive(Debug, thiserror::Error)]
pub enum AnswerError {
    /// No answer is stored.
    #[error("there is no stored answer")]
    Missing,
    /// The stored answer was made from another scene, course or version of the rules.
    #[error("the stored answer belongs to another scene, course or version of the rules")]
    Stale,
    /// The file cannot be read.
    #[error("the stored answer cannot be read: {0}")]
    Unreadable(#[source] ReadError),
    /// The file is not a picture of the size of the case with an envelope.
    #[error("the stored answer cannot be used: {0}")]
    Picture(#[from] PictureError),
    /// The file is not a valid list of answers.
    #[error("the stored answer cannot be used: {0}")]
    Json(#[from] serde_json::Error),
}

/// Returns the answer to `case` that is stored below `stages`. `base` is that of the case's stage.
///
/// # Errors
/// All kinds of [`AnswerError`] except [`AnswerError::Json`].
pub fn image(
    stages: &Path,
    course: &Course,
    base: Base,
    case: &Case,
) -> Result<ImageAnswer, AnswerError> {
    let bytes = bytes(&image_answer_path(stages, &case.id))?;
    if ImageAnswer::made_from(&bytes)? != Some(Digest::of_case(course, base, case)) {
        return Err(AnswerError::Stale);
    }
    Ok(ImageAnswer::decode(&bytes, case.scene.render.width, case.scene.render.height)?)
}

/// The answers to the unit checks of a stage by id of the check, or the reason why there is none.
pub type CheckAnswers = BTreeMap<String, Result<CheckAnswer, AnswerError>>;

/// Returns the stored answer to every unit check of `stage`, and the ids of stored answers that
/// belong to no check. A missing or stale answer is an error in its own entry.
///
/// # Errors
/// The file is missing, cannot be read, or is not a list of answers. A stage without checks needs
/// no file.
pub fn checks(
    stages: &Path,
    course: &Course,
    stage: &Stage,
) -> Result<(CheckAnswers, Vec<String>), AnswerError> {
    if stage.checks.is_empty() {
        return Ok((CheckAnswers::new(), vec![]));
    }
    let list = check_answers_from_str(&text(&check_answers_path(stages, &stage.id))?)?;
    let mut stored: BTreeMap<String, CheckAnswer> =
        list.into_iter().map(|answer| (answer.id.clone(), answer)).collect();
    let mut answers = CheckAnswers::new();
    for check in &stage.checks {
        let answer = match stored.remove(&check.id) {
            Some(answer) if answer.made_from == Digest::of_check(course, check) => Ok(answer),
            Some(_) => Err(AnswerError::Stale),
            None => Err(AnswerError::Missing),
        };
        answers.insert(check.id.clone(), answer);
    }
    Ok((answers, stored.into_keys().collect()))
}

/// Returns the list of known mistakes that is stored below `stages`.
///
/// # Errors
/// All kinds of [`AnswerError`] except [`AnswerError::Picture`].
pub fn mistakes(stages: &Path, course: &Course) -> Result<Vec<Mistake>, AnswerError> {
    let (made_from, mistakes) = mistakes_from_str(&text(&mistakes_path(stages))?)?;
    if made_from == Digest::of_mistakes(course) { Ok(mistakes) } else { Err(AnswerError::Stale) }
}

/// Returns the bytes of a file of answers.
///
/// # Errors
/// [`AnswerError::Missing`], [`AnswerError::Unreadable`].
pub fn bytes(path: &Path) -> Result<Vec<u8>, AnswerError> {
    files::read(path, MAX_BYTES).map_err(AnswerError::of)
}

fn text(path: &Path) -> Result<String, AnswerError> {
    files::read_text(path, MAX_BYTES).map_err(AnswerError::of)
}

impl AnswerError {
    fn of(why: ReadError) -> Self {
        if matches!(why, ReadError::Missing) { Self::Missing } else { Self::Unreadable(why) }
    }
}
