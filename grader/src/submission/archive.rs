//! Unpacking a submission's archive: entry by entry into an empty folder, counted while inflating.
//!
//! An archive is hostile until it is unpacked. Only regular files and folders come out of it, each below the folder
//! given, with the permissions that this process gives to new files; modes, owners and times of the archive are ignored.
//! What a header says about sizes is never believed: the bytes that come out are counted.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

use crate::plain;

mod names;
#[cfg(test)]
mod tests;

pub use names::Unsafe;

/// How much an archive may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the archive itself.
    pub archive_bytes: u64,
    /// Files and folders.
    pub entries: usize,
    /// Names in a path: `src/main.rs` has two.
    pub depth: usize,
    /// Bytes of one file.
    pub file_bytes: u64,
    /// Bytes of all files.
    pub all_bytes: u64,
    /// Bytes that come out for each that went in; not asked of the first [`RATIO_FREE_BYTES`].
    pub ratio: u64,
}

/// What may come out of an archive however small it is.
pub const RATIO_FREE_BYTES: u64 = 1 << 20;

impl Default for Limits {
    /// Ample for a submission with a few meshes and pictures.
    fn default() -> Self {
        let mib = 1 << 20;
        Self {
            archive_bytes: 32 * mib,
            entries: 2000,
            depth: 12,
            file_bytes: 16 * mib,
            all_bytes: 64 * mib,
            ratio: 100,
        }
    }
}

/// Why an archive was not unpacked.
#[derive(Debug, thiserror::Error)]
pub enum ArchiveError {
    /// Neither `.zip` nor `.tar.gz` nor `.tgz`.
    #[error("the archive is neither .zip nor .tar.gz nor .tgz; pack the folder as one of these")]
    Kind,
    /// It cannot be read, or is broken.
    #[error("cannot read the archive: {0}; pack it again")]
    Unreadable(String),
    /// An entry may not come out.
    #[error("the archive's entry `{entry}` {why}; pack the folder without it")]
    Entry {
        /// Its name, made harmless to show.
        entry: String,
        /// What is wrong with it.
        why: Unsafe,
    },
    /// The archive holds too much.
    #[error("the archive {0}; leave out what is not source, such as `target`")]
    TooMuch(String),
    /// The folder to unpack into cannot be written, or is not empty.
    #[error("cannot unpack the archive into {}: {why}", .into.display())]
    Write {
        /// The folder.
        into: PathBuf,
        /// What the system says.
        why: io::Error,
    },
}

/// Whether the file's name ends like that of an archive that [`unpack`] reads.
pub fn is_archive(path: &Path) -> bool {
    kind(path).is_some()
}

/// Unpacks `archive` into the folder `into`, which must be empty. After an error `into` may hold a part.
pub fn unpack(archive: &Path, into: &Path, limits: &Limits) -> Result<(), ArchiveError> {
    let kind = kind(archive).ok_or(ArchiveError::Kind)?;
    let unwritable = |why| ArchiveError::Write { into: into.to_owned(), why };
    if std::fs::read_dir(into).map_err(unwritable)?.next().is_some() {
        return Err(unwritable(io::Error::other("it is not empty")));
    }
    let file = File::open(archive).map_err(unreadable)?;
    let meta = file.metadata().map_err(unreadable)?;
    if !meta.is_file() {
        return Err(ArchiveError::Unreadable("it is no regular file".to_owned()));
    }
    if meta.len() > limits.archive_bytes {
        return Err(ArchiveError::TooMuch(format!("is larger than {} bytes", limits.archive_bytes)));
    }
    let mut unpacking = Unpacking::new(into, limits, meta.len());
    match kind {
        Kind::Zip => unzip(file, &mut unpacking),
        Kind::TarGz => untar(file, &mut unpacking),
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Zip,
    TarGz,
}

fn kind(path: &Path) -> Option<Kind> {
    let name = path.file_name()?.to_string_lossy().to_ascii_lowercase();
    if name.ends_with(".zip") {
        Some(Kind::Zip)
    } else if name.ends_with(".tar.gz") || name.ends_with(".tgz") {
        Some(Kind::TarGz)
    } else {
        None
    }
}

fn unreadable(why: impl std::fmt::Display) -> ArchiveError {
    ArchiveError::Unreadable(plain::name(why.to_string().as_bytes()))
}

/// The bits of a Unix mode that say what kind of file it is, and two of those kinds.
const KIND_OF_FILE: u32 = 0o170_000;
const REGULAR: u32 = 0o100_000;
const FOLDER: u32 = 0o040_000;

fn unzip(file: File, unpacking: &mut Unpacking) -> Result<(), ArchiveError> {
    let mut zip = zip::ZipArchive::new(BufReader::new(file)).map_err(unreadable)?;
    if zip.has_duplicate_names() {
        return Err(ArchiveError::Unreadable("two of its entries have the same name".to_owned()));
    }
    for index in 0..zip.len() {
        let mut entry = zip.by_index(index).map_err(unreadable)?;
        let name = entry.name_raw().to_owned();
        let mode = entry.unix_mode().unwrap_or(REGULAR) & KIND_OF_FILE;
        let is_folder = entry.is_dir();
        if !(mode == 0 || mode == REGULAR || (mode == FOLDER && is_folder)) {
            return Err(refused(&name, Unsafe::NeitherFileNorFolder));
        }
        unpacking.entry(&name, is_folder, &mut entry)?;
    }
    Ok(())
}

fn untar(file: File, unpacking: &mut Unpacking) -> Result<(), ArchiveError> {
    // The crate reads long names and extended headers whole: what all of them may come to is cut here.
    let whole = unpacking.limits.all_bytes.saturating_add(unpacking.limits.entries as u64 * 4096);
    let mut tar = tar::Archive::new(Cut { inner: MultiGzDecoder::new(BufReader::new(file)), left: whole });
    for entry in tar.entries().map_err(unreadable)? {
        let mut entry = entry.map_err(unreadable)?;
        let kind = entry.header().entry_type();
        if kind.is_pax_global_extensions() {
            continue; // what git writes first: a comment, no file
        }
        let name = entry.path_bytes().into_owned();
        if !(kind.is_file() || kind.is_dir()) {
            return Err(refused(&name, Unsafe::NeitherFileNorFolder));
        }
        unpacking.entry(&name, kind.is_dir(), &mut entry)?;
    }
    Ok(())
}

fn refused(name: &[u8], why: Unsafe) -> ArchiveError {
    ArchiveError::Entry { entry: plain::name(name), why }
}

/// A reader that fails, rather than ends, after `left` bytes.
struct Cut<R> {
    inner: R,
    left: u64,
}

impl<R: Read> Read for Cut<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let got = self.inner.read(buffer)?;
        self.left = self.left.checked_sub(got as u64).ok_or_else(|| io::Error::other("it inflates to too much"))?;
        Ok(got)
    }
}

/// What has come out so far.
struct Unpacking<'a> {
    into: &'a Path,
    limits: &'a Limits,
    /// Bytes that may still come out.
    left: u64,
    entries: usize,
    /// By path in lower case: the path as it came, and whether it is a folder.
    taken: HashMap<String, (String, bool)>,
}

impl<'a> Unpacking<'a> {
    fn new(into: &'a Path, limits: &'a Limits, archive_bytes: u64) -> Self {
        let by_ratio = archive_bytes.saturating_mul(limits.ratio).max(RATIO_FREE_BYTES);
        Self { into, limits, left: limits.all_bytes.min(by_ratio), entries: 0, taken: HashMap::new() }
    }

    fn entry(&mut self, name: &[u8], is_folder: bool, from: &mut impl Read) -> Result<(), ArchiveError> {
        self.entries += 1;
        if self.entries > self.limits.entries {
            return Err(ArchiveError::TooMuch(format!("has more than {} entries", self.limits.entries)));
        }
        let parts = names::parts(name, self.limits.depth).map_err(|why| refused(name, why))?;
        self.claim(&parts, is_folder).map_err(|why| refused(name, why))?;
        let Some((_, parents)) = parts.split_last() else { return Ok(()) };
        let folder = if is_folder { &parts[..] } else { parents };
        let unwritable = |why| ArchiveError::Write { into: self.into.to_owned(), why };
        std::fs::create_dir_all(folder.iter().fold(self.into.to_owned(), |at, part| at.join(part)))
            .map_err(unwritable)?;
        if is_folder { Ok(()) } else { self.file(name, &parts, from) }
    }

    /// Takes the path for this entry, and those of the folders above it.
    fn claim(&mut self, parts: &[&str], is_folder: bool) -> Result<(), Unsafe> {
        for n in 1..=parts.len() {
            let path = parts[..n].join("/");
            let as_folder = is_folder || n < parts.len();
            match self.taken.get(&path.to_lowercase()) {
                None => drop(self.taken.insert(path.to_lowercase(), (path, as_folder))),
                Some((there, _)) if *there != path => return Err(Unsafe::SameButForCase(there.clone())),
                Some((_, true)) if as_folder => {}
                Some(_) => return Err(Unsafe::Twice),
            }
        }
        Ok(())
    }

    fn file(&mut self, name: &[u8], parts: &[&str], from: &mut impl Read) -> Result<(), ArchiveError> {
        let path = parts.iter().fold(self.into.to_owned(), |at, part| at.join(part));
        let unwritable = |why| ArchiveError::Write { into: self.into.to_owned(), why };
        let mut file = File::create_new(path).map_err(unwritable)?;
        let most = self.limits.file_bytes.min(self.left);
        let mut buffer = [0; 16 * 1024];
        let mut written = 0;
        loop {
            let got = from.read(&mut buffer).map_err(unreadable)?;
            if got == 0 {
                break;
            }
            written += got as u64;
            if written > most {
                return Err(self.too_large(name, written));
            }
            io::Write::write_all(&mut file, &buffer[..got]).map_err(unwritable)?;
        }
        self.left -= written;
        Ok(())
    }

    fn too_large(&self, name: &[u8], written: u64) -> ArchiveError {
        if written > self.limits.file_bytes {
            return refused(name, Unsafe::TooLarge(self.limits.file_bytes));
        }
        ArchiveError::TooMuch(format!(
            "inflates to more than {} bytes, or to more than {} times its size",
            self.limits.all_bytes, self.limits.ratio
        ))
    }
}
