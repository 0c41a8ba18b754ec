//! Tar archives, plain and within gzip, read as a stream.

use std::cell::Cell;
use std::io::{self, Read};

use ::tar::EntryType;
use flate2::read::MultiGzDecoder;

use super::error::{ArchiveError, broken};
use super::unpacking::{Kind, Unpacking};
use crate::submission::limits::size;

/// Bytes of the headers of one entry, which are read into memory: long names, extended headers and
/// maps of sparse files.
const HEADER_BYTES: u64 = 1 << 20;

/// Takes the entries of the gzipped archive `bytes`.
pub(super) fn unpack_gz(bytes: &[u8], to: &mut Unpacking) -> Result<(), ArchiveError> {
    unpack(MultiGzDecoder::new(bytes), to)
}

/// Takes the entries of the archive that `from` gives.
pub(super) fn unpack(from: impl Read, to: &mut Unpacking) -> Result<(), ArchiveError> {
    let allowance = Cell::new(HEADER_BYTES);
    let all = to.limits.inflated_bytes;
    let mut tar =
        ::tar::Archive::new(Metered { inner: from, allowance: &allowance, all, left: all });
    for entry in tar.entries().map_err(broken)? {
        let mut entry = entry.map_err(|why| match to.n_looked_at {
            0 => broken(format!("there is no tar archive in it: {why}")),
            _ => broken(why),
        })?;
        let kind = entry.header().entry_type();
        // The stored bytes of this entry may be read, and the headers of the next one. A sparse
        // file is longer than its stored form.
        let stored = if kind.is_gnu_sparse() {
            entry.header().entry_size().map_err(broken)?
        } else {
            entry.size()
        };
        allowance.set(stored.saturating_add(HEADER_BYTES));
        if kind.is_pax_global_extensions() {
            to.count_look()?; // what git writes first: a comment, no file
            continue;
        }
        let name = entry.path_bytes().into_owned();
        if let Some(path) = to.admit(&name, kind_of(kind, &name), entry.size())? {
            to.write(&name, &path, &mut entry)?;
        }
    }
    Ok(())
}

fn kind_of(kind: EntryType, name: &[u8]) -> Kind {
    match kind {
        EntryType::Directory => Kind::Folder,
        // The oldest archives mark folders in this way.
        EntryType::Regular if name.ends_with(b"/") => Kind::Folder,
        EntryType::Regular | EntryType::Continuous => Kind::File,
        EntryType::Symlink | EntryType::Link => Kind::Link,
        _ => Kind::Special,
    }
}

/// A reader that fails, rather than ends, if more is read than is allowed.
struct Metered<'a, R> {
    inner: R,
    /// Bytes that may be read until it is set again.
    allowance: &'a Cell<u64>,
    /// Bytes that may be read in all.
    all: u64,
    left: u64,
}

impl<R: Read> Read for Metered<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let got = self.inner.read(buffer)?;
        let rest = |of: u64, what: String| {
            of.checked_sub(got as u64).ok_or_else(|| io::Error::other(what))
        };
        self.left = rest(self.left, format!("it inflates to more than {}", size(self.all)))?;
        self.allowance
            .set(rest(self.allowance.get(), "the headers of an entry are too long".to_owned())?);
        Ok(got)
    }
}
