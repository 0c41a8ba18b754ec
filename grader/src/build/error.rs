//! The reasons why a submission cannot be built, and who is to blame for them.

use super::entry::StoreError;
use crate::sandbox::{FolderError, Shortage};

/// The reason why there is no program.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// The submission is to blame; the text is for the student.
    #[error("{0}")]
    Rejected(String),
    /// The machine or the grader is to blame.
    #[error(transparent)]
    Ours(#[from] Fault),
    /// The user stopped the grader.
    #[error("the grader was interrupted while building")]
    Interrupted,
}

/// A fault of the machine or the grader that keeps a submission from being built.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The machine lacked something.
    #[error(transparent)]
    Machine(#[from] Shortage),
    /// There is no temporary folder.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// An entry of the store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Any other fault; the text is for the person who grades.
    #[error("{0}")]
    Other(String),
}
