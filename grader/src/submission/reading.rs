//! Reads untrusted files: follows no link, waits for no pipe, and reads no more than a limit.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use super::limits::Excess;

/// The reason why a file was not read. Its text completes "the file ...".
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The path leads to a link.
    #[error("is a link; put the file itself there")]
    Link,
    /// The path leads to a folder, pipe, socket or device.
    #[error("is no regular file")]
    NotRegular,
    /// The file is larger than the limit.
    #[error("{0}")]
    TooLarge(Excess),
    /// The file is not text.
    #[error("is not UTF-8 text (line {line}); save it as UTF-8 in your editor")]
    NotText {
        /// The line with the first byte that is wrong, counted from 1.
        line: usize,
    },
    /// The system reports an error. [`crate::blame::of`] says who is to blame.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
}

/// Opens a regular file without following a link at the end of `path` or waiting for a pipe.
///
/// # Errors
/// Fails if `path` leads to anything else, or if the system reports an error.
pub fn open_regular(path: &Path) -> Result<File, ReadError> {
    open(path, libc::O_NOFOLLOW)
}

/// Opens a regular file. A link is followed, since the user of the grader named it.
pub(super) fn open_named(path: &Path) -> Result<File, ReadError> {
    open(path, 0)
}

fn open(path: &Path, flags: i32) -> Result<File, ReadError> {
    let mut options = OpenOptions::new();
    let file =
        options.read(true).custom_flags(flags | libc::O_NONBLOCK).open(path).map_err(|why| {
            match why.raw_os_error() {
                Some(libc::ELOOP) => ReadError::Link,
                Some(libc::ENXIO) => ReadError::NotRegular, // a socket
                _ => ReadError::Io(why),
            }
        })?;
    if file.metadata()?.is_file() { Ok(file) } else { Err(ReadError::NotRegular) }
}

/// Returns the first bytes of a regular file, at most `limit`. A link is followed.
pub(super) fn start(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = vec![];
    open_named(path)?.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads the rest of `file`, which has at most `limit` bytes.
pub(super) fn read_rest(file: File, limit: u64) -> Result<Vec<u8>, ReadError> {
    let found = file.metadata()?.len();
    if found > limit {
        return Err(ReadError::TooLarge(Excess { found: Some(found), limit }));
    }
    let mut bytes = vec![];
    file.take(limit + 1).read_to_end(&mut bytes)?;
    // The file has grown since, or is a file of the kernel that hides its size.
    if bytes.len() as u64 > limit {
        Err(ReadError::TooLarge(Excess { found: None, limit }))
    } else {
        Ok(bytes)
    }
}

/// Returns the bytes of a regular file of at most `limit` bytes.
pub(super) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    read_rest(open_regular(path)?, limit)
}

/// Returns the text of a regular file of at most `limit` bytes.
pub(super) fn read_text(path: &Path, limit: u64) -> Result<String, ReadError> {
    String::from_utf8(read_bytes(path, limit)?).map_err(|why| {
        let valid = &why.as_bytes()[..why.utf8_error().valid_up_to()];
        ReadError::NotText { line: valid.iter().filter(|byte| **byte == b'\n').count() + 1 }
    })
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::os::unix::net::UnixListener;
    use std::process::Command;

    use super::*;

    #[test]
    fn what_is_no_regular_file_is_named_and_never_waited_for() {
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| home.path().join(name);
        fs::write(at("file"), "text").unwrap();
        std::os::unix::fs::symlink(at("file"), at("link")).unwrap();
        assert!(Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
        let _listener = UnixListener::bind(at("socket")).unwrap();
        let check = |name: &str, words: &str| {
            let why = read_text(&at(name), 10).unwrap_err().to_string();
            assert!(why.contains(words), "{name}: {why}");
        };
        check("link", "is a link");
        check("pipe", "is no regular file");
        check("socket", "is no regular file");
        check(".", "is no regular file");
        check("missing", "cannot be read: No such file");
        assert!(matches!(read_text(Path::new("/dev/zero"), 10), Err(ReadError::NotRegular)));
        assert_eq!(read_text(&at("file"), 10).unwrap(), "text");
        assert!(open_named(&at("link")).is_ok());
    }

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("file");
        fs::write(&path, "12345").unwrap();
        assert_eq!(read_bytes(&path, 5).unwrap(), b"12345");
        assert_eq!(
            read_bytes(&path, 4).unwrap_err().to_string(),
            "has 5 bytes; at most 4 bytes are read"
        );
        let hidden = read_bytes(Path::new("/proc/self/status"), 4).unwrap_err();
        assert_eq!(hidden.to_string(), "has more than 4 bytes; at most 4 bytes are read");
        fs::write(&path, b"a\nb\xef").unwrap();
        let why = read_text(&path, 5).unwrap_err().to_string();
        assert!(why.contains("not UTF-8 text (line 2)"), "{why}");
    }
}
