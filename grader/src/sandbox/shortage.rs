//! The shortages of the machine, with messages that name the remedy.

use std::path::PathBuf;

use super::limits::Granted;

/// Number of files, and of processes, that the machine must still be able to open and start.
pub(super) const SPARE: usize = 8;

/// A shortage of the machine. A run that ends because of it says nothing about the program.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Shortage {
    /// There is no room for files.
    #[error(
        "the file system of {} has no room for {needed} bytes ({why}): make room there, or set \
         TMPDIR",
        .place.display()
    )]
    Room {
        /// The folder in which the room is needed.
        place: PathBuf,
        /// Bytes that the step needs.
        needed: u64,
        /// The error of the system, or the room that was left.
        why: String,
    },
    /// No more files can be opened.
    #[error(
        "the machine cannot open {SPARE} more files ({0}): raise the limit (ulimit -n), or use \
         fewer --jobs"
    )]
    Descriptors(String),
    /// No more processes can be started.
    #[error(
        "the machine cannot start {SPARE} more processes ({0}): raise the limit (ulimit -u), or \
         use fewer --jobs"
    )]
    Processes(String),
    /// There is less memory than a program may use.
    #[error(
        "the machine has {} MiB of memory left, less than the {} MiB that a program may use: use \
         fewer --jobs, or a smaller --memory-limit",
        .left >> 20,
        .needed >> 20
    )]
    Memory {
        /// Bytes that were left.
        left: u64,
        /// Bytes that a program may use.
        needed: u64,
    },
    /// The system killed the program because memory ran out.
    #[error("the machine ran out of memory, and the system killed the program: use fewer --jobs")]
    Killed,
    /// The grader itself was started with less than a program may use.
    #[error("the grader was started under a limit that leaves programs {0}: raise the limit")]
    Limit(Granted),
    /// The program was not started.
    #[error("the machine could not start it: {0}")]
    NotStarted(String),
    /// Other processes kept the program from computing, although no other program of the grader
    /// ran.
    #[error(
        "the machine is too busy: in {wall} s it gave the program {cpu} s of CPU time; run again \
         when it is less busy"
    )]
    Busy {
        /// Seconds by the clock.
        wall: u64,
        /// Seconds of CPU time.
        cpu: u64,
    },
    /// Anything else that the grader or the machine could not do.
    #[error("{0}")]
    Other(String),
}
