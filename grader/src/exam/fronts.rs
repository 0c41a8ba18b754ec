//! The measured cost of accuracy beside the cases.

use std::path::{Path, PathBuf};

use cases::files::{self, ReadError};
use cases::front::{Fronts, fronts_from_str, fronts_path};

/// Largest size in bytes of the file.
const MAX_BYTES: u64 = 64 << 20;

/// The reason why the measured cost of accuracy cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FrontsError {
    /// The file cannot be read.
    #[error("the cost of accuracy in {} cannot be used", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of reading.
        source: ReadError,
    },
    /// The content is not what `reference cost --store` writes.
    #[error("the cost of accuracy in {} cannot be used", .path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The error, with line and column.
        source: serde_json::Error,
    },
}

/// Returns what was measured for the stages in `folder`; `None` if there is no file.
///
/// # Errors
/// See [`FrontsError`].
pub(super) fn read(folder: &Path) -> Result<Option<Fronts>, FrontsError> {
    let path = fronts_path(folder);
    match files::read_text(&path, MAX_BYTES) {
        Ok(text) => match fronts_from_str(&text) {
            Ok(fronts) => Ok(Some(fronts)),
            Err(source) => Err(FrontsError::Format { path, source }),
        },
        Err(ReadError::Missing) => Ok(None),
        Err(source) => Err(FrontsError::Read { path, source }),
    }
}
