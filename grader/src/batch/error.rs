//! The reasons why a run as a whole failed.

use std::io;
use std::path::PathBuf;

use cases::files::is_usage;
use cases::problem::Problems;

/// The reason why a run as a whole failed.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// The folder of submissions cannot be read.
    #[error("cannot read the folder of submissions {}", .folder.display())]
    Folder {
        /// The path as it was given.
        folder: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The folder holds no submission.
    #[error("there is no submission in {}: each is a folder or an archive (.zip, .tar.gz, .tgz, \
        .tar) in it", .0.display())]
    Empty(PathBuf),
    /// The export cannot be used.
    #[error(transparent)]
    Export(#[from] Problems),
    /// The results cannot be written.
    #[error(
        "cannot write the results to {} (those of finished submissions are kept)",
        .out.display()
    )]
    Out {
        /// The path as it was given.
        out: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

impl BatchError {
    /// Returns whether the arguments are to blame, rather than the machine.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Folder { .. } | Self::Empty(_) | Self::Export(_) => true,
            Self::Out { source, .. } => is_usage(source),
        }
    }
}
