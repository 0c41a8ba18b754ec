//! Starts programs from small processes of their own.
//!
//! ```text
//! grader ── launcher ── nanny ── init ── program
//! ```
//! - The **launcher** is forked before the grader grows, so that a start copies no page tables. It
//!   ends when the grader does.
//! - A **nanny** is forked for each run. It enters the namespaces, where there are any.
//! - The **init** is the first process in them. It makes the only files that the program sees,
//!   reports the end of the program, and takes all other processes with it. Without namespaces the
//!   nanny is the init, and adopts every process whose parent has ended.
//! - The **program** gives up its rights last, and is then executed.
//!
//! These processes have one thread and no heap of the grader, so that ordinary code runs in them.
//! They die with their parents.

mod allowed;
mod filter;
mod lines;
mod nanny;
mod program;
mod root;
pub(super) mod wire;
mod zygote;

use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::os::unix::net::UnixStream;
use std::time::Duration;

use super::call::Call;
use super::layers::Layers;
use super::sys::{ProcessHandle, Reaped};
use super::{access, group, sys};
use lines::Lines;
use wire::{Ended, Failure, Message, Request, Start};
pub use zygote::prepare;

/// The time after which a program that has not been started never will be.
const PATIENCE: Duration = Duration::from_secs(60);

/// Bytes by which a work folder in memory is larger than the limit on it, so that a program that
/// exceeds the limit differs from one that just keeps to it.
const SPARE: u64 = 1 << 20;

/// Rounds of killing, after which the processes of a program that starts others as fast are left to
/// the end of their init.
const ROUNDS: usize = 100;

/// A program that runs.
#[derive(Debug)]
pub(super) struct Running {
    /// The standard input of the program.
    pub(super) stdin: Option<File>,
    /// The standard output and the standard error of the program.
    pub(super) outputs: [Option<File>; 2],
    /// The number of the init, whose descendants are all processes of the program.
    pub(super) init: u32,
    /// The number of the program.
    pub(super) program: u32,
    /// The work folder, if it is in memory.
    pub(super) work: Option<OwnedFd>,
    handle: ProcessHandle,
    status: UnixStream,
}

/// The news of a program.
#[derive(Debug)]
pub(super) enum News {
    /// The program runs.
    None,
    /// The program has ended.
    Ended(Ended),
    /// The init is gone without a report.
    Lost,
}

impl Running {
    /// Returns what has become of the program, without waiting.
    pub(super) fn news(&self) -> News {
        if !sys::is_readable(self.status.as_fd(), Duration::ZERO) {
            return News::None;
        }
        match wire::receive(&self.status) {
            Ok(Message::Ended(ended)) => News::Ended(ended),
            Ok(_) => News::None,
            Err(_) => News::Lost,
        }
    }

    /// Returns the socket that becomes readable with news.
    pub(super) fn status(&self) -> BorrowedFd<'_> {
        self.status.as_fd()
    }

    /// Kills every process of the program and its init. Returns the number of processes that were
    /// left, without the init.
    ///
    /// The end of an init in a namespace of its own takes all others with it. Elsewhere they are
    /// killed one by one, and once more as long as they start others.
    pub(super) fn end(&self) -> u32 {
        let first = group::below(self.init);
        let mut left = first.clone();
        for _ in 0..ROUNDS {
            if left.is_empty() {
                break;
            }
            left.into_iter().for_each(sys::kill);
            left = group::below(self.init);
        }
        if self.handle.has_ended() {
            // An init that somebody killed has no descendants any more.
            sys::kill_group(self.program);
        }
        self.handle.kill();
        first.len() as u32
    }
}

impl From<Ended> for Reaped {
    fn from(Ended { end, cpu, max_resident }: Ended) -> Self {
        Self { end, cpu, max_resident }
    }
}

/// Starts the program of `call`.
///
/// # Errors
/// Fails if the system refuses the program, or if a step of the preparation fails: then nothing has
/// run.
pub(super) fn start(call: &Call) -> Result<Running, Failure> {
    let is_in_memory = call.in_memory && call.layers.namespaces;
    let folder = call.folder.canonicalize().ok().filter(|_| is_in_memory);
    let request = Request {
        layers: call.layers,
        access: access::list(&call.access, &call.folder),
        in_memory: folder.map(|folder| (folder, call.limits.folder_size + SPARE)),
        program: Some(Start {
            program: call.program.clone(),
            args: call.args.clone(),
            environment: call.environment.clone(),
            folder: call.folder.clone(),
            limits: sys::numbers(&call.limits.granted()),
        }),
    };
    launch(&request)
}

/// Tries whether programs can be started with these layers.
///
/// # Errors
/// Fails with the step that the machine refuses.
pub(super) fn try_layers(layers: Layers) -> io::Result<()> {
    let access = access::list(&[], &std::env::temp_dir());
    let running = launch(&Request { layers, access, in_memory: None, program: None });
    running.map(drop).map_err(|failure| failure.error())
}

fn launch(request: &Request) -> Result<Running, Failure> {
    let io = |why: io::Error| Failure::of("the launcher", &why);
    let (status, theirs) = UnixStream::pair().map_err(io)?;
    rustix::net::sockopt::set_socket_passcred(&status, true).map_err(|why| io(why.into()))?;
    let (failure, its_failure) = io::pipe().map_err(io)?;
    let (its_stdin, stdin) = io::pipe().map_err(io)?;
    let (stdout, its_stdout) = io::pipe().map_err(io)?;
    let (stderr, its_stderr) = io::pipe().map_err(io)?;
    let streams = [its_stdin.into(), its_stdout.into(), its_stderr.into()];
    zygote::hand_over(Lines { status: theirs, failure: its_failure.into(), streams })
        .map_err(io)?;
    wire::send(&status, request).map_err(io)?;
    if let Some(failure) = failed(failure).map_err(io)? {
        return Err(failure);
    }
    let Sender { pid: init, descriptor } = sender(&status, &Message::Ready).map_err(io)?;
    let program = sender(&status, &Message::Starting).map_err(io)?.pid;
    let file = |fd: OwnedFd| Some(File::from(fd));
    Ok(Running {
        stdin: file(stdin.into()),
        outputs: [file(stdout.into()), file(stderr.into())],
        handle: ProcessHandle::of(init),
        init,
        program,
        work: descriptor,
        status,
    })
}

/// Waits until the program runs, or returns its failure.
fn failed(mut line: io::PipeReader) -> io::Result<Option<Failure>> {
    if !sys::is_readable(line.as_fd(), PATIENCE) {
        return Err(io::ErrorKind::TimedOut.into());
    }
    let mut text = Vec::new();
    line.read_to_end(&mut text)?;
    if text.is_empty() { Ok(None) } else { wire::receive(&*text).map(Some) }
}

/// The process that sent a message, and the descriptor that came with it.
struct Sender {
    /// The number of the process, as this process sees it.
    pid: u32,
    descriptor: Option<OwnedFd>,
}

/// Reads the message, and returns its sender.
fn sender(status: &UnixStream, expected: &Message) -> io::Result<Sender> {
    if !sys::is_readable(status.as_fd(), PATIENCE) {
        return Err(io::ErrorKind::TimedOut.into());
    }
    let (length, sender) = first_byte(status.as_fd())?;
    let message: Message = wire::receive((&[length][..]).chain(status))?;
    match message == *expected {
        true => Ok(sender),
        false => Err(io::Error::other(format!("{message:?} came, not {expected:?}"))),
    }
}

/// Reads a byte, and returns it with its sender.
fn first_byte(status: BorrowedFd<'_>) -> io::Result<(u8, Sender)> {
    use rustix::net::{RecvAncillaryBuffer, RecvAncillaryMessage, RecvFlags, recvmsg};
    let mut space =
        [std::mem::MaybeUninit::uninit(); rustix::cmsg_space!(ScmCredentials(1), ScmRights(1))];
    let mut ancillary = RecvAncillaryBuffer::new(&mut space);
    let mut byte = [0];
    let flags = RecvFlags::CMSG_CLOEXEC;
    let got = recvmsg(status, &mut [io::IoSliceMut::new(&mut byte)], &mut ancillary, flags)?;
    let (mut pid, mut descriptor) = (None, None);
    for message in ancillary.drain() {
        match message {
            RecvAncillaryMessage::ScmCredentials(of) => pid = Some(of.pid.as_raw_nonzero().get()),
            RecvAncillaryMessage::ScmRights(mut all) => descriptor = all.next(),
            _ => {}
        }
    }
    match pid.filter(|_| got.bytes == 1) {
        Some(pid) => Ok((byte[0], Sender { pid: pid.cast_unsigned(), descriptor })),
        None => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}
