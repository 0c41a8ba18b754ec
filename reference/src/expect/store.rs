//! Writes a set of files as a whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::Expected;

/// Why a set of files was not written. The files are then as they were.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}; no file of the set was changed", path.display())]
pub struct StoreError {
    /// The file that failed.
    pub path: PathBuf,
    /// What the file system says.
    pub source: io::Error,
}

/// Replaces every one of `files`, or none. Returns how many were replaced.
///
/// All files are written and synced beside their targets before the first one is renamed, so that a full
/// disk changes nothing. If a rename fails, the files before it get their old content back. A process
/// that is killed among the renames leaves old and new answers; their digests tell them apart.
///
/// # Errors
/// [`StoreError`].
pub fn write_all<'a>(files: impl IntoIterator<Item = &'a Expected>) -> Result<usize, StoreError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |source| StoreError { path, source }
    };
    let mut parts = vec![];
    for file in files {
        parts.push((file, part(file).map_err(failed(&file.path))?, fs::read(&file.path).ok()));
    }
    let mut replaced: Vec<(&Path, Option<Vec<u8>>)> = vec![];
    for (file, part, old) in parts {
        if let Err(why) = part.persist(&file.path) {
            replaced.iter().for_each(|(path, old)| restore(path, old.as_deref()));
            return Err(failed(&file.path)(why.error));
        }
        replaced.push((&file.path, old));
    }
    Ok(replaced.len())
}

/// Writes the file under a temporary name beside its target.
fn part(file: &Expected) -> io::Result<NamedTempFile> {
    let folder = file.path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut part = tempfile::Builder::new().prefix(".part-").tempfile_in(folder)?;
    part.write_all(&file.bytes)?;
    part.as_file().set_permissions(permissions(&file.path))?;
    part.as_file().sync_all()?;
    Ok(part)
}

/// The permissions of the file that is replaced, otherwise those of a file that everybody may read.
fn permissions(path: &Path) -> fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    fs::metadata(path).map_or_else(|_| PermissionsExt::from_mode(0o644), |about| about.permissions())
}

/// Gives a file its old content back, or removes it where there was none. A failure here leaves a stale
/// answer, which its digest gives away.
fn restore(path: &Path, old: Option<&[u8]>) {
    let _ = match old {
        Some(old) => fs::write(path, old),
        None => fs::remove_file(path),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(folder: &Path, name: &str, text: &str) -> Expected {
        Expected { path: folder.join(name), bytes: text.as_bytes().to_vec() }
    }

    #[test]
    fn a_set_is_written_as_a_whole() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a"), "old").unwrap();
        let set = [file(folder.path(), "a", "new a"), file(folder.path(), "b", "new b")];
        assert_eq!(write_all(&set).unwrap(), 2);
        assert!(set.iter().all(Expected::is_stored));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    /// `b` is a folder with something in it, which no file replaces; `d` lies in a folder that is not there.
    #[test]
    fn a_file_that_cannot_be_written_changes_no_other() {
        for unwritable in ["b", "no/d"] {
            let folder = tempfile::tempdir().unwrap();
            fs::create_dir_all(folder.path().join("b/c")).unwrap();
            fs::write(folder.path().join("a"), "old").unwrap();
            let set = ["a", "new", unwritable].map(|name| file(folder.path(), name, "new"));
            let error = write_all(&set).unwrap_err();
            assert_eq!(error.path, folder.path().join(unwritable));
            assert_eq!(fs::read_to_string(folder.path().join("a")).unwrap(), "old", "{unwritable}");
            let mut left: Vec<_> =
                fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
            left.sort();
            assert_eq!(left, ["a", "b"], "{unwritable}");
        }
    }
}
