//! A fresh folder for one run, which goes away with all that a program has left there.

use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// Names that are taken away at most, so that a process which has got away cannot keep us at it for ever.
const MAX_NAMES: usize = 2_000_000;

/// Folders that we go down: few enough for the longest names and for our stack.
const MAX_DEPTH: usize = 8;

/// A temporary folder that strangers write to.
///
/// The usual way of removing a folder goes down into it, and ends the grader where a program has nested folders some
/// thousands deep. This one goes down a few: what lies deeper is brought up.
#[derive(Debug)]
pub struct Folder(PathBuf);

impl Folder {
    /// Makes one, empty.
    ///
    /// # Errors
    /// What the file system says.
    pub fn new() -> io::Result<Self> {
        Ok(Self(tempfile::tempdir()?.keep()))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    /// What cannot be removed stays, as other temporary files do.
    fn drop(&mut self) {
        let _ = remove(&self.0);
    }
}

/// Removes what is at `path`: a link itself, a folder with all that is in it.
fn remove(path: &Path) -> io::Result<()> {
    if !path.symlink_metadata()?.is_dir() {
        return std::fs::remove_file(path);
    }
    let mut done = Done::default();
    empty(path, path, 0, &mut done)?;
    while std::fs::read_dir(path)?.next().is_some() {
        empty(path, path, 0, &mut done)?;
    }
    std::fs::remove_dir(path)
}

/// What has been dealt with so far.
#[derive(Default)]
struct Done {
    n_names: usize,
    n_moved: usize,
}

/// Deletes what is in `folder`, which lies `depth` below `top`; what is too deep moves to `top`.
fn empty(folder: &Path, top: &Path, depth: usize, done: &mut Done) -> io::Result<()> {
    std::fs::set_permissions(folder, PermissionsExt::from_mode(0o700))?;
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        done.n_names += 1;
        if done.n_names > MAX_NAMES {
            return Err(io::Error::other("there is no end of names"));
        }
        let path = entry.path();
        match entry.file_type()?.is_dir() {
            false => std::fs::remove_file(path)?,
            true if depth == MAX_DEPTH => move_up(&path, top, done)?,
            true => {
                empty(&path, top, depth + 1, done)?;
                std::fs::remove_dir(path)?;
            }
        }
    }
    Ok(())
}

/// Gives `folder` a name in `top` that is not taken there. A folder that is moved must be writable itself.
fn move_up(folder: &Path, top: &Path, done: &mut Done) -> io::Result<()> {
    std::fs::set_permissions(folder, PermissionsExt::from_mode(0o700))?;
    loop {
        done.n_moved += 1;
        let place = top.join(format!(".up{}", done.n_moved));
        if place.symlink_metadata().is_err() {
            return std::fs::rename(folder, place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fills a folder and demands that nothing is left of it.
    fn check(fill: impl FnOnce(&Path)) {
        let folder = Folder::new().unwrap();
        let path = folder.path().to_owned();
        fill(&path);
        drop(folder);
        assert!(path.symlink_metadata().is_err(), "{} is left", path.display());
    }

    #[test]
    fn nothing_is_left_of_what_a_program_leaves() {
        check(|_| {});
        check(|top| {
            std::fs::create_dir_all(top.join("a/b/c")).unwrap();
            std::fs::create_dir(top.join(".up1")).unwrap();
            std::fs::write(top.join("a/b/file"), "x").unwrap();
            std::os::unix::fs::symlink("/", top.join("a/link")).unwrap();
        });
        check(|top| {
            std::fs::create_dir_all(top.join("closed/inner")).unwrap();
            for folder in [top.join("closed/inner"), top.join("closed"), top.to_owned()] {
                std::fs::set_permissions(folder, PermissionsExt::from_mode(0o000)).unwrap();
            }
        });
    }

    #[test]
    fn folders_nested_without_end_are_no_danger() {
        check(|top| {
            let inner = top.join("d");
            std::fs::create_dir(&inner).unwrap();
            for _ in 0..1000 {
                std::fs::create_dir(top.join("next")).unwrap();
                std::fs::rename(&inner, top.join("next/d")).unwrap();
                std::fs::rename(top.join("next"), &inner).unwrap();
            }
        });
    }

    #[test]
    fn a_link_in_its_place_is_not_followed() {
        let elsewhere = tempfile::tempdir().unwrap();
        std::fs::write(elsewhere.path().join("precious"), "x").unwrap();
        check(|top| {
            std::fs::remove_dir(top).unwrap();
            std::os::unix::fs::symlink(elsewhere.path(), top).unwrap();
        });
        assert!(elsewhere.path().join("precious").exists());
    }
}
