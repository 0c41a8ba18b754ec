//! The reasons why a case cannot be varied.

use std::io;
use std::path::PathBuf;

use cases::problem::Problems;

use super::accept::{MOST_DRAWS, Refusal};
use super::edit::EditError;

/// The reason why a case cannot be varied.
#[derive(Debug, thiserror::Error)]
pub enum VaryError {
    /// The case has no `[vary]`.
    #[error(
        "{id} has no `[vary]`, which bounds the changes of its numbers: add one \
         (docs/scene-format.md)"
    )]
    NoBounds {
        /// The case.
        id: String,
    },
    /// The file of the case cannot be read.
    #[error("cannot read {}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The file of the case is not TOML.
    #[error("{id}")]
    Toml {
        /// The case.
        id: String,
        /// The error, with line and column.
        source: toml_edit::TomlError,
    },
    /// A number of the case cannot be changed exactly.
    #[error("{id}")]
    Number {
        /// The case.
        id: String,
        /// The number.
        source: EditError,
    },
    /// A key of `[vary]` has no effect.
    #[error("{id}: in `[vary]`, `{key}` moves nothing in the file: leave it out")]
    IdleKey {
        /// The case.
        id: String,
        /// The key.
        key: String,
    },
    /// No key of `[vary]` has an effect.
    #[error("{id}: in `[vary]`, no key moves anything: add one (docs/scene-format.md)")]
    Idle {
        /// The case.
        id: String,
    },
    /// The changed case is not valid.
    #[error(transparent)]
    Invalid(#[from] Problems),
    /// No draw was accepted.
    #[error(
        "{id}: with seed {seed} none of {MOST_DRAWS} draws will do; make its `[vary]` narrower{}",
        times(.refusals)
    )]
    Refused {
        /// The case.
        id: String,
        /// The seed.
        seed: u64,
        /// The reasons, each with the number of draws that it applied to.
        refusals: Vec<(Refusal, usize)>,
    },
}

fn times(refusals: &[(Refusal, usize)]) -> String {
    refusals.iter().map(|(refusal, n)| format!("\n  {n} times {refusal}")).collect()
}
