//! Unpacks a submission's archive entry by entry into an empty folder, and counts while inflating.
//!
//! An archive is untrusted. Only regular files and folders come out of it, each below the given
//! folder and with the permissions that this process gives to new files; modes, owners and times of
//! the archive are ignored. The sizes in headers are never believed: the bytes that come out are
//! counted. An entry with an odd name or of an odd kind is left aside; the archive as a whole is
//! refused if it is broken or holds too much.

use std::path::Path;

use super::aside::Aside;
use super::limits::Limits;

mod error;
mod tar;
#[cfg(test)]
mod tests;
mod unpacking;
mod zip;

pub use error::ArchiveError;

use unpacking::Unpacking;

/// The formats of archives that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `.zip`, stored or deflated.
    Zip,
    /// `.tar.gz` or `.tgz`.
    TarGz,
    /// `.tar`.
    Tar,
}

/// Unpacks the archive `bytes` into the folder `into`, which must be empty, and returns the parts
/// that were left aside.
///
/// After an error, `into` may hold part of the archive.
///
/// # Errors
/// See [`ArchiveError`].
pub fn unpack(
    bytes: &[u8],
    format: Format,
    into: &Path,
    limits: &Limits,
) -> Result<Vec<Aside>, ArchiveError> {
    let mut unpacking = Unpacking::new(into, limits, bytes.len() as u64);
    match format {
        Format::Zip => zip::unpack(bytes, &mut unpacking)?,
        Format::TarGz => tar::unpack_gz(bytes, &mut unpacking)?,
        Format::Tar => tar::unpack(bytes, &mut unpacking)?,
    }
    Ok(unpacking.aside)
}
