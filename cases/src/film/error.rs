//! The errors of reading and writing pictures.

use std::io;

use crate::files::WriteError;

/// The reason why a file is not the picture that the caller expects.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The first bytes are not those of a kind that can be read.
    #[error("not a {read} image: {found}")]
    Foreign {
        /// The kinds that can be read.
        read: &'static str,
        /// The kind that the bytes look like.
        found: &'static str,
    },
    /// The header states another size; nothing was decoded.
    #[error("it is {}×{} pixels, not {}×{}", found.0, found.1, wanted.0, wanted.1)]
    Size {
        /// Width and height of the file.
        found: (u32, u32),
        /// Width and height that the caller expects.
        wanted: (u32, u32),
    },
    /// The header states more pixels than the limit; nothing was decoded.
    #[error("it is {}×{} pixels; at most {most} can be read", found.0, found.1)]
    TooLarge {
        /// Width and height of the file.
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
