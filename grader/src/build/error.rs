//! The reasons why a submission cannot be built, and who is to blame for them.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::entry::StoreError;
use super::sdk::SdkError;
use super::toolchain::ToolchainError;
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
    /// There is no compiler.
    #[error(transparent)]
    Toolchain(#[from] Arc<ToolchainError>),
    /// There are no compiled crates to link student code with.
    #[error(transparent)]
    Sdk(Arc<SdkError>),
    /// A file of the build cannot be written.
    #[error("cannot write {}", .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The submission cannot be copied to a folder of its own.
    #[error("the submission cannot be copied")]
    Copy(#[source] io::Error),
    /// The compiler cannot be started. The text is the system's.
    #[error("the build cannot be started: {0}")]
    NotStarted(String),
    /// An entry is not in the store after it was published.
    #[error("{} is not there after it was stored", .0.display())]
    Lost(PathBuf),
}
