//! Resolves the names of files.

use std::fs::{self, FileType};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Largest number of symbolic links that are followed. A longer chain counts as a circle, as on
/// Linux.
const MAX_LINKS: usize = 40;

/// The target of a file name after all symbolic links have been followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A path at which nothing exists yet. The folder around it may be missing as well.
    Free(PathBuf),
    /// The path of a regular file that is not a link.
    File(PathBuf),
    /// A folder.
    Folder,
    /// The number of a descriptor that this process has open. `/dev/stdin` is such a name, and so
    /// is the `/dev/fd/63` of a shell.
    Descriptor(u32),
    /// A pipe.
    Pipe,
    /// A device that is read and written byte by byte, such as `/dev/null` or a terminal.
    Device,
    /// A disk.
    Disk,
    /// A socket, or a kind of file that only this system has.
    Other,
}

impl Place {
    /// Returns the target of `name`. Nothing is opened.
    ///
    /// # Errors
    /// The file system fails, links lead in a circle, or a name such as `x/` names a folder that
    /// does not exist.
    pub fn of(name: &Path) -> io::Result<Self> {
        let mut path = name.to_owned();
        for _ in 0..=MAX_LINKS {
            if let Some(number) = descriptor(&path) {
                return Ok(Self::Descriptor(number));
            }
            let found = match fs::symlink_metadata(&path) {
                Err(why)
                    if matches!(why.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) =>
                {
                    return Self::free(path);
                }
                found => found?.file_type(),
            };
            if !found.is_symlink() {
                return Ok(Self::of_kind(found, path));
            }
            path = folder_of(&path).join(fs::read_link(&path)?);
        }
        Err(io::Error::new(ErrorKind::InvalidInput, "its symbolic links lead in a circle"))
    }

    fn free(path: PathBuf) -> io::Result<Self> {
        let is_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/");
        if is_folder || path.file_name().is_none() {
            return Err(io::Error::new(
                ErrorKind::NotFound,
                "this is the name of a folder, and there is no such folder",
            ));
        }
        Ok(Self::Free(path))
    }

    fn of_kind(found: FileType, path: PathBuf) -> Self {
        if found.is_file() {
            return Self::File(path);
        }
        if found.is_dir() {
            return Self::Folder;
        }
        Self::special(found)
    }

    #[cfg(unix)]
    fn special(found: FileType) -> Self {
        use std::os::unix::fs::FileTypeExt;
        match () {
            () if found.is_fifo() => Self::Pipe,
            () if found.is_char_device() => Self::Device,
            () if found.is_block_device() => Self::Disk,
            () => Self::Other,
        }
    }

    #[cfg(not(unix))]
    fn special(_: FileType) -> Self {
        Self::Other
    }
}

/// Returns whether `name` is `-`, the name of a standard stream.
pub fn is_standard(name: &Path) -> bool {
    name == Path::new("-")
}

/// Returns whether `name` is standard output: `-`, `/dev/stdout`, or another name of it.
pub fn is_stdout(name: &Path) -> bool {
    is_standard(name) || matches!(Place::of(name), Ok(Place::Descriptor(1)))
}

/// Returns whether `name` is a stream, a pipe or a device. Such names do not end in a format.
pub fn is_stream(name: &Path) -> bool {
    is_standard(name)
        || matches!(Place::of(name), Ok(Place::Descriptor(_) | Place::Pipe | Place::Device))
}

/// Returns the folder around `path`, which is `.` for a bare name.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Returns the number of the open descriptor that `path` names: 63 for `/proc/self/fd/63`.
///
/// The link itself must not be followed: it leads to the file, not to the open file with its
/// position.
fn descriptor(path: &Path) -> Option<u32> {
    let number = path.file_name()?.to_str()?.parse().ok()?;
    let folder = fs::canonicalize(folder_of(path)).ok()?;
    let is_own = |descriptors: &str| fs::canonicalize(descriptors).is_ok_and(|own| own == folder);
    ["/dev/fd", "/proc/self/fd", "/proc/thread-self/fd"].into_iter().any(is_own).then_some(number)
}
