//! Seals results with a key that no program can reach, so that nobody but the grader can write one.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::os::unix::fs::{OpenOptionsExt, PermissionsExt};
use std::path::{Path, PathBuf};

use cases::files::is_usage;

/// The number of bytes of a key.
const BYTES: usize = 32;

/// A secret key. Machines that share results share it.
#[derive(Clone)]
pub struct Key([u8; BYTES]);

impl fmt::Debug for Key {
    /// Writes no byte of the key.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Key")
    }
}

/// The reason why there is no key.
#[derive(Debug, thiserror::Error)]
pub enum KeyError {
    /// The file cannot be read or made.
    #[error("the key of the results, {}, can be neither read nor made; name another file with \
        --key", .path.display())]
    File {
        /// The file of the key.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The file is no key.
    #[error(
        "{} is no key: it has {n_bytes} bytes, and a key has {BYTES}; name another file with \
         --key, or delete it, and all results are graded again",
        .path.display()
    )]
    Malformed {
        /// The file of the key.
        path: PathBuf,
        /// The size of the file.
        n_bytes: usize,
    },
    /// Other users of the machine may read the key.
    #[error("others can read the key of the results: chmod 600 {}", .path.display())]
    Open {
        /// The file of the key.
        path: PathBuf,
    },
}

impl KeyError {
    /// Returns whether the arguments are to blame, rather than the machine.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::File { source, .. } => is_usage(source),
            Self::Malformed { .. } | Self::Open { .. } => true,
        }
    }
}

impl Key {
    /// Reads the key in the file `path`. If there is none, makes one at random.
    ///
    /// # Errors
    /// See [`KeyError`].
    pub fn open(path: &Path) -> Result<Self, KeyError> {
        let failed = |source| KeyError::File { path: path.to_owned(), source };
        if let Err(why) = path.symlink_metadata()
            && why.kind() == io::ErrorKind::NotFound
        {
            make(path).map_err(failed)?;
        }
        let file = File::open(path).map_err(failed)?;
        if file.metadata().map_err(failed)?.permissions().mode() & 0o077 != 0 {
            return Err(KeyError::Open { path: path.to_owned() });
        }
        let mut bytes = vec![];
        file.take(1 << 20).read_to_end(&mut bytes).map_err(failed)?;
        let n_bytes = bytes.len();
        let malformed = |_| KeyError::Malformed { path: path.to_owned(), n_bytes };
        bytes.try_into().map(Self).map_err(malformed)
    }

    /// Returns the seal of a result: a keyed hash of its name and its files.
    pub(super) fn seal(&self, parts: &[&[u8]]) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new_keyed(&self.0);
        for part in parts {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        hasher.finalize()
    }
}

/// Makes a file with a random key, which this user alone can read. If another process makes one at
/// the same time, that one stays.
fn make(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut bytes = [0; BYTES];
    File::open("/dev/urandom")?.read_exact(&mut bytes)?;
    let part = folder.join(format!(".key-{}", std::process::id()));
    let written = File::options()
        .write(true)
        .create_new(true)
        .mode(0o600)
        .open(&part)
        .and_then(|mut file| file.write_all(&bytes).and_then(|()| file.sync_all()))
        .and_then(|()| fs::hard_link(&part, path));
    let _ = fs::remove_file(&part); // It is missing if it could not be made.
    match written {
        Err(why) if why.kind() == io::ErrorKind::AlreadyExists && path.exists() => Ok(()),
        written => written,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_made_once_and_kept() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a/key");
        let parts: [&[u8]; 2] = [b"a", b"bc"];
        let seal = Key::open(&path).unwrap().seal(&parts);
        assert_eq!(Key::open(&path).unwrap().seal(&parts), seal);
        assert_ne!(Key::open(&path).unwrap().seal(&[b"ab", b"c"]), seal, "parts stay apart");
        assert_ne!(Key::open(&home.path().join("other")).unwrap().seal(&parts), seal);
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "nothing is left");
    }

    #[test]
    fn what_is_no_secret_or_no_key_is_refused() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("key");
        Key::open(&path).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        assert!(matches!(Key::open(&path), Err(KeyError::Open { .. })));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
        fs::write(&path, "short").unwrap();
        assert!(matches!(Key::open(&path), Err(KeyError::Malformed { n_bytes: 5, .. })));
        assert!(matches!(
            Key::open(home.path()),
            Err(KeyError::File { .. } | KeyError::Open { .. })
        ));
    }
}
