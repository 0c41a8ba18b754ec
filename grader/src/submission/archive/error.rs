//! The reasons why an archive was not unpacked.

use std::io;

use crate::plain;

/// The reason why an archive was not unpacked.
#[derive(Debug, thiserror::Error)]
pub enum ArchiveError {
    /// The archive is broken.
    #[error("the archive is broken ({0}); pack it again")]
    Broken(String),
    /// The archive holds too much.
    #[error("{0}; leave out what is not source, such as videos and build output")]
    TooMuch(String),
    /// The folder to unpack into cannot be written, which is the machine's fault.
    #[error("cannot write: {0}")]
    Machine(#[source] io::Error),
}

/// Returns the error of a broken archive, with the message of its reader made harmless to show.
pub(super) fn broken(why: impl std::fmt::Display) -> ArchiveError {
    ArchiveError::Broken(plain::name(why.to_string().as_bytes()))
}
