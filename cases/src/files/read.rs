//! Reads whole files. The size is checked before any of the content is held in memory.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The reason why a file is not read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// No file has this name.
    #[error("there is no such file")]
    Missing,
    /// The name is that of a folder.
    #[error("it is a folder")]
    Folder,
    /// The name is that of a pipe, a device or a socket.
    #[error("it is not a regular file")]
    NotRegular,
    /// The file is too large.
    #[error("it has {found} bytes; at most {limit} are read")]
    TooLarge {
        /// Size of the file in bytes.
        found: u64,
        /// Largest size that is read, in bytes.
        limit: u64,
    },
    /// The file is not UTF-8; its first wrong byte has this index.
    #[error("it is not a text: byte {0} is not UTF-8")]
    NotText(usize),
    /// The system reports this error.
    #[error("it cannot be read: {0}")]
    Io(#[source] io::Error),
}

impl ReadError {
    fn of(why: io::Error) -> Self {
        if why.kind() == ErrorKind::NotFound { Self::Missing } else { Self::Io(why) }
    }
}

/// Returns the bytes of the regular file at `path`, at most `limit`. Symbolic links are followed.
///
/// # Errors
/// All kinds of [`ReadError`] except [`ReadError::NotText`].
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    // The kind is checked before the file is opened, because opening a FIFO waits for its writer.
    let about = std::fs::metadata(path).map_err(ReadError::of)?;
    match () {
        () if about.is_dir() => return Err(ReadError::Folder),
        () if !about.is_file() => return Err(ReadError::NotRegular),
        () if about.len() > limit => return Err(ReadError::TooLarge { found: about.len(), limit }),
        () => {}
    }
    let mut bytes = vec![];
    File::open(path)
        .and_then(|file| file.take(limit + 1).read_to_end(&mut bytes))
        .map_err(ReadError::of)?;
    match bytes.len() as u64 {
        found if found > limit => Err(ReadError::TooLarge { found, limit }),
        _ => Ok(bytes),
    }
}

/// Returns the text of the file at `path`, which must be UTF-8 of at most `limit` bytes.
///
/// # Errors
/// [`ReadError`].
pub fn read_text(path: &Path, limit: u64) -> Result<String, ReadError> {
    String::from_utf8(read(path, limit)?)
        .map_err(|why| ReadError::NotText(why.utf8_error().valid_up_to()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_file_of_that_size_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| home.path().join(name);
        std::fs::write(at("four"), b"1\xff34").unwrap();
        std::os::unix::fs::symlink(at("four"), at("link")).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
        let refused = |path: &Path| read(path, 4).unwrap_err().to_string();
        assert_eq!(read(&at("link"), 4).unwrap(), b"1\xff34");
        assert_eq!(refused(&at("none")), "there is no such file");
        assert_eq!(refused(home.path()), "it is a folder");
        assert_eq!(refused(&at("pipe")), "it is not a regular file");
        assert_eq!(refused(Path::new("/dev/zero")), "it is not a regular file");
        assert_eq!(refused(&at("four/x")), "it cannot be read: Not a directory (os error 20)");
        assert_eq!(
            read(&at("four"), 3).unwrap_err().to_string(),
            "it has 4 bytes; at most 3 are read"
        );
        assert_eq!(
            read_text(&at("four"), 4).unwrap_err().to_string(),
            "it is not a text: byte 1 is not UTF-8"
        );
    }
}
