//! The launcher: a process that is forked while the grader is small, and forks a nanny for each
//! run.

use std::io::{self, IoSlice, IoSliceMut};
use std::mem::MaybeUninit;
use std::os::fd::{AsFd, AsRawFd, OwnedFd};
use std::os::unix::net::UnixStream;
use std::sync::{Mutex, PoisonError};

use rustix::net::{
    AddressFamily, RecvAncillaryBuffer, RecvAncillaryMessage, RecvFlags, SendAncillaryBuffer,
    SendAncillaryMessage, SendFlags, SocketFlags, SocketType, recvmsg, sendmsg, socketpair,
};

use super::lines::Lines;
use super::{filter, nanny};
use crate::sandbox::sys;

/// The socket of the launcher; `None` before it is forked.
static LAUNCHER: Mutex<Option<OwnedFd>> = Mutex::new(None);

/// Number of descriptors that go to a nanny.
const N_LINES: usize = 5;

/// Forks the launcher, if there is none. Called when the grader begins, a start costs least: the
/// launcher is as large as the grader is now.
///
/// # Errors
/// Fails if the machine cannot start a process.
pub fn prepare() -> io::Result<()> {
    let mut launcher = LAUNCHER.lock().unwrap_or_else(PoisonError::into_inner);
    if launcher.is_none() {
        *launcher = Some(fork()?);
    }
    Ok(())
}

/// Gives the lines of a run to a new nanny. If the launcher is gone, another one is forked.
pub(super) fn hand_over(lines: Lines) -> io::Result<()> {
    let mut launcher = LAUNCHER.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(socket) = &*launcher {
        match send(socket, &lines) {
            Ok(()) => return Ok(()),
            Err(why) if why.kind() != io::ErrorKind::BrokenPipe => return Err(why),
            Err(_) => *launcher = None,
        }
    }
    let socket = launcher.insert(fork()?);
    send(socket, &lines)
}

fn fork() -> io::Result<OwnedFd> {
    let flags = SocketFlags::CLOEXEC;
    let (ours, its) = socketpair(AddressFamily::UNIX, SocketType::SEQPACKET, flags, None)?;
    match sys::fork()? {
        Some(_) => Ok(ours),
        None => {
            let done = std::panic::catch_unwind(move || serve(&its));
            sys::exit(i32::from(done.is_err()))
        }
    }
}

/// Forks a nanny for each run, until the grader is gone.
fn serve(socket: &OwnedFd) {
    // Ctrl-C goes to the grader, which ends its programs in order.
    let _ = rustix::process::setsid();
    sys::forget_children();
    sys::close_all_but(&[socket.as_raw_fd()]);
    let filters = filter::compile();
    while let Ok(Some(lines)) = receive(socket) {
        if let Ok(None) = sys::fork() {
            nanny::run(lines, &filters);
            sys::exit(0);
        }
    }
}

fn send(socket: &OwnedFd, lines: &Lines) -> io::Result<()> {
    let [stdin, stdout, stderr] = &lines.streams;
    let all = [
        lines.status.as_fd(),
        lines.failure.as_fd(),
        stdin.as_fd(),
        stdout.as_fd(),
        stderr.as_fd(),
    ];
    let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(N_LINES))];
    let mut ancillary = SendAncillaryBuffer::new(&mut space);
    ancillary.push(SendAncillaryMessage::ScmRights(&all));
    sendmsg(socket, &[IoSlice::new(&[0])], &mut ancillary, SendFlags::NOSIGNAL)?;
    Ok(())
}

/// Waits for the lines of a run. `None` if the grader is gone.
fn receive(socket: &OwnedFd) -> io::Result<Option<Lines>> {
    let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(N_LINES))];
    let mut ancillary = RecvAncillaryBuffer::new(&mut space);
    let mut byte = [0];
    let flags = RecvFlags::CMSG_CLOEXEC;
    recvmsg(socket, &mut [IoSliceMut::new(&mut byte)], &mut ancillary, flags)?;
    let mut all = Vec::new();
    for message in ancillary.drain() {
        if let RecvAncillaryMessage::ScmRights(lines) = message {
            all.extend(lines);
        }
    }
    let Ok([status, failure, streams @ ..]) = <[OwnedFd; N_LINES]>::try_from(all) else {
        return Ok(None);
    };
    Ok(Some(Lines { status: UnixStream::from(status), failure, streams }))
}
