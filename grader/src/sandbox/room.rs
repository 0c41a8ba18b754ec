//! Measures room on the file system of a work folder: what is left, what a program took, whether a
//! file still fits.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use rustix::fs::{FallocateFlags, fallocate, statvfs};
use rustix::io::Errno;

/// Largest number of names in a work folder that are counted, which is more than any honest program
/// creates.
const MAX_NAMES: u64 = 100_000;

/// An amount of disk space: bytes and files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Room {
    /// Bytes on the file system, in whole blocks.
    pub bytes: u64,
    /// Files and folders.
    pub files: u64,
}

impl Room {
    /// More than any file system has.
    pub(super) const ALL: Self = Self { bytes: u64::MAX, files: u64::MAX };

    /// Returns the lesser number of bytes, and the lesser number of files.
    pub(super) fn min(self, other: Self) -> Self {
        Self { bytes: self.bytes.min(other.bytes), files: self.files.min(other.files) }
    }

    /// Returns whether this is more than a program may take, where `bytes` is the limit.
    pub(super) fn exceeds(&self, bytes: u64) -> bool {
        self.bytes > bytes || self.files >= MAX_NAMES
    }
}

/// Returns the room that is left on the file system of `folder`, or [`Room::ALL`] if the system
/// does not say.
pub(super) fn left(folder: &Path) -> Room {
    let Ok(about) = statvfs(folder) else { return Room::ALL };
    // The system keeps some blocks for root.
    let is_root = rustix::process::geteuid().is_root();
    let blocks = if is_root { about.f_bfree } else { about.f_bavail };
    // Some file systems do not count their files.
    let files = if about.f_files == 0 { u64::MAX } else { about.f_favail };
    Room { bytes: blocks.saturating_mul(about.f_frsize), files }
}

/// Returns the room that the content of `folder` takes. Links are not followed, and at most
/// [`MAX_NAMES`] names are counted.
pub(super) fn taken(folder: &Path) -> Room {
    let mut taken = Room { bytes: 0, files: 0 };
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            taken.files += 1;
            if taken.files >= MAX_NAMES {
                return taken;
            }
            let Ok(about) = entry.metadata() else { continue };
            taken.bytes += about.blocks() * 512;
            if about.is_dir() {
                folders.push(entry.path());
            }
        }
    }
    taken
}

/// Checks that a file of `bytes` fits into `folder`, by making one and removing it again.
///
/// # Errors
/// Fails if the file cannot be made: because of a full disk, a quota, or a limit of this process.
pub(super) fn fits(folder: &Path, bytes: u64) -> io::Result<()> {
    let file = tempfile::tempfile_in(folder)?;
    match fallocate(file.as_fd(), FallocateFlags::empty(), 0, bytes.max(1)) {
        Err(Errno::OPNOTSUPP | Errno::NOSYS | Errno::INVAL) => fill(file, bytes),
        allocated => Ok(allocated?),
    }
}

fn fill(mut file: File, bytes: u64) -> io::Result<()> {
    let block = [0; 64 << 10];
    let mut left = bytes;
    while left > 0 {
        let n = left.min(block.len() as u64);
        file.write_all(&block[..n as usize])?;
        left -= n;
    }
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_in_a_folder_is_counted_without_following_links() {
        let home = tempfile::tempdir().unwrap();
        assert_eq!(taken(home.path()), Room { bytes: 0, files: 0 });
        std::fs::create_dir(home.path().join("inner")).unwrap();
        std::fs::write(home.path().join("inner/file"), vec![1; 100_000]).unwrap();
        std::os::unix::fs::symlink("/usr", home.path().join("link")).unwrap();
        let found = taken(home.path());
        assert_eq!(found.files, 3);
        assert!((100_000..200_000).contains(&found.bytes), "{found:?}");
        assert!(found.exceeds(99_999) && !found.exceeds(200_000), "{found:?}");
        assert!(
            Room { bytes: 0, files: MAX_NAMES }.exceeds(1),
            "many empty files are too much as well"
        );
    }

    #[test]
    fn a_file_fits_where_there_is_room_and_leaves_nothing() {
        let home = tempfile::tempdir().unwrap();
        assert!(left(home.path()).bytes > 1 << 20);
        fits(home.path(), 1 << 20).unwrap();
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
        assert!(fits(home.path(), 1 << 55).is_err(), "32 PiB");
        assert!(fits(&home.path().join("nowhere"), 1).is_err());
        fill(tempfile::tempfile().unwrap(), 200_000).unwrap();
        assert!(fill(File::create("/dev/full").unwrap(), 1).is_err(), "a full device");
    }
}
