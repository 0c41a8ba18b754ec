//! A file to be stored beside the cases.

use std::path::{Path, PathBuf};

/// A file to be stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// The path of the file.
    pub path: PathBuf,
    /// The bytes of the file.
    pub bytes: Vec<u8>,
}

impl Expected {
    /// Returns the file in the form that [`cases::files::write_all`] takes.
    pub fn as_output(&self) -> (&Path, &[u8]) {
        (&self.path, &self.bytes)
    }

    /// Returns whether a file with exactly these bytes is stored at the path.
    pub fn is_stored(&self) -> bool {
        cases::files::read(&self.path, self.bytes.len() as u64)
            .is_ok_and(|stored| stored == self.bytes)
    }
}
