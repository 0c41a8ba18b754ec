//! Creates fresh folders for untrusted programs. All of them lie below one folder of this process.
//!
//! ```text
//! TMPDIR/grader-XXXXXX/        held by a lock while the process lives
//!                     .grader  the mark
//!                     0, 1 …   a folder for each run of a program
//! ```
//! [`clear_leftovers`] removes the folders of processes that were killed.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};

use crate::leftovers::{self, Held, Kind};

const ROOT: Kind = Kind { prefix: "grader-", is_marked: true, mode: 0o700 };

/// A temporary folder that untrusted programs write to. It is removed with its content when this is
/// dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// The folder of the process stays as long as one of its folders does.
    _root: Arc<Held>,
}

/// The reason why there is no temporary folder, which is never the fault of a submission.
#[derive(Debug, thiserror::Error)]
#[error(
    "no temporary folder can be made in {}: {source}; make room there, or set TMPDIR to a folder \
        that can be written",
    .place.display()
)]
pub struct FolderError {
    /// The folder of temporary files: TMPDIR, or the system's.
    pub place: PathBuf,
    /// The error of the system.
    pub source: io::Error,
}

impl Folder {
    /// Creates an empty folder.
    ///
    /// # Errors
    /// Fails if the folder of temporary files is missing, full or closed.
    pub fn new() -> Result<Self, FolderError> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let place = std::env::temp_dir();
        let make = || {
            let root = root(&place)?;
            let path = root.path().join(NEXT.fetch_add(1, Ordering::Relaxed).to_string());
            std::fs::create_dir(&path)?;
            Ok(Self { path, _root: root })
        };
        make().map_err(|source| FolderError { place: place.clone(), source })
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Folder {
    /// Removes the folder. Anything that cannot be removed goes with the folder of the process, or
    /// in the next run.
    fn drop(&mut self) {
        let _ = leftovers::remove(&self.path);
    }
}

/// Removes the temporary folders of runs that were killed.
pub fn clear_leftovers() {
    // A folder that cannot be listed may still accept new folders. If it does not, creating the
    // first one reports that.
    let _ = leftovers::clear(&std::env::temp_dir(), ROOT);
}

/// Returns the folder of this process, and creates it if none is in use.
fn root(place: &Path) -> io::Result<Arc<Held>> {
    static CURRENT: Mutex<Weak<Held>> = Mutex::new(Weak::new());
    let mut current = CURRENT.lock().unwrap_or_else(PoisonError::into_inner);
    let held = match current.upgrade() {
        // A process that cleans up temporary files may have removed it.
        Some(held) if held.path().is_dir() => held,
        _ => Arc::new(Held::new(place, ROOT)?),
    };
    *current = Arc::downgrade(&held);
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_fresh_and_go_away() {
        let (one, other) = (Folder::new().unwrap(), Folder::new().unwrap());
        assert_ne!(one.path(), other.path());
        assert_eq!(std::fs::read_dir(one.path()).unwrap().count(), 0);
        let root = one.path().parent().unwrap().to_owned();
        assert!(
            root.file_name().unwrap().to_string_lossy().starts_with("grader-"),
            "{}",
            root.display()
        );
        std::fs::write(one.path().join("x"), "").unwrap();
        let path = one.path().to_owned();
        drop(one);
        assert!(!path.exists() && root.exists(), "the root stays while a folder of it is in use");
    }
}
