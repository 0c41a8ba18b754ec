//! Stored answers, with which the judge compares. Only `reference` writes them.

mod check;
mod cluster;
mod digest;
mod levels;
pub mod load;
mod mistake;
mod picture;
mod wrong;

use std::path::{Path, PathBuf};

pub use check::{CheckAnswer, check_answers_from_str, check_answers_to_string};
pub use cluster::{Clusters, largest_cluster, neighbours};
pub use digest::{Digest, RULES_VERSION};
pub use levels::Levels;
pub use load::AnswerError;
pub use mistake::{Mistake, mistakes_from_str, mistakes_to_string};
pub use picture::{ImageAnswer, Limits, full_light};
pub use wrong::Wrong;

/// Returns the path of the answer to the case `id` below `stages`.
pub fn image_answer_path(stages: &Path, id: &str) -> PathBuf {
    stages.join(format!("{id}.answer.exr"))
}

/// Returns the path below `stages` of the picture of the case `id` that people look at.
pub fn expected_png_path(stages: &Path, id: &str) -> PathBuf {
    stages.join(format!("{id}.expected.png"))
}

/// Returns the path of the answers to the unit checks of a stage below `stages`.
pub fn check_answers_path(stages: &Path, stage: &str) -> PathBuf {
    stages.join(stage).join("checks.answers.json")
}

/// Returns the path of the list of known mistakes below `stages`.
pub fn mistakes_path(stages: &Path) -> PathBuf {
    stages.join("mistakes.answers.json")
}
