//! The stored answers: what the files beside the cases must hold. Nothing here writes; `reference expect` does.

pub mod allowed;
mod checks;
mod envelope;
mod mistakes;
mod set;
mod weight;

use std::path::{Path, PathBuf};

use cases::answer::{self, ImageAnswer, Wrong};
use cases::film;
use cases::stage::Case;

pub use checks::{of_check, of_checks};
pub use mistakes::mistakes;
pub use set::{Set, picture};

/// A file as it is to be stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Where.
    pub path: PathBuf,
    /// What.
    pub bytes: Vec<u8>,
}

impl Expected {
    /// Whether exactly this is stored.
    pub fn is_stored(&self) -> bool {
        std::fs::read(&self.path).is_ok_and(|stored| stored == self.bytes)
    }
}

/// All there is to store of an image case.
#[derive(Clone, Debug)]
pub struct CaseAnswer {
    /// The case's.
    pub id: String,
    /// Envelope, weights, limits.
    pub answer: ImageAnswer,
    /// The pictures of the mistakes that it does not let pass.
    pub wrong: Vec<Wrong>,
    /// The answer file, to be stored below the folder of stages, and the picture for people.
    pub files: [Expected; 2],
}

/// The answer by the rules of the set to a case of the stage with index `n` of the set, to be stored below `stages`.
///
/// # Errors
/// What the encoders say.
pub fn of_case(stages: &Path, set: &Set, n: usize, case: &Case) -> Result<CaseAnswer, film::PictureError> {
    let answer = set.answer(n, case);
    let wrong = set.mistakes(case, &answer);
    let exr = Expected { path: answer::image_answer_path(stages, &case.id), bytes: answer.encode(&wrong)? };
    let png = film::encode_by(set.rules.quantiser, film::Kind::Png, set.picture(case))?;
    let png = Expected { path: answer::expected_png_path(stages, &case.id), bytes: png };
    Ok(CaseAnswer { id: case.id.clone(), answer, wrong, files: [exr, png] })
}
