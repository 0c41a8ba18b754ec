//! Opens inputs that a person names: a file, a pipe, or `-` for standard input.
//!
//! Each input is read once and in bounded memory. A device, a socket and a folder are refused at
//! once. So is a named pipe, since its writer may never come. The pipe of a shell (`<(command)`,
//! which is `/dev/fd/63`) is open already and is read. Ctrl-C and SIGTERM end a read that waits.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Cursor, IsTerminal, Read, Seek, SeekFrom};
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use cases::files::{Place, is_standard, is_usage};

use crate::sandbox::interrupted;

/// Number of bytes at the beginning of a stream that decide how many are read in all.
pub const HEAD: u64 = 4096;
/// The interval at which a waiting read checks for an interrupt.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// A function from the first bytes of an input to the number of bytes that may be read of it.
///
/// The argument is the first [`HEAD`] bytes, or all of a shorter input. An error says why the input
/// cannot be used.
pub type Most = fn(&[u8]) -> Result<u64, String>;

/// An open input that can be read in any order.
#[derive(Debug)]
pub enum Input {
    /// A regular file.
    File(File),
    /// The content of a stream.
    Held(Cursor<Vec<u8>>),
}

/// The reason why an input cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// The name is not that of an input, or the content cannot be used.
    #[error("{}: {why}", shown(.name))]
    Refused {
        /// The name as the caller gave it.
        name: PathBuf,
        /// A description of what is there, with the remedy.
        why: String,
    },
    /// The system fails to read the input.
    #[error("{}: it cannot be read", shown(.name))]
    Io {
        /// The name as the caller gave it.
        name: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The user has interrupted the wait.
    #[error("interrupted while reading {}", shown(.name))]
    Interrupted {
        /// The name as the caller gave it.
        name: PathBuf,
    },
}

impl InputError {
    /// Returns whether the cause is the name or the content, rather than the machine.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Refused { .. } | Self::Interrupted { .. } => true,
            Self::Io { source, .. } => is_usage(source),
        }
    }
}

/// Opens the input `name`. A stream is read to its end, but no further than `most` permits.
///
/// # Errors
/// See [`InputError`].
pub fn open(name: &Path, most: Most) -> Result<Input, InputError> {
    let refused =
        |why: &str| Err(InputError::Refused { name: name.to_owned(), why: why.to_owned() });
    let failed = |source| InputError::Io { name: name.to_owned(), source };
    match place(name).map_err(failed)? {
        Place::File(path) => {
            open_file(&path).map_err(failed)?.map_or_else(|| refused("it is no longer a file"), Ok)
        }
        Place::Descriptor(0) if io::stdin().is_terminal() => {
            refused("it is a terminal: redirect it from a file or a pipe")
        }
        Place::Descriptor(0) => held(name, most, || Ok(io::stdin())),
        Place::Descriptor(_) => match opened(name).map_err(failed)? {
            Opened::Pipe => {
                let path = name.to_owned();
                held(name, most, move || File::open(path))
            }
            Opened::File => File::open(name).map(Input::File).map_err(failed),
            Opened::Other(what) => refused(what),
        },
        Place::Pipe => refused(
            "it is a named pipe, which may wait for ever: redirect standard input from it (`- < \
                PIPE`)",
        ),
        Place::Free(_) => refused("there is no such file"),
        Place::Folder => refused("it is a folder"),
        Place::Device => refused("it is a device, not a file"),
        Place::Disk => refused("it is a disk, not a file"),
        Place::Other => refused("it is a socket, not a file"),
    }
}

/// Reads all bytes of the input `name`, but no more than `most` permits.
///
/// # Errors
/// See [`InputError`].
pub fn read(name: &Path, most: Most) -> Result<Vec<u8>, InputError> {
    match open(name, most)? {
        Input::Held(bytes) => Ok(bytes.into_inner()),
        Input::File(file) => match take(file, most) {
            Ok(taken) => taken.map_err(|why| InputError::Refused { name: name.to_owned(), why }),
            Err(source) => Err(InputError::Io { name: name.to_owned(), source }),
        },
    }
}

/// Checks that two inputs are not the same stream, since the second would get nothing of it.
///
/// # Errors
/// Returns [`InputError::Refused`] for the second input if both are the same stream.
pub fn demand_two(one: &Path, other: &Path) -> Result<(), InputError> {
    match (place(one), place(other)) {
        (Ok(Place::Descriptor(a)), Ok(Place::Descriptor(b))) if a == b => {
            let why =
                "it is the other input as well, and a stream can be read only once".to_owned();
            Err(InputError::Refused { name: other.to_owned(), why })
        }
        _ => Ok(()),
    }
}

fn place(name: &Path) -> io::Result<Place> {
    if is_standard(name) { Ok(Place::Descriptor(0)) } else { Place::of(name) }
}

/// Returns how a message names the input `name`.
pub fn shown(name: &Path) -> String {
    if is_standard(name) { "standard input".to_owned() } else { name.display().to_string() }
}

/// Opens a regular file without waiting, or returns `None` if something else has just replaced it.
fn open_file(path: &Path) -> io::Result<Option<Input>> {
    let file = OpenOptions::new().read(true).custom_flags(libc::O_NONBLOCK).open(path)?;
    Ok(file.metadata()?.is_file().then_some(Input::File(file)))
}

/// The target of an open descriptor.
enum Opened {
    Pipe,
    File,
    Other(&'static str),
}

fn opened(name: &Path) -> io::Result<Opened> {
    let kind = fs::metadata(name)?.file_type();
    // The descriptor of a named pipe is a link to that name. Opening it again could wait for ever.
    let is_named = || fs::canonicalize(name).is_ok_and(|path| path.file_name() != name.file_name());
    Ok(match () {
        () if kind.is_file() => Opened::File,
        () if kind.is_fifo() && is_named() => {
            Opened::Other("it is a named pipe: redirect standard input from it (`-`)")
        }
        () if kind.is_fifo() => Opened::Pipe,
        () if kind.is_dir() => Opened::Other("it is a folder"),
        () if kind.is_socket() => Opened::Other("it is a socket, not a file"),
        () => Opened::Other("it is a device, not a file"),
    })
}

/// Reads a stream on another thread, so that this one can stop waiting for the writer.
fn held<R: Read>(
    name: &Path,
    most: Most,
    open: impl FnOnce() -> io::Result<R> + Send + 'static,
) -> Result<Input, InputError> {
    let (sender, receiver) = mpsc::channel();
    // After an interrupt the thread runs until the process ends, which is soon.
    let read = move || sender.send(open().and_then(|stream| take(stream, most)));
    let name = || name.to_owned();
    let started = std::thread::Builder::new().spawn(read);
    started.map_err(|source| InputError::Io { name: name(), source })?;
    loop {
        match receiver.recv_timeout(LOOK_EVERY) {
            Ok(Ok(Ok(bytes))) => return Ok(Input::Held(Cursor::new(bytes))),
            Ok(Ok(Err(why))) => return Err(InputError::Refused { name: name(), why }),
            Ok(Err(source)) => return Err(InputError::Io { name: name(), source }),
            Err(RecvTimeoutError::Timeout) if interrupted() => {
                return Err(InputError::Interrupted { name: name() });
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                let source = io::Error::other("the thread that reads it has ended");
                return Err(InputError::Io { name: name(), source });
            }
        }
    }
}

/// Reads all bytes of a stream. The inner error says why they cannot be used, or that there are
/// more than `most` permits.
fn take(mut stream: impl Read, most: Most) -> io::Result<Result<Vec<u8>, String>> {
    let mut bytes = vec![];
    stream.by_ref().take(HEAD).read_to_end(&mut bytes)?;
    let most = match most(&bytes) {
        Ok(most) => most,
        Err(why) => return Ok(Err(why)),
    };
    stream.take((most + 1).saturating_sub(bytes.len() as u64)).read_to_end(&mut bytes)?;
    let is_too_long = bytes.len() as u64 > most;
    Ok(if is_too_long {
        Err(format!("it has more than {most} bytes, which is the limit"))
    } else {
        Ok(bytes)
    })
}

impl Read for Input {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.read(bytes),
            Self::Held(held) => held.read(bytes),
        }
    }
}

impl Seek for Input {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::File(file) => file.seek(to),
            Self::Held(held) => held.seek(to),
        }
    }
}
