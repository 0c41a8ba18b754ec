//! This file writes files and folders of the grader's own, whole or not at all, and lists them.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How the name of a folder begins that is not published yet.
const PART: &str = ".part-";

/// Writes a file of the grader's own whole, and creates the folder around it if necessary.
///
/// A name that a person typed is for [`cases::files::write`], which creates no folder.
///
/// # Errors
/// The file system fails; the file then keeps its old content.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new("")))?;
    Ok(cases::files::write(path, bytes)?)
}

fn permissions(mode: u32) -> std::fs::Permissions {
    std::os::unix::fs::PermissionsExt::from_mode(mode)
}

/// Makes `folder` by filling a fresh neighbour and renaming it. Where another process was first, its work is kept.
///
/// # Errors
/// What `fill` or the file system says.
pub fn publish_folder(folder: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let parent = folder.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent)?;
    let fresh = tempfile::Builder::new().prefix(PART).permissions(permissions(0o755)).tempdir_in(parent)?;
    fill(fresh.path())?;
    match std::fs::rename(fresh.path(), folder) {
        Err(why) if !folder.is_dir() => Err(why),
        _ => Ok(()),
    }
}

/// Removes what [`publish_folder`] left in `folder` where its process was killed more than `age` ago; what is younger may still be filled.
///
/// # Errors
/// What the file system says.
pub fn clear_parts(folder: &Path, age: Duration) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let is_old = || {
            let about = entry.metadata()?;
            Ok(about.is_dir() && about.modified()?.elapsed().is_ok_and(|since| since > age))
        };
        if !entry.file_name().to_string_lossy().starts_with(PART) {
            continue;
        }
        match is_old().and_then(|is_old| if is_old { std::fs::remove_dir_all(entry.path()) } else { Ok(()) }) {
            // Another process clears the same.
            Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
            _ => {}
        }
    }
    Ok(())
}

/// All files below `folder`, in order.
///
/// # Errors
/// What the file system says.
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
    fn what_a_killed_process_left_goes_after_a_day() {
        let home = tempfile::tempdir().unwrap();
        let day = Duration::from_secs(24 * 60 * 60);
        for (name, age) in [(".part-old", day * 2), (".part-new", day / 2), ("whole", day * 2)] {
            std::fs::create_dir(home.path().join(name)).unwrap();
            std::fs::write(home.path().join(name).join("x"), name).unwrap();
            let modified = std::time::SystemTime::now() - age;
            std::fs::File::open(home.path().join(name)).unwrap().set_modified(modified).unwrap();
        }
        clear_parts(home.path(), day).unwrap();
        assert_eq!(below(home.path()).unwrap(), [".part-new/x", "whole/x"].map(|name| home.path().join(name)));
        assert!(clear_parts(&home.path().join("nowhere"), day).is_err());
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
