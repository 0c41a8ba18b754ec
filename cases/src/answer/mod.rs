//! The stored answers that the judge compares with. Only `reference` writes them.

mod check;
mod cluster;
mod digest;
pub mod load;
mod mistake;
mod picture;

use std::path::{Path, PathBuf};

pub use check::{CheckAnswer, check_answers_from_str, check_answers_to_string};
pub use cluster::{Clusters, largest_cluster, neighbours};
pub use digest::{Digest, RULES_VERSION};
pub use load::AnswerError;
pub use mistake::{Mistake, mistakes_from_str, mistakes_to_string};
pub use picture::{ImageAnswer, Levels, Limits, Wrong, full_light};

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

/// Where the known mistakes are listed below `stages`.
pub fn mistakes_path(stages: &Path) -> PathBuf {
    stages.join("mistakes.answers.json")
}
