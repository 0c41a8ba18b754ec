//! Folders that a live process holds by a lock. The next run removes the folders whose process was
//! killed.
//!
//! A folder is removed only if all of this holds: its name begins with the prefix, it is a folder
//! and no link, it belongs to this user, it bears the mark (if its kind has one) or is empty, and
//! nobody holds its lock. The lock goes away with its process, however that ends.

use std::fs::{File, Metadata, Permissions, TryLockError};
use std::io;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::{Mode, OFlags};

mod remove;

pub use remove::remove;

/// Name and content of the file that marks a folder as ours.
const MARK: (&str, &str) = (
    ".grader",
    "This folder belongs to a run of grader. A later run removes it if it was left behind.\n",
);

/// The time for which a folder is kept if the file system has no locks.
const WITHOUT_LOCKS: Duration = Duration::from_secs(24 * 60 * 60);

/// The properties that identify a folder as the grader's.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The beginning of the name.
    pub prefix: &'static str,
    /// Whether the folder bears the mark, which is needed if other programs create folders there
    /// too.
    pub is_marked: bool,
    /// Permissions of the folder.
    pub mode: u32,
}

/// A folder that this process holds by a lock. It is removed with its content when this is dropped.
#[derive(Debug)]
pub struct Held {
    path: PathBuf,
    /// `None` if the file system has no locks.
    _lock: Option<File>,
}

impl Held {
    /// Creates a folder in `parent`, locks it, and marks it if its kind is marked.
    ///
    /// # Errors
    /// Fails if the file system does.
    pub fn new(parent: &Path, kind: Kind) -> io::Result<Self> {
        loop {
            let mut builder = tempfile::Builder::new();
            builder.prefix(kind.prefix).permissions(Permissions::from_mode(kind.mode));
            let path = builder.tempdir_in(parent)?.keep();
            // Another run may take it for a leftover in the moment before it is locked.
            let folder = match open(&path) {
                Err(why) if why.kind() == io::ErrorKind::NotFound => continue,
                opened => opened?,
            };
            let lock = match folder.try_lock() {
                Ok(()) if is_at(&folder, &path) => Some(folder),
                Err(TryLockError::Error(_)) => None,
                Ok(()) | Err(TryLockError::WouldBlock) => continue,
            };
            let held = Self { path, _lock: lock };
            if kind.is_marked {
                std::fs::write(held.path.join(MARK.0), MARK.1)?;
            }
            return Ok(held);
        }
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Held {
    /// Removes the folder. Anything that cannot be removed stays for the next run.
    fn drop(&mut self) {
        let _ = remove_marked_last(&self.path);
    }
}

/// Removes a folder, with its mark last. A run that is killed meanwhile then leaves a folder that
/// the next run still recognises.
fn remove_marked_last(path: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(path)? {
        let entry = entry?;
        if entry.file_name() != MARK.0 {
            remove(&entry.path())?;
        }
    }
    remove(path)
}

/// Removes the folders that killed runs left in `parent`, and returns their number.
///
/// # Errors
/// Fails if `parent` cannot be listed. A folder that cannot be removed stays and is not counted.
pub fn clear(parent: &Path, kind: Kind) -> io::Result<usize> {
    let left = left_behind(parent, kind)?;
    Ok(left.into_iter().filter(|left| remove_marked_last(&left.path).is_ok()).count())
}

/// A folder that a killed run left. No other run takes it while this lives.
#[derive(Debug)]
pub struct Left {
    /// The path of the folder.
    pub path: PathBuf,
    _lock: File,
}

/// Returns the folders that killed runs left in `parent`, sorted by path.
///
/// # Errors
/// Fails if `parent` cannot be listed.
pub fn left_behind(parent: &Path, kind: Kind) -> io::Result<Vec<Left>> {
    let mut all = vec![];
    for entry in std::fs::read_dir(parent)? {
        let entry = entry?;
        if entry.file_name().as_encoded_bytes().starts_with(kind.prefix.as_bytes()) {
            // A folder that cannot be examined is not ours.
            all.extend(take(entry.path(), kind).ok().flatten());
        }
    }
    all.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(all)
}

/// Locks and returns a folder if a killed run left it, else returns `None`.
fn take(path: PathBuf, kind: Kind) -> io::Result<Option<Left>> {
    let folder = open(&path)?;
    let about = folder.metadata()?;
    let is_ours = about.uid() == rustix::process::geteuid().as_raw();
    let is_known = !kind.is_marked || is_marked(&path) || is_bare(&path, &about, kind);
    if !is_ours || !is_known {
        return Ok(None);
    }
    let is_left_behind = match folder.try_lock() {
        Ok(()) => is_at(&folder, &path),
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => {
            about.modified()?.elapsed().is_ok_and(|age| age > WITHOUT_LOCKS)
        }
    };
    Ok(is_left_behind.then_some(Left { path, _lock: folder }))
}

/// Opens a folder. Anything else is an error, and a link is not followed.
fn open(path: &Path) -> io::Result<File> {
    let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::NOFOLLOW | OFlags::CLOEXEC;
    Ok(rustix::fs::open(path, flags, Mode::empty())?.into())
}

/// Returns whether `path` still names the open folder.
fn is_at(folder: &File, path: &Path) -> bool {
    let (Ok(here), Ok(there)) = (folder.metadata(), path.symlink_metadata()) else { return false };
    (here.dev(), here.ino()) == (there.dev(), there.ino())
}

/// Returns whether a folder is empty and has the permissions of its kind. Its process was then
/// killed before it wrote the mark, or after it removed the mark.
fn is_bare(path: &Path, about: &Metadata, kind: Kind) -> bool {
    about.mode() & 0o7777 == kind.mode
        && std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

fn is_marked(path: &Path) -> bool {
    let file = path.join(MARK.0);
    let is_file = file
        .symlink_metadata()
        .is_ok_and(|about| about.is_file() && about.len() == MARK.1.len() as u64);
    is_file && std::fs::read(file).is_ok_and(|text| text == MARK.1.as_bytes())
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    const OURS: Kind = Kind { prefix: "grader-", is_marked: true, mode: 0o700 };

    /// Returns a folder as a killed process leaves it: complete, but not locked.
    fn abandoned(parent: &Path) -> PathBuf {
        let held = Held::new(parent, OURS).unwrap();
        std::fs::create_dir(held.path.join("1")).unwrap();
        std::fs::write(held.path.join("1/scene.json"), "{}").unwrap();
        let path = held.path.clone();
        let copy = parent.join("grader-left");
        std::fs::rename(&path, &copy).unwrap();
        drop(held);
        copy
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn what_nobody_holds_is_removed() {
        let home = tempfile::tempdir().unwrap();
        let left = abandoned(home.path());
        assert_eq!(names(home.path()), ["grader-left"]);
        assert_eq!(clear(home.path(), OURS).unwrap(), 1);
        assert!(!left.exists());
    }

    #[test]
    fn what_is_held_stays_until_it_is_dropped() {
        let home = tempfile::tempdir().unwrap();
        let held = Held::new(home.path(), OURS).unwrap();
        assert_eq!(clear(home.path(), OURS).unwrap(), 0);
        assert!(held.path().is_dir());
        drop(held);
        assert_eq!(names(home.path()), [""; 0]);
    }

    #[test]
    fn what_is_not_ours_stays() {
        let home = tempfile::tempdir().unwrap();
        let left = abandoned(home.path());
        // No mark; another text in the mark; a mark behind a link; a link to a folder of ours; a
        // file; another name.
        for name in ["grader-results", "grader-other", "grader-linked-mark", "other"] {
            std::fs::create_dir(home.path().join(name)).unwrap();
        }
        std::fs::write(home.path().join("grader-other").join(MARK.0), "mine").unwrap();
        std::fs::write(home.path().join("other").join(MARK.0), MARK.1).unwrap();
        symlink(left.join(MARK.0), home.path().join("grader-linked-mark").join(MARK.0)).unwrap();
        symlink(home.path().join("other"), home.path().join("grader-link")).unwrap();
        std::fs::write(home.path().join("grader-file"), "").unwrap();
        let mut expected = names(home.path());
        expected.retain(|name| name != "grader-left");
        assert_eq!(clear(home.path(), OURS).unwrap(), 1);
        assert_eq!(names(home.path()), expected);
        assert!(
            home.path().join("other").join(MARK.0).exists(),
            "the target of a link was emptied"
        );
    }

    #[test]
    fn an_empty_folder_of_a_process_that_was_killed_before_it_made_the_mark_is_cleared() {
        let home = tempfile::tempdir().unwrap();
        let make = |name: &str, mode| {
            std::fs::create_dir(home.path().join(name)).unwrap();
            std::fs::set_permissions(home.path().join(name), Permissions::from_mode(mode)).unwrap();
        };
        make("grader-killed", 0o700);
        make("grader-open-to-others", 0o755);
        make("grader-with-files", 0o700);
        std::fs::write(home.path().join("grader-with-files/x"), "").unwrap();
        assert_eq!(clear(home.path(), OURS).unwrap(), 1);
        assert_eq!(names(home.path()), ["grader-open-to-others", "grader-with-files"]);
    }

    #[test]
    fn a_folder_without_a_mark_is_cleared_where_none_is_asked_for() {
        let home = tempfile::tempdir().unwrap();
        let parts = Kind { prefix: ".part-", is_marked: false, mode: 0o755 };
        std::fs::create_dir(home.path().join(".part-x")).unwrap();
        let held = Held::new(home.path(), parts).unwrap();
        assert_eq!(clear(home.path(), parts).unwrap(), 1);
        assert!(held.path().is_dir());
        assert!(clear(&home.path().join("nowhere"), parts).is_err());
    }
}
