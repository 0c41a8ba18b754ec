//! The work folder of a program, as the grader sees it while the program runs and afterwards.

use std::os::fd::{AsRawFd, OwnedFd};
use std::path::{Path, PathBuf};

/// A work folder.
///
/// Where there are namespaces, it is a file system in memory of a fixed size, which lasts as long
/// as this value does and which no other process can reach. Elsewhere it is the folder of the call.
#[derive(Debug)]
pub struct Work {
    path: PathBuf,
    /// The root of the file system in memory.
    in_memory: Option<OwnedFd>,
}

impl Work {
    /// Returns the folder of a call whose program ran in `in_memory`, or in `folder` itself.
    pub(super) fn new(folder: &Path, in_memory: Option<OwnedFd>) -> Self {
        let path = match &in_memory {
            Some(root) => format!("/proc/self/fd/{}", root.as_raw_fd()).into(),
            None => folder.to_owned(),
        };
        Self { path, in_memory }
    }

    /// Returns a path to the folder for this process, which is valid as long as this value lives.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns whether the folder has a size of its own, so that no other program can fill it.
    pub(super) fn has_fixed_size(&self) -> bool {
        self.in_memory.is_some()
    }
}
