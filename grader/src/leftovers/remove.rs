//! Removes a folder with everything that untrusted programs have put there: folders that are deeply
//! nested or closed, and links.
//!
//! `std::fs::remove_dir_all` holds a descriptor open for each level, so deeply nested folders
//! exhaust them. This module holds three, and goes back up by `..`. No link is followed, even if a
//! program replaces a folder by one meanwhile.

use std::ffi::{CStr, CString};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;

use rustix::fs::{AtFlags, Dir, FileType, Mode, OFlags};
use rustix::io::Errno;

/// Largest number of names that are removed. A process that still runs could otherwise add names
/// for ever.
const MAX_NAMES: usize = 2_000_000;

const FOLDER: OFlags =
    OFlags::RDONLY.union(OFlags::DIRECTORY).union(OFlags::NOFOLLOW).union(OFlags::CLOEXEC);

/// Removes the file, link or folder at `path`. A folder is removed with everything in it; the
/// target of a link stays.
///
/// # Errors
/// Fails if `path` has no last name, if the file system fails, or if there are too many names. Part
/// of the folder may be gone then.
pub fn remove(path: &Path) -> io::Result<()> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let parent =
        path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let parent = rustix::fs::open(parent, FOLDER.difference(OFlags::NOFOLLOW), Mode::empty())?;
    let name = CString::new(name.as_bytes())?;
    if is_gone(rustix::fs::unlinkat(&parent, &name, AtFlags::empty()))? {
        Ok(())
    } else {
        remove_folder(parent, name)
    }
}

/// Returns `true` if a name was removed, and `false` if it is that of a folder.
fn is_gone(removed: Result<(), Errno>) -> io::Result<bool> {
    match removed {
        Ok(()) => Ok(true),
        // For a folder, Linux returns the first code and other systems the second.
        Err(Errno::ISDIR | Errno::PERM) => Ok(false),
        Err(why) => Err(why.into()),
    }
}

/// A folder that is being emptied.
struct Level {
    name: CString,
    /// Device and inode number of the folder above, which identify it on the way back.
    above: (u64, u64),
    /// Names of the folders in it that are still there.
    folders: Vec<CString>,
}

fn remove_folder(mut here: OwnedFd, name: CString) -> io::Result<()> {
    let mut n_names = 0;
    let mut levels = vec![];
    let mut next = Some(name);
    while let Some(name) = next {
        let above = identity(&here)?;
        here = enter(&here, &name)?;
        let folders = empty(&here, &mut n_names)?;
        levels.push(Level { name, above, folders });
        next = None;
        while let Some(level) = levels.last_mut() {
            if let Some(folder) = level.folders.pop() {
                next = Some(folder);
                break;
            }
            here = leave(&here, level.above)?;
            let name = levels.pop().map(|level| level.name).unwrap_or_default();
            match rustix::fs::unlinkat(&here, &name, AtFlags::REMOVEDIR) {
                // A process that still runs has put something into it.
                Err(Errno::NOTEMPTY | Errno::EXIST) => {
                    next = Some(name);
                    break;
                }
                removed => removed?,
            }
        }
    }
    Ok(())
}

/// Opens a folder, and gives its owner all permissions if some are missing.
fn enter(above: &OwnedFd, name: &CStr) -> io::Result<OwnedFd> {
    let open = || rustix::fs::openat(above, name, FOLDER, Mode::empty());
    let folder = match open() {
        Err(Errno::ACCESS) => {
            rustix::fs::chmodat(above, name, Mode::RWXU, AtFlags::empty())?;
            open()?
        }
        opened => opened?,
    };
    rustix::fs::fchmod(&folder, Mode::RWXU)?;
    Ok(folder)
}

/// Opens the folder above. Fails if it is not the one from which the walk came.
fn leave(folder: &OwnedFd, above: (u64, u64)) -> io::Result<OwnedFd> {
    let up = rustix::fs::openat(folder, c"..", FOLDER, Mode::empty())?;
    let is_known = identity(&up)? == above;
    is_known
        .then_some(up)
        .ok_or_else(|| io::Error::other("a folder was moved while it was removed"))
}

fn identity(folder: &OwnedFd) -> io::Result<(u64, u64)> {
    let about = rustix::fs::fstat(folder)?;
    Ok((about.st_dev as u64, about.st_ino as u64))
}

/// Removes everything in `folder` except folders, and returns the names of the folders.
fn empty(folder: &OwnedFd, n_names: &mut usize) -> io::Result<Vec<CString>> {
    let mut folders = vec![];
    for entry in Dir::read_from(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        if name == c"." || name == c".." {
            continue;
        }
        *n_names += 1;
        if *n_names > MAX_NAMES {
            return Err(io::Error::other("there are too many names"));
        }
        let is_folder = entry.file_type() == FileType::Directory
            || !is_gone(rustix::fs::unlinkat(folder, name, AtFlags::empty()))?;
        folders.extend(is_folder.then(|| name.to_owned()));
    }
    Ok(folders)
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    /// Checks that nothing is left of a folder that `fill` has filled.
    fn check(fill: impl FnOnce(&Path)) {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("folder");
        std::fs::create_dir(&folder).unwrap();
        fill(&folder);
        remove(&folder).unwrap();
        assert!(folder.symlink_metadata().is_err(), "{} is left", folder.display());
    }

    #[test]
    fn nothing_is_left_of_what_a_program_leaves() {
        check(|_| {});
        check(|top| {
            std::fs::create_dir_all(top.join("a/b/c")).unwrap();
            std::fs::create_dir_all(top.join("a/d")).unwrap();
            std::fs::write(top.join("a/b/file"), "x").unwrap();
            symlink("/", top.join("a/link")).unwrap();
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
            symlink(elsewhere.path(), top).unwrap();
        });
        assert!(elsewhere.path().join("precious").exists());
    }

    #[test]
    fn what_is_not_there_is_an_error() {
        let home = tempfile::tempdir().unwrap();
        assert_eq!(
            remove(&home.path().join("nothing")).unwrap_err().kind(),
            io::ErrorKind::NotFound
        );
    }
}
