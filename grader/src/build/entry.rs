//! Entries of the store: folders that are published whole, with the digest of each of their files.
//!
//! An entry is checked whenever it is taken. One that differs from what was published is removed
//! and reported: a program of some submission or a failing disk has changed it, and no submission
//! may lose points for that.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::blame::{self, Blame};
use crate::{files, leftovers, plain};

/// The file that describes the entry, and holds the digests of its files when it was published.
const INDEX: &str = "index.json";

/// The version of the format of entries. After a change, older entries are made again.
pub(super) const VERSION: u32 = 2;

/// The reason why an entry of the store cannot be used. The grader or the machine is to blame.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The entry differs from what was published.
    #[error("{} was changed after it was stored ({change}); it has been removed: run again to \
        make it", .folder.display())]
    Changed {
        /// The folder of the entry.
        folder: PathBuf,
        /// The first difference.
        change: String,
    },
    /// The entry was changed, and could not be removed.
    #[error(
        "{} was changed after it was stored ({change}): delete it, because it cannot be removed",
        .folder.display()
    )]
    Stuck {
        /// The folder of the entry.
        folder: PathBuf,
        /// The first difference.
        change: String,
        /// The error of the removal.
        source: io::Error,
    },
    /// The machine fails to read the entry, which may be as it was published.
    #[error("{}: {what} cannot be read", .folder.display())]
    Read {
        /// The folder of the entry.
        folder: PathBuf,
        /// The file.
        what: String,
        /// The error of the system.
        source: io::Error,
    },
    /// The entry cannot be published.
    #[error("{} cannot be written", .folder.display())]
    Write {
        /// The folder of the entry.
        folder: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

/// An entry of the store, which was as it was published when it was taken.
#[derive(Clone, Debug)]
pub(super) struct Entry<T> {
    pub(super) folder: PathBuf,
    /// The description that was published with it.
    pub(super) about: T,
    digests: BTreeMap<String, String>,
}

#[derive(Serialize, Deserialize)]
struct Index<T> {
    about: T,
    digests: BTreeMap<String, String>,
}

/// Publishes the files that `fill` puts into a folder, and `about`, as the entry `folder`.
///
/// # Errors
/// Fails if `fill` or the file system does. Nothing is published then.
pub(super) fn publish<T: Serialize>(
    folder: &Path,
    about: &T,
    fill: impl FnOnce(&Path) -> io::Result<()>,
) -> Result<(), StoreError> {
    let written = files::publish_folder(folder, |fresh| {
        fill(fresh)?;
        let digests = names(fresh)?.into_iter().map(|name| {
            let file = open(&fresh.join(&name))?;
            file.sync_all()?;
            digest(file).map(|digest| (name, digest))
        });
        let index = Index { about, digests: digests.collect::<io::Result<_>>()? };
        files::write(&fresh.join(INDEX), &serde_json::to_vec_pretty(&index)?)
    });
    written.map_err(|source| StoreError::Write { folder: folder.to_owned(), source })
}

impl<T: DeserializeOwned> Entry<T> {
    /// Takes the entry `folder` and checks it, or returns `None` if there is none.
    ///
    /// # Errors
    /// Fails if the entry was changed, and then removes it, or if the machine cannot read it.
    pub(super) fn take(folder: &Path) -> Result<Option<Self>, StoreError> {
        if folder.symlink_metadata().is_err_and(|why| why.kind() == io::ErrorKind::NotFound) {
            return Ok(None);
        }
        let index = open(&folder.join(INDEX))
            .and_then(|file| Ok(serde_json::from_reader(io::BufReader::new(file))?));
        let Index { about, digests } = index.map_err(|why| unreadable(folder, INDEX, why))?;
        let entry = Self { folder: folder.to_owned(), about, digests };
        entry.check().map(|()| Some(entry))
    }
}

impl<T> Entry<T> {
    /// Compares all files with what was published.
    ///
    /// # Errors
    /// Fails if the entry was changed, and then removes it, or if the machine cannot read it.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        let unreadable = |why| unreadable(&self.folder, "the folder", why);
        let is_folder = self.folder.symlink_metadata().map_err(unreadable)?.is_dir();
        let names = names(&self.folder).map_err(unreadable)?;
        if !is_folder {
            return Err(spoilt(&self.folder, "it is a link".to_owned()));
        }
        // No other file may lie there, since a compiler uses whatever it finds.
        let surplus = names.iter().find(|name| *name != INDEX && !self.digests.contains_key(*name));
        if let Some(name) = surplus {
            return Err(spoilt(
                &self.folder,
                format!("{} was added", plain::name(name.as_bytes())),
            ));
        }
        self.digests.iter().try_for_each(|(name, published)| {
            let found = open(&self.folder.join(name)).and_then(digest);
            match found.map_err(|why| self::unreadable(&self.folder, name, why))? == *published {
                true => Ok(()),
                false => Err(spoilt(&self.folder, format!("{name} has another content"))),
            }
        })
    }

    /// Returns the bytes of a file, which are those that were published.
    ///
    /// # Errors
    /// Fails if the file was changed, and then removes the entry, or if the machine cannot read it.
    pub(super) fn bytes(&self, name: &str) -> Result<Vec<u8>, StoreError> {
        let mut bytes = vec![];
        let read = open(&self.folder.join(name)).and_then(|mut file| file.read_to_end(&mut bytes));
        let is_published = self
            .digests
            .get(name)
            .is_some_and(|digest| *digest == blake3::hash(&bytes).to_hex().as_str());
        match read {
            Ok(_) if is_published => Ok(bytes),
            Ok(_) => Err(spoilt(&self.folder, format!("{name} has another content"))),
            Err(why) => Err(unreadable(&self.folder, name, why)),
        }
    }
}

/// Returns the error of a file of an entry that cannot be read. The entry is removed unless the
/// machine is to blame: then it may be whole, and others use it.
fn unreadable(folder: &Path, what: &str, source: io::Error) -> StoreError {
    match blame::of(&source) {
        Blame::Machine => {
            StoreError::Read { folder: folder.to_owned(), what: what.to_owned(), source }
        }
        Blame::File => spoilt(folder, format!("{what}: {source}")),
    }
}

/// Removes an entry that cannot be trusted any more, and returns the error for it.
fn spoilt(folder: &Path, change: String) -> StoreError {
    let folder = folder.to_owned();
    match leftovers::remove(&folder) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            StoreError::Stuck { folder, change, source }
        }
        _ => StoreError::Changed { folder, change },
    }
}

/// Returns the names in a folder.
fn names(folder: &Path) -> io::Result<Vec<String>> {
    let name = |entry: io::Result<std::fs::DirEntry>| {
        Ok(entry?.file_name().to_string_lossy().into_owned())
    };
    std::fs::read_dir(folder)?.map(name).collect()
}

/// Opens a regular file; a link in its place is an error.
fn open(path: &Path) -> io::Result<File> {
    let file =
        File::options().read(true).custom_flags(libc::O_NOFOLLOW | libc::O_NONBLOCK).open(path)?;
    let is_file = file.metadata()?.is_file();
    is_file.then_some(file).ok_or_else(|| io::Error::other("it is no regular file"))
}

fn digest(file: File) -> io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(file)?;
    Ok(hasher.finalize().to_hex().to_string())
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    /// An entry of two files.
    fn entry() -> (tempfile::TempDir, PathBuf) {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("entry");
        publish(&folder, &"two letters".to_owned(), |fresh| {
            std::fs::write(fresh.join("a"), "aaaa")?;
            std::fs::write(fresh.join("b"), "bbbb")
        })
        .unwrap();
        (home, folder)
    }

    /// Checks that after `change` the entry is refused and removed, and can be published again.
    fn check(what: &str, change: impl Fn(&Path)) {
        let (_home, folder) = entry();
        let taken = Entry::<String>::take(&folder).unwrap().unwrap();
        assert_eq!(
            (taken.about.as_str(), taken.bytes("a").unwrap()),
            ("two letters", b"aaaa".to_vec())
        );
        change(&folder);
        let refused = Entry::<String>::take(&folder).map(|taken| taken.is_some());
        assert!(matches!(refused, Err(StoreError::Changed { .. })), "{what}: {refused:?}");
        assert!(folder.symlink_metadata().is_err(), "{what}: it is still there");
        publish(&folder, &"again".to_owned(), |fresh| std::fs::write(fresh.join("a"), "aaaa"))
            .unwrap();
        assert_eq!(Entry::<String>::take(&folder).unwrap().unwrap().about, "again", "{what}");
    }

    #[test]
    fn every_change_is_found() {
        check("a byte flipped", |folder| std::fs::write(folder.join("a"), "aaab").unwrap());
        check("a file truncated", |folder| std::fs::write(folder.join("a"), "aaa").unwrap());
        check("a file emptied", |folder| std::fs::write(folder.join("b"), "").unwrap());
        check("a file deleted", |folder| std::fs::remove_file(folder.join("b")).unwrap());
        check("a file added", |folder| std::fs::write(folder.join("libcases2.rlib"), "x").unwrap());
        check("a link with the same content", |folder| {
            std::fs::rename(folder.join("a"), folder.with_file_name("away")).unwrap();
            symlink(folder.with_file_name("away"), folder.join("a")).unwrap();
        });
        check("a link to the whole", |folder| {
            std::fs::rename(folder, folder.with_file_name("away")).unwrap();
            symlink(folder.with_file_name("away"), folder).unwrap();
        });
        check("a folder instead of a file", |folder| {
            std::fs::remove_file(folder.join("a")).unwrap();
            std::fs::create_dir(folder.join("a")).unwrap();
        });
        check("no index", |folder| std::fs::remove_file(folder.join(INDEX)).unwrap());
        check("half an index", |folder| std::fs::write(folder.join(INDEX), "{\"about\":").unwrap());
        check("emptied", |folder| {
            leftovers::remove(folder).unwrap();
            std::fs::create_dir(folder).unwrap();
        });
    }

    #[test]
    fn a_change_after_it_was_taken_is_found() {
        let (_home, folder) = entry();
        let taken = Entry::<String>::take(&folder).unwrap().unwrap();
        taken.check().unwrap();
        std::fs::write(folder.join("a"), "aaab").unwrap();
        assert!(taken.bytes("a").is_err());
        let (_home, folder) = entry();
        let taken = Entry::<String>::take(&folder).unwrap().unwrap();
        std::fs::write(folder.join("b"), "b").unwrap();
        assert!(taken.check().is_err());
    }

    #[test]
    fn a_machine_that_fails_to_read_costs_no_entry() {
        let (_home, folder) = entry();
        let error = |code| unreadable(&folder, "program", io::Error::from_raw_os_error(code));
        for code in [libc::EMFILE, libc::EIO, libc::ENOMEM] {
            assert!(matches!(error(code), StoreError::Read { .. }), "{code}");
            assert!(folder.is_dir(), "{code}");
        }
        assert!(matches!(error(libc::ENOENT), StoreError::Changed { .. }));
        assert!(!folder.exists());
    }

    #[test]
    fn nothing_is_published_where_filling_fails() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("entry");
        let failed = publish(&folder, &0, |_| Err(io::ErrorKind::StorageFull.into()));
        assert!(matches!(failed, Err(StoreError::Write { .. })), "{failed:?}");
        assert!(Entry::<u32>::take(&folder).unwrap().is_none());
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
    }
}
