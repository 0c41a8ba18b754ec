//! The messages between the grader and the processes that start a program.
//!
//! Each run has a stream socket of its own. The grader writes one [`Request`]; the init and the
//! program write [`Message`]s. A message is its length, four bytes, and JSON.

use std::ffi::OsString;
use std::io::{self, IoSlice, Read, Write};
use std::mem::MaybeUninit;
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::Duration;

use rustix::net::{SendAncillaryBuffer, SendAncillaryMessage, SendFlags, sendmsg};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::super::access::Access;
use super::super::layers::Layers;

/// Largest message, in bytes. The arguments of a program are the longest part of a request.
const MOST: u32 = 4 << 20;

/// A program to start, and what it may do.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Request {
    /// The layers, all of which must be in force before the program starts.
    pub layers: Layers,
    /// The program; `None` only tries the layers.
    pub program: Option<Start>,
    /// The paths that exist for the program.
    pub access: Vec<Access>,
    /// The folder that is a file system in memory for the program, as a resolved path, and its size
    /// in bytes.
    pub in_memory: Option<(PathBuf, u64)>,
}

/// The start of a program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Start {
    pub program: PathBuf,
    pub args: Vec<OsString>,
    pub environment: Vec<(OsString, OsString)>,
    pub folder: PathBuf,
    /// The numbers of the system's limits, each with its soft and its hard value.
    pub limits: Vec<(u32, u64, u64)>,
}

/// A step in the life of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Message {
    /// The init is ready; it is the sender.
    Ready,
    /// The program, which is the sender, is about to start.
    Starting,
    /// The program did not start.
    NotStarted(Failure),
    /// The program has ended.
    Ended(Ended),
}

/// The step that failed, with the error of the system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Failure {
    /// The step; `None` if the layers are in force and the system refused the program itself.
    pub step: Option<String>,
    /// The number of the error, if the system gave one.
    pub code: Option<i32>,
    /// The error in words.
    pub says: String,
}

/// The end of a program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ended {
    /// The exit code, or the signal that ended it.
    pub end: Result<i32, i32>,
    /// User and system time of the program and of all its processes that have ended.
    pub cpu: Duration,
    /// Largest resident size of one process, in bytes.
    pub max_resident: u64,
}

impl Failure {
    /// Returns the failure of `step`.
    pub(crate) fn of(step: impl Into<String>, why: &io::Error) -> Self {
        Self { step: Some(step.into()), ..Self::of_program(why) }
    }

    /// Returns the refusal of the program itself.
    pub(crate) fn of_program(why: &io::Error) -> Self {
        Self { step: None, code: why.raw_os_error(), says: why.to_string() }
    }

    /// Returns the error of the system.
    pub(crate) fn error(&self) -> io::Error {
        match (&self.step, self.code) {
            (None, Some(code)) => io::Error::from_raw_os_error(code),
            (None, None) => io::Error::new(io::ErrorKind::InvalidInput, self.says.clone()),
            (Some(step), _) => io::Error::other(format!("{step}: {}", self.says)),
        }
    }
}

/// Writes a message.
///
/// # Errors
/// Fails if the other side is gone, or if the message is too long.
pub(crate) fn send(mut to: impl Write, message: &impl Serialize) -> io::Result<()> {
    to.write_all(&encoded(message)?)
}

fn encoded(message: &impl Serialize) -> io::Result<Vec<u8>> {
    let text = serde_json::to_vec(message).map_err(io::Error::other)?;
    let length = u32::try_from(text.len()).ok().filter(|length| *length <= MOST);
    let length = length.ok_or_else(|| io::Error::from_raw_os_error(libc::E2BIG))?;
    Ok([&length.to_le_bytes()[..], &text].concat())
}

/// Writes a message, with a descriptor if there is one.
///
/// # Errors
/// Fails if the other side is gone, or if the message is too long.
pub(crate) fn send_with(
    to: &UnixStream,
    message: &impl Serialize,
    descriptor: Option<OwnedFd>,
) -> io::Result<()> {
    let bytes = encoded(message)?;
    let all = descriptor.as_ref().map(AsFd::as_fd);
    let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(1))];
    let mut ancillary = SendAncillaryBuffer::new(&mut space);
    if all.is_some() {
        ancillary.push(SendAncillaryMessage::ScmRights(all.as_slice()));
    }
    // The descriptor goes with the first byte.
    let sent = sendmsg(to, &[IoSlice::new(&bytes)], &mut ancillary, SendFlags::NOSIGNAL)?;
    (&*to).write_all(bytes.get(sent..).unwrap_or_default())
}

/// Reads a message.
///
/// # Errors
/// Fails if the other side is gone, or sends something else.
pub(crate) fn receive<T: DeserializeOwned>(mut from: impl Read) -> io::Result<T> {
    let mut length = [0; 4];
    from.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length > MOST {
        return Err(io::Error::other("a message is too long"));
    }
    let mut text = vec![0; length as usize];
    from.read_exact(&mut text)?;
    serde_json::from_slice(&text).map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_through_and_long_ones_are_refused() {
        let mut pipe = Vec::new();
        let failure = Failure::of("mount", &io::Error::from_raw_os_error(libc::EPERM));
        send(&mut pipe, &Message::NotStarted(failure.clone())).unwrap();
        assert_eq!(receive::<Message>(&*pipe).unwrap(), Message::NotStarted(failure));
        assert!(send(&mut pipe, &"x".repeat(MOST as usize)).is_err());
        assert!(receive::<Message>(&[255, 255, 255, 255, 1][..]).is_err());
        assert!(receive::<Message>(&[][..]).is_err());
    }
}
