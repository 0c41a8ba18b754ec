//! Writes and lists the grader's own files and folders. Each is written whole or not at all.

use std::io;
use std::path::{Path, PathBuf};

use crate::leftovers::{self, Held, Kind};

/// The folders that are being filled and are not published yet.
pub const PARTS: Kind = Kind { prefix: ".part-", is_marked: false, mode: 0o755 };

/// Writes one of the grader's own files, and creates its folder if necessary.
///
/// Use [`cases::files::write`] for a name that a person typed: it creates no folder.
///
/// # Errors
/// Fails if the file system does. The file then keeps its old content.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("")))?;
    Ok(cases::files::write(path, bytes)?)
}

/// Creates `folder` by filling a temporary folder beside it and renaming that. If another process
/// published `folder` first, its content is kept.
///
/// # Errors
/// Fails if `fill` or the file system does. Nothing is published then.
pub fn publish_folder(folder: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let parent = folder.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent)?;
    let fresh = Held::new(parent, PARTS)?;
    fill(fresh.path())?;
    match std::fs::rename(fresh.path(), folder) {
        Err(why) if !folder.is_dir() => Err(why),
        _ => Ok(()),
    }
}

/// Removes the temporary folders that killed processes left in `folder`. A folder that a live
/// process is filling stays.
///
/// # Errors
/// Fails if `folder` cannot be listed.
pub fn clear_parts(folder: &Path) -> io::Result<()> {
    leftovers::clear(folder, PARTS).map(drop)
}

/// Returns the paths of all files below `folder`, sorted. Links to folders are followed.
///
/// # Errors
/// Fails if a folder cannot be listed.
pub fn below(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = vec![];
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { found.extend(below(&path)?) } else { found.push(path) }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_published_once_and_whole() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("a/b");
        publish_folder(&folder, |fresh| std::fs::write(fresh.join("x"), "first")).unwrap();
        publish_folder(&folder, |fresh| std::fs::write(fresh.join("x"), "second")).unwrap();
        assert_eq!(std::fs::read_to_string(folder.join("x")).unwrap(), "first");
        let failed = publish_folder(&home.path().join("c"), |_| Err(io::Error::other("no")));
        assert!(failed.is_err());
        assert_eq!(below(home.path()).unwrap(), [folder.join("x")]);
    }

    #[test]
    fn what_a_killed_process_left_goes_and_the_rest_stays() {
        let home = tempfile::tempdir().unwrap();
        for name in [".part-left", "whole"] {
            std::fs::create_dir(home.path().join(name)).unwrap();
            std::fs::write(home.path().join(name).join("x"), name).unwrap();
        }
        let filled = home.path().join("filled");
        publish_folder(&filled, |fresh| {
            std::fs::write(fresh.join("x"), "x")?;
            clear_parts(home.path())
        })
        .unwrap();
        assert_eq!(
            below(home.path()).unwrap(),
            ["filled/x", "whole/x"].map(|name| home.path().join(name))
        );
        assert!(clear_parts(&home.path().join("nowhere")).is_err());
    }

    #[test]
    fn a_file_replaces_another() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("new/x.json");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(below(home.path()).unwrap(), [path]);
    }
}
