//! The reasons why there is nothing to grade, and who is to blame for them.

use std::io;
use std::path::{Path, PathBuf};

use super::aside::{Aside, Why};
use super::reading::ReadError;
use crate::blame::{self, Blame};
use crate::plain;
use crate::sandbox::FolderError;

/// The reason why there is nothing to grade.
#[derive(Debug, thiserror::Error)]
pub enum SubmissionError {
    /// The path leads nowhere, or the user may not read it. The caller of the grader is to blame.
    #[error("{}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The machine failed. Neither the student nor the caller is to blame, and another try may
    /// succeed.
    #[error("{what}")]
    Machine {
        /// The action that failed.
        what: String,
        /// The error of the system.
        source: io::Error,
    },
    /// There is no submission. The text says why and what to do.
    #[error("{0}")]
    Refused(String),
    /// There is no temporary folder to unpack an archive in.
    #[error(transparent)]
    Folder(#[from] FolderError),
}

impl SubmissionError {
    /// Returns the error of a failed call about `path`, a file or folder that was handed in.
    pub(super) fn of_path(path: &Path, source: io::Error) -> Self {
        match blame::of(&source) {
            Blame::Machine => {
                Self::Machine { what: format!("cannot read {}", path.display()), source }
            }
            Blame::File => Self::Unreadable { path: path.to_owned(), source },
        }
    }

    /// Returns the error of a file of the hand-in that counts. Messages call it `name`.
    pub(super) fn of_file(path: &Path, name: &str, why: ReadError) -> Self {
        match why {
            ReadError::Io(source) => Self::of_path(path, source),
            why => refuse(name, &why.to_string()),
        }
    }

    /// Returns the error of a file that counts but was left aside, in the hand-in at `top`.
    pub(super) fn of_aside(top: &Path, aside: Aside) -> Self {
        match aside.why {
            Why::Unreadable(why) => Self::of_path(&top.join(&aside.path), why),
            _ => Self::Refused(aside.to_string()),
        }
    }

    /// Returns the error of a failed call in a temporary folder of the grader's own.
    pub(super) fn of_temporary(source: io::Error) -> Self {
        let folder = tempfile::env::temp_dir();
        let what = format!(
            "cannot unpack the archive below {}, the folder that TMPDIR names",
            folder.display()
        );
        Self::Machine { what, source }
    }
}

/// Returns the refusal for what is wrong with one file.
pub(super) fn refuse(file: &str, why: &str) -> SubmissionError {
    SubmissionError::Refused(format!("{}: {why}", plain::name(file.as_bytes())))
}
