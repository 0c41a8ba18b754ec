//! Writes a set of files as a whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::write::{Part, Target, WriteError, write};

/// Replaces or creates every one of `files`, or none of them. Returns the number of files.
///
/// All files are written and synchronised beside their targets before the first one is renamed, so
/// that a full disk changes nothing. If a rename fails, the files before it get their old content
/// back. A process that is killed among the renames leaves some old and some new files.
///
/// # Errors
/// [`WriteError`] about the first file that failed. A name that is not a regular file is refused.
pub fn write_all<'a>(
    files: impl IntoIterator<Item = (&'a Path, &'a [u8])>,
) -> Result<usize, WriteError> {
    let mut parts = vec![];
    for (name, bytes) in files {
        let prepared =
            prepare(name, bytes).map_err(|source| WriteError::untouched(name, source))?;
        parts.push((name, prepared));
    }
    let mut replaced: Vec<(PathBuf, Option<Vec<u8>>)> = vec![];
    for (name, (path, part)) in parts {
        let old = fs::read(&path).ok();
        if let Err(source) = part.rename(&path) {
            replaced.iter().for_each(|(path, old)| restore(path, old.as_deref()));
            return Err(WriteError::untouched(name, source));
        }
        replaced.push((path, old));
    }
    Ok(replaced.len())
}

/// Writes `bytes` beside the file that `name` leads to, and returns that file's path.
fn prepare(name: &Path, bytes: &[u8]) -> io::Result<(PathBuf, Part)> {
    match Target::of(name)? {
        Target::File(path) => Part::filled(&path, bytes).map(|part| (path, part)),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file")),
    }
}

/// Restores the old content of a file, or removes the file if it is new.
///
/// The rename of another file has already failed, and the caller reports that error. A second error
/// is ignored.
fn restore(path: &Path, old: Option<&[u8]>) {
    let _ = match old {
        Some(old) => write(path, old).map_err(|why| why.source),
        None => fs::remove_file(path),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_written_as_a_whole() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, "old").unwrap();
        assert_eq!(write_all([(&*a, &b"new a"[..]), (&*b, &b"new b"[..])]).unwrap(), 2);
        assert_eq!([a, b].map(|path| fs::read_to_string(path).unwrap()), ["new a", "new b"]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    /// `b` is a folder, and `d` lies in a folder that does not exist.
    #[test]
    fn a_file_that_cannot_be_written_changes_no_other() {
        for unwritable in ["b", "no/d"] {
            let folder = tempfile::tempdir().unwrap();
            let path = |name| folder.path().join(name);
            fs::create_dir_all(path("b/c")).unwrap();
            fs::write(path("a"), "old").unwrap();
            let set = ["a", "new", unwritable].map(path);
            let error = write_all(set.iter().map(|path| (&**path, &b"new"[..]))).unwrap_err();
            assert_eq!(error.name, path(unwritable));
            assert_eq!(fs::read_to_string(path("a")).unwrap(), "old", "{unwritable}");
            let mut left: Vec<_> = fs::read_dir(folder.path())
                .unwrap()
                .map(|entry| entry.unwrap().file_name())
                .collect();
            left.sort();
            assert_eq!(left, ["a", "b"], "{unwritable}");
        }
    }
}
