//! The lines between the grader and the processes of a run.

use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;

/// The ends of the streams of a run that the started processes hold.
#[derive(Debug)]
pub(super) struct Lines {
    /// The socket for the request and the messages.
    pub(super) status: UnixStream,
    /// Where a failure is written. The program closes it by running, so that its end means success.
    pub(super) failure: OwnedFd,
    /// Standard input, output and error of the program.
    pub(super) streams: [OwnedFd; 3],
}
