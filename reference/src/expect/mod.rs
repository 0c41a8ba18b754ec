//! The stored answers: the contents of the files beside the cases. Nothing is written here.

pub mod allowed;
mod checks;
mod envelope;
mod expected;
mod mistakes;
mod nudges;
mod set;
pub mod variations;
mod weight;

use std::path::Path;

use cases::answer::{self, Digest, ImageAnswer, Wrong};
use cases::film;
use cases::stage::Case;
use pages::say;
use rayon::prelude::*;

pub use checks::{CheckError, of_check, of_checks, right_answer};
pub use expected::Expected;
pub use mistakes::mistakes;
pub use set::{Set, picture, students_picture};

/// The answer to an image case, with its files.
#[derive(Clone, Debug)]
pub struct CaseAnswer {
    /// The id of the case.
    pub id: String,
    /// Envelope, weights and limits.
    pub answer: ImageAnswer,
    /// The pictures of the known mistakes that fail the case.
    pub wrong: Vec<Wrong>,
    /// The answer file, and the picture for people, both to be stored below the folder of stages.
    pub files: [Expected; 2],
}

/// The answers to a part of a set.
#[derive(Clone, Debug)]
pub struct Answers {
    /// The answers to image cases, in the order of the stages.
    pub cases: Vec<CaseAnswer>,
    /// The files of unit checks and of known mistakes.
    pub lists: Vec<Expected>,
}

impl Answers {
    /// Returns every file to store.
    pub fn files(&self) -> impl Iterator<Item = &Expected> {
        self.cases.iter().flat_map(|case| &case.files).chain(&self.lists)
    }
}

/// The reasons for which no answers are returned.
#[derive(Debug, thiserror::Error)]
pub enum ExpectError {
    /// Unit checks are ill posed or wrong on paper; a paragraph for each.
    #[error("{}", say::paragraphs(.0))]
    Checks(Vec<CheckError>),
    /// A picture cannot be encoded.
    #[error("the answer to {id} cannot be encoded")]
    Picture {
        /// The id of the case.
        id: String,
        /// The cause.
        source: film::PictureError,
    },
    /// [`Progress::is_stopped`] returned true.
    #[error("interrupted; nothing was written")]
    Interrupted,
    /// A list cannot be encoded.
    #[error("a list of answers cannot be encoded")]
    List(#[from] serde_json::Error),
}

/// The caller's view of long work.
pub trait Progress: Sync {
    /// Called from several threads after each step.
    fn step(&self);

    /// Returns whether the work shall end without a result.
    fn is_stopped(&self) -> bool;
}

/// Returns the number of steps of [`of_set`] for the same part. A step is an image case or a stage
/// with checks.
pub fn n_steps(set: &Set, is_wanted: impl Fn(&str) -> bool) -> usize {
    let steps = set.stages.iter().map(|stage| {
        let n_cases =
            stage.cases.iter().filter(|case| is_wanted(&stage.id) || is_wanted(&case.id)).count();
        n_cases + usize::from(is_wanted(&stage.id) && !stage.checks.is_empty())
    });
    steps.sum()
}

/// Returns the answers to the cases and stages of `set` whose ids `is_wanted` selects, to be stored
/// below `stages`, with the list of known mistakes.
///
/// A stage is selected as a whole, or case by case without its unit checks.
///
/// # Errors
/// [`ExpectError`]. The errors of all checks of all stages are reported at once.
pub fn of_set(
    stages: &Path,
    set: &Set,
    is_wanted: impl Fn(&str) -> bool + Sync,
    progress: &impl Progress,
) -> Result<Answers, ExpectError> {
    let wanted_stages =
        || set.stages.iter().filter(|stage| is_wanted(&stage.id) && !stage.checks.is_empty());
    let (mut lists, mut wrong) = (vec![], vec![]);
    // Checks come first: their problems are then reported before minutes of rendering.
    for stage in wanted_stages() {
        match of_checks(stages, stage, &set.course) {
            Ok(file) => lists.extend(file),
            Err(errors) => wrong.extend(errors),
        }
        progress.step();
    }
    if !wrong.is_empty() {
        return Err(ExpectError::Checks(wrong));
    }
    lists.push(mistakes(stages, &set.course)?);
    let all = set.stages.iter().enumerate();
    let cases: Vec<(usize, &Case)> = all
        .flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, stage, case)))
        .filter(|(_, stage, case)| is_wanted(&stage.id) || is_wanted(&case.id))
        .map(|(n, _, case)| (n, case))
        .collect();
    let cases = cases.par_iter().map(|(n, case)| {
        if progress.is_stopped() {
            return Err(ExpectError::Interrupted);
        }
        let answer = of_case(stages, set, *n, case);
        progress.step();
        answer.map_err(|source| ExpectError::Picture { id: case.id.clone(), source })
    });
    Ok(Answers { cases: cases.collect::<Result<_, _>>()?, lists })
}

/// Returns the answer to a case of the stage with index `n` of the set, to be stored below
/// `stages`.
///
/// # Errors
/// The error of an encoder.
pub fn of_case(
    stages: &Path,
    set: &Set,
    n: usize,
    case: &Case,
) -> Result<CaseAnswer, film::PictureError> {
    let right = set.picture(case);
    let png = film::encode_by(set.rules.quantiser, film::Kind::Png, &right)?;
    let answer = set.answer(n, case, right);
    let wrong = set.mistakes(case, &answer);
    let made_from = Digest::of_case(&set.course, set.stages[n].base, case);
    let bytes = answer.encode(&made_from, &wrong)?;
    let exr = Expected { path: answer::image_answer_path(stages, &case.id), bytes };
    let png = Expected { path: answer::expected_png_path(stages, &case.id), bytes: png };
    Ok(CaseAnswer { id: case.id.clone(), answer, wrong, files: [exr, png] })
}
