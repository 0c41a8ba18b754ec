//! Zip archives, read through the central directory without keeping it, so that no entry hides
//! another.

use std::io::Cursor;

use ::zip::CompressionMethod::{Deflated, Stored};
use ::zip::System;
use ::zip::read::{Config, ZipFileEntry};
use ::zip::unstable::read::ZipIterable;

use super::error::{ArchiveError, broken};
use super::unpacking::{Kind, Unpacking};
use crate::submission::aside::Why;

/// Takes the entries of the archive `bytes`.
pub(super) fn unpack(bytes: &[u8], to: &mut Unpacking) -> Result<(), ArchiveError> {
    let mut zip = ZipIterable::try_new(Cursor::new(bytes), Config::default()).map_err(broken)?;
    let mut body = Cursor::new(bytes);
    let mut packed = 0_u64;
    for entry in zip.files().map_err(broken)? {
        let entry = entry.map_err(broken)?;
        let name = name(&entry)?;
        let Some(path) = to.admit(&name, kind(&entry), entry.size())? else { continue };
        // Entries that share their bytes are a bomb: each costs the time of reading them again.
        packed = packed.saturating_add(entry.compressed_size());
        if packed > bytes.len() as u64 {
            return Err(broken("its entries overlap"));
        }
        if entry.encrypted() {
            to.leave(&name, Why::Encrypted);
        } else if !matches!(entry.compression(), Stored | Deflated) {
            to.leave(&name, Why::Method);
        } else {
            let mut file = entry.with_reader(&mut body, Default::default()).map_err(broken)?;
            to.write(&name, &path, &mut file)?;
        }
    }
    Ok(())
}

/// Returns the name of an entry as UTF-8 with `/` between names.
///
/// A Unicode path in the extra fields wins. A name that is not UTF-8 is in code page 437. Programs
/// on Windows may write `\` between names.
fn name(entry: &ZipFileEntry) -> Result<Vec<u8>, ArchiveError> {
    let name = entry.name().map_err(broken)?;
    Ok(match entry.system() {
        System::Dos | System::WindowsNTFS | System::VFAT => name.replace('\\', "/").into_bytes(),
        _ => name.into_owned().into_bytes(),
    })
}

fn kind(entry: &ZipFileEntry) -> Kind {
    const KIND_OF_FILE: u32 = 0o170_000;
    match entry.unix_mode().unwrap_or(0) & KIND_OF_FILE {
        0o040_000 => Kind::Folder,
        0 | 0o100_000 if entry.is_dir() => Kind::Folder,
        0 | 0o100_000 => Kind::File,
        0o120_000 => Kind::Link,
        _ => Kind::Special,
    }
}
