//! Says why a file is not a picture.

use std::io;

use crate::files::WriteError;

/// A `PictureError` says why a file is not the picture that is wanted.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The first bytes are not those of a kind that can be read.
    #[error("not a {read} image: {found}")]
    Foreign {
        /// These kinds can be read.
        read: &'static str,
        /// The bytes look like this.
        found: &'static str,
    },
    /// The header states another size; nothing was decoded.
    #[error("it is {}×{} pixels, not {}×{}", found.0, found.1, wanted.0, wanted.1)]
    Size {
        /// The file has this size.
        found: (u32, u32),
        /// The caller wants this size.
        wanted: (u32, u32),
    },
    /// The header states more pixels than the limit; nothing was decoded.
    #[error("it is {}×{} pixels; at most {most} can be read", found.0, found.1)]
    TooLarge {
        /// The file has this size.
        found: (u32, u32),
        /// The limit, in words.
        most: String,
    },
    /// The file is of the right kind, but damaged or of a form that cannot be read.
    #[error("it cannot be decoded: {0}")]
    Broken(String),
    /// The file cannot be read.
    #[error("it cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
