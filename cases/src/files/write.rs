//! Writes whole files.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::Place;
use super::place::{folder_of, is_standard};

/// Prefix of the name of a file that is not whole yet. A process that is killed leaves such a file.
const PART: &str = ".part-";

/// Number of parts that this process has created, which keeps the names of two threads apart.
static PARTS: AtomicU64 = AtomicU64::new(0);

/// The reason why an output was not written, or not completely.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: \
    {source}{}", shown(name), if *is_untouched { "; nothing was changed" } else { "" })]
pub struct WriteError {
    /// The name that the caller passed.
    pub name: PathBuf,
    /// Whether nothing has changed. A stream, a pipe or a device may have received a part.
    pub is_untouched: bool,
    /// The error of the system.
    pub source: io::Error,
}

impl WriteError {
    /// Returns whether the cause is the name rather than the machine. See [`is_usage`].
    pub fn is_usage(&self) -> bool {
        is_usage(&self.source)
    }

    /// Returns the error of a write to `name` that has changed nothing.
    pub fn untouched(name: &Path, source: io::Error) -> Self {
        Self { name: name.to_owned(), is_untouched: true, source }
    }
}

impl From<WriteError> for io::Error {
    fn from(why: WriteError) -> Self {
        Self::new(why.source.kind(), why)
    }
}

/// Returns whether an I/O error comes from a name that cannot be a file.
///
/// Examples are a missing folder, a name that is a folder, and a missing permission. These are
/// errors of usage (exit code 2). All others, such as a full disk, are errors of the machine (exit
/// code 3).
pub fn is_usage(why: &io::Error) -> bool {
    matches!(
        why.kind(),
        ErrorKind::NotFound
            | ErrorKind::PermissionDenied
            | ErrorKind::AlreadyExists
            | ErrorKind::IsADirectory
            | ErrorKind::NotADirectory
            | ErrorKind::InvalidInput
            | ErrorKind::InvalidFilename
            | ErrorKind::ReadOnlyFilesystem
            | ErrorKind::ExecutableFileBusy
            | ErrorKind::Unsupported
    )
}

/// Writes `bytes` to the output `name`.
///
/// - `-` is standard output.
/// - A regular file is created, or replaced whole: a reader sees the old content or the new
///   content. A symbolic link is followed, and its target is replaced. The permissions are kept.
///   Other names of the file (hard links) keep the old content.
/// - A stream such as `/dev/stdout`, a pipe, or a device such as `/dev/null` is written to in
///   place. A reader that stops reading early is not an error.
///
/// # Errors
/// [`WriteError`]; a regular file then keeps its old content. A folder, a disk, a socket, and a
/// pipe without a reader are refused.
pub fn write(name: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let untouched = |source| WriteError::untouched(name, source);
    let target = Target::of(name).map_err(untouched)?;
    let poured = match target {
        Target::Stdout => pour(io::stdout().lock(), bytes),
        Target::Stderr => pour(io::stderr().lock(), bytes),
        Target::Open(path) => {
            OpenOptions::new().append(true).open(path).and_then(|file| pour(file, bytes))
        }
        Target::Pipe(path) => open_pipe(&path).map_err(untouched).map(|pipe| pour(pipe, bytes))?,
        Target::File(path) => return replace(&path, bytes).map_err(untouched),
    };
    match poured {
        Err(why) if why.kind() != ErrorKind::BrokenPipe => {
            Err(WriteError { name: name.to_owned(), is_untouched: false, source: why })
        }
        _ => Ok(()),
    }
}

/// Checks that [`write`](self::write) can write to `name`, as far as this can be known in advance.
///
/// A command calls this before work that takes minutes. Nothing is changed.
///
/// # Errors
/// See [`write`](self::write).
pub fn check(name: &Path) -> Result<(), WriteError> {
    let possible = Target::of(name).and_then(|target| match target {
        Target::File(path) => Part::beside(&path).map(drop),
        // A pipe is not opened: closing it again would end the input of its reader.
        Target::Stdout | Target::Stderr | Target::Open(_) | Target::Pipe(_) => Ok(()),
    });
    possible.map_err(|source| WriteError::untouched(name, source))
}

fn shown(name: &Path) -> String {
    if is_standard(name) { "to standard output".to_owned() } else { name.display().to_string() }
}

fn pour(mut out: impl Write, bytes: &[u8]) -> io::Result<()> {
    out.write_all(bytes).and_then(|()| out.flush())
}

/// The target of a write.
pub(super) enum Target {
    Stdout,
    Stderr,
    /// A stream or device, to which the bytes are appended.
    Open(PathBuf),
    /// A pipe that has a reader.
    Pipe(PathBuf),
    /// A regular file, which is replaced or created.
    File(PathBuf),
}

impl Target {
    pub(super) fn of(name: &Path) -> io::Result<Self> {
        let refused = |kind, why: &str| Err(io::Error::new(kind, why));
        if is_standard(name) {
            return Ok(Self::Stdout);
        }
        match Place::of(name)? {
            Place::Descriptor(1) => Ok(Self::Stdout),
            Place::Descriptor(2) => Ok(Self::Stderr),
            Place::Descriptor(_) | Place::Device => Ok(Self::Open(name.to_owned())),
            Place::Pipe => Ok(Self::Pipe(name.to_owned())),
            Place::Free(path) => match folder_of(&path) {
                folder if folder.is_dir() => Ok(Self::File(path)),
                folder => refused(
                    ErrorKind::NotFound,
                    &format!("there is no folder `{}`", folder.display()),
                ),
            },
            // Opening the file changes nothing, and checks the permission.
            Place::File(path) => {
                OpenOptions::new().write(true).open(&path).map(|_| Self::File(path))
            }
            Place::Folder => refused(ErrorKind::IsADirectory, "it is a folder"),
            Place::Disk => {
                refused(ErrorKind::InvalidInput, "it is a disk, and its content would be lost")
            }
            Place::Other => refused(ErrorKind::InvalidInput, "it is neither a file nor a pipe"),
        }
    }
}

/// Opens a named pipe. Without a reader this fails at once, because waiting could last for ever.
#[cfg(unix)]
fn open_pipe(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    let probe = OpenOptions::new().write(true).custom_flags(libc::O_NONBLOCK).open(path).map_err(
        |why| match why.raw_os_error() == Some(libc::ENXIO) {
            true => io::Error::new(
                ErrorKind::InvalidInput,
                "nobody reads from this pipe: start its reader first",
            ),
            false => why,
        },
    )?;
    // A write through the probe would fail if the reader is slow. The probe stays open until the
    // pipe is open, so that the reader does not see the end of its input in between.
    let pipe = OpenOptions::new().write(true).open(path);
    drop(probe);
    pipe
}

#[cfg(not(unix))]
fn open_pipe(path: &Path) -> io::Result<File> {
    OpenOptions::new().write(true).open(path)
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    Part::filled(path, bytes)?.rename(path)
}

/// Copies the permissions of `old` to `file`, and the owner if the system permits it.
#[cfg(unix)]
fn take_on(file: &File, old: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
    let new = file.metadata()?;
    if (new.uid(), new.gid()) != (old.uid(), old.gid()) {
        let _ = fchown(file, Some(old.uid()), Some(old.gid()));
    }
    file.set_permissions(fs::Permissions::from_mode(old.permissions().mode() & 0o777))
}

#[cfg(not(unix))]
fn take_on(file: &File, old: &Metadata) -> io::Result<()> {
    file.set_permissions(old.permissions())
}

/// A file that is not whole yet. Dropping it removes the file, unless it was renamed.
pub(super) struct Part {
    file: File,
    path: PathBuf,
    is_renamed: bool,
}

impl Part {
    /// Creates a file in the folder of `path`.
    fn beside(path: &Path) -> io::Result<Self> {
        loop {
            let name =
                format!("{PART}{}-{}", std::process::id(), PARTS.fetch_add(1, Ordering::Relaxed));
            let path = folder_of(path).join(name);
            match File::create_new(&path) {
                // A killed process with the same number has left a file of this name.
                Err(why) if why.kind() == ErrorKind::AlreadyExists => {}
                made => return Ok(Self { file: made?, path, is_renamed: false }),
            }
        }
    }

    /// Writes `bytes` beside the regular file `path`, with the permissions of the old file.
    pub(super) fn filled(path: &Path, bytes: &[u8]) -> io::Result<Self> {
        let mut part = Self::beside(path)?;
        if let Ok(old) = fs::metadata(path) {
            take_on(&part.file, &old)?;
        }
        part.file.write_all(bytes)?;
        part.file.sync_all()?;
        Ok(part)
    }

    /// Renames the file to `to`, which replaces an old file.
    pub(super) fn rename(mut self, to: &Path) -> io::Result<()> {
        fs::rename(&self.path, to)?;
        self.is_renamed = true;
        // The content is safe now. If the folder cannot be synchronised, a crash may bring the old
        // file back, which is no reason to fail.
        let _ = File::open(folder_of(to)).and_then(|folder| folder.sync_all());
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.is_renamed {
            let _ = fs::remove_file(&self.path);
        }
    }
}
