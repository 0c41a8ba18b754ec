//! Writes the entries of an archive into a folder, each after a check of its name, kind and size.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::error::{ArchiveError, broken};
use crate::submission::aside::{Aside, Why, names};
use crate::submission::limits::{Excess, Limits, RATIO_FREE_BYTES, SKIPPED, is_of_system, size};

/// The kind of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    File,
    Folder,
    Link,
    Special,
}

/// The state of an archive that is being unpacked.
pub(super) struct Unpacking<'a> {
    into: &'a Path,
    pub(super) limits: &'a Limits,
    archive_bytes: u64,
    /// Bytes that may still come out.
    left: u64,
    pub(super) n_looked_at: usize,
    n_entries: usize,
    /// The paths that came out, each with whether it is a folder.
    taken: HashMap<String, bool>,
    pub(super) aside: Vec<Aside>,
}

impl<'a> Unpacking<'a> {
    pub(super) fn new(into: &'a Path, limits: &'a Limits, archive_bytes: u64) -> Self {
        let by_ratio = archive_bytes.saturating_mul(limits.ratio).max(RATIO_FREE_BYTES);
        let left = limits.all_bytes.min(by_ratio);
        let (taken, aside) = (HashMap::new(), vec![]);
        Self { into, limits, archive_bytes, left, n_looked_at: 0, n_entries: 0, taken, aside }
    }

    /// Decides whether the entry `name` of the claimed size `size` is taken, and creates its
    /// folder.
    ///
    /// Returns the path to write to if the entry is a file that is taken. A skipped entry counts
    /// only among those that are looked at.
    pub(super) fn admit(
        &mut self,
        name: &[u8],
        kind: Kind,
        size: u64,
    ) -> Result<Option<PathBuf>, ArchiveError> {
        self.count_look()?;
        if is_skipped(name, kind == Kind::Folder) {
            return Ok(None);
        }
        self.n_entries += 1;
        if self.n_entries > self.limits.entries {
            let most = self.limits.entries;
            return Err(ArchiveError::TooMuch(format!(
                "the archive has more than {most} files and folders"
            )));
        }
        match self.place(name, kind, size) {
            Err(why) => {
                self.leave(name, why);
                Ok(None)
            }
            Ok(path) => self.make_folder(name, path, kind),
        }
    }

    pub(super) fn count_look(&mut self) -> Result<(), ArchiveError> {
        self.n_looked_at += 1;
        if self.n_looked_at > self.limits.looked_at {
            let most = self.limits.looked_at;
            return Err(ArchiveError::TooMuch(format!("the archive has more than {most} entries")));
        }
        Ok(())
    }

    /// Leaves the entry of that name aside.
    pub(super) fn leave(&mut self, name: &[u8], why: Why) {
        self.aside.push(Aside::new(name, why));
    }

    /// Returns where the entry goes, or why it is left aside, and reserves its path and its
    /// folders.
    fn place(&mut self, name: &[u8], kind: Kind, size: u64) -> Result<PathBuf, Why> {
        let names = names(name, self.limits.depth)?;
        match kind {
            Kind::Link => return Err(Why::Link),
            Kind::Special => return Err(Why::Special),
            Kind::File if names.is_empty() => return Err(Why::Nameless),
            Kind::File if size > self.limits.file_bytes => {
                return Err(Why::TooLarge(Excess {
                    found: Some(size),
                    limit: self.limits.file_bytes,
                }));
            }
            Kind::File | Kind::Folder => {}
        }
        for n in 1..=names.len() {
            let as_folder = kind == Kind::Folder || n < names.len();
            match self.taken.insert(names[..n].join("/"), as_folder) {
                None => {}
                Some(true) if as_folder => {}
                Some(was_folder) => {
                    self.taken.insert(names[..n].join("/"), was_folder);
                    return Err(Why::Twice);
                }
            }
        }
        Ok(names.iter().fold(self.into.to_owned(), |at, name| at.join(name)))
    }

    /// Creates the folder that the entry is or lies in, and returns the path if the entry is a
    /// file.
    fn make_folder(
        &mut self,
        name: &[u8],
        path: PathBuf,
        kind: Kind,
    ) -> Result<Option<PathBuf>, ArchiveError> {
        let folder = if kind == Kind::Folder { &path } else { path.parent().unwrap_or(self.into) };
        match std::fs::create_dir_all(folder) {
            Ok(()) => Ok((kind == Kind::File).then_some(path)),
            Err(why) if is_taken(&why) => {
                self.leave(name, Why::Twice);
                Ok(None)
            }
            Err(why) => Err(ArchiveError::Machine(why)),
        }
    }

    /// Writes everything from `from` to the new file `path`. A file that proves too large is left
    /// aside.
    pub(super) fn write(
        &mut self,
        name: &[u8],
        path: &Path,
        from: &mut impl Read,
    ) -> Result<(), ArchiveError> {
        let mut file = match File::create_new(path) {
            Ok(file) => file,
            Err(why) if is_taken(&why) => {
                self.leave(name, Why::Twice);
                return Ok(());
            }
            Err(why) => return Err(ArchiveError::Machine(why)),
        };
        let mut buffer = [0; 16 * 1024];
        let mut written = 0;
        loop {
            let got = match from.read(&mut buffer) {
                Err(why) if why.kind() == io::ErrorKind::Interrupted => continue,
                got => got.map_err(broken)?,
            };
            if got == 0 {
                return Ok(());
            }
            written += got as u64;
            self.left = self.left.checked_sub(got as u64).ok_or_else(|| self.too_much())?;
            if written > self.limits.file_bytes {
                std::fs::remove_file(path).map_err(ArchiveError::Machine)?;
                self.leave(
                    name,
                    Why::TooLarge(Excess { found: None, limit: self.limits.file_bytes }),
                );
                return Ok(());
            }
            file.write_all(&buffer[..got]).map_err(ArchiveError::Machine)?;
        }
    }

    /// Returns why no more bytes may come out.
    fn too_much(&self) -> ArchiveError {
        let Limits { all_bytes, ratio, .. } = *self.limits;
        if self.archive_bytes.saturating_mul(ratio) >= all_bytes {
            let most = size(all_bytes);
            return ArchiveError::TooMuch(format!(
                "the files of the archive have more than {most}; at most {most} are read"
            ));
        }
        let packed = size(self.archive_bytes);
        ArchiveError::TooMuch(format!(
            "the archive of {packed} inflates to more than {ratio} times its size"
        ))
    }
}

/// Returns whether something else has that path. The file system may not distinguish upper and
/// lower case.
fn is_taken(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory)
}

/// Returns whether the entry lies in a folder that is skipped, or is a file of an operating system.
fn is_skipped(name: &[u8], is_folder: bool) -> bool {
    let mut names: Vec<&[u8]> =
        name.split(|byte| *byte == b'/').filter(|name| !name.is_empty()).collect();
    let file = if is_folder { None } else { names.pop() };
    names.iter().any(|name| SKIPPED.iter().any(|skipped| skipped.as_bytes() == *name))
        || file.and_then(|name| str::from_utf8(name).ok()).is_some_and(is_of_system)
}
