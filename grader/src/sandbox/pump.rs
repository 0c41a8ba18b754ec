//! The three streams of a running program: fed and read in turn without blocking, and bounded.

use std::io::{ErrorKind, Read, Write};
use std::os::fd::AsFd;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout};
use std::time::Duration;

use super::{Outcome, Stream, sys};

/// Bytes of standard error that are kept: the last ones.
const STDERR_KEPT: usize = 16 << 10;

/// The streams and what went through them.
pub(super) struct Pump {
    stdin: Option<ChildStdin>,
    unsent: std::io::Cursor<Vec<u8>>,
    out: Option<ChildStdout>,
    err: Option<ChildStderr>,
    limit: u64,
    n_err: u64,
    /// All of standard output, up to the limit.
    pub(super) stdout: Vec<u8>,
    /// The end of standard error.
    pub(super) stderr: Vec<u8>,
}

impl Pump {
    pub(super) fn new(mut child: Child, stdin: &[u8], limit: u64) -> std::io::Result<Self> {
        let (input, out, err) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        input.iter().try_for_each(sys::set_nonblocking)?;
        out.iter().try_for_each(sys::set_nonblocking)?;
        err.iter().try_for_each(sys::set_nonblocking)?;
        let unsent = std::io::Cursor::new(stdin.to_vec());
        Ok(Self { stdin: input, unsent, out, err, limit, n_err: 0, stdout: vec![], stderr: vec![] })
    }

    /// Waits at most `pause` for a stream and serves all; an outcome where one was flooded.
    pub(super) fn turn(&mut self, pause: Duration) -> Option<Outcome> {
        let readers: Vec<_> = self.out.iter().map(AsFd::as_fd).chain(self.err.iter().map(AsFd::as_fd)).collect();
        sys::wait_for(&readers, self.stdin.as_ref().map(AsFd::as_fd), pause);
        self.feed();
        self.read()
    }

    /// Reads what is left in the pipes, without waiting for more.
    pub(super) fn drain(&mut self) {
        self.stdin = None;
        if self.stdout.len() as u64 <= self.limit {
            self.read();
        }
        self.stdout.truncate(usize::try_from(self.limit).unwrap_or(usize::MAX));
    }

    /// Writes what the program takes now. It may close its input early: then the rest is dropped.
    fn feed(&mut self) {
        let Some(stdin) = &mut self.stdin else { return };
        loop {
            let rest = self.unsent.get_ref().get(self.unsent.position() as usize..).unwrap_or_default();
            if rest.is_empty() {
                break;
            }
            match stdin.write(rest) {
                Ok(n) => self.unsent.set_position(self.unsent.position() + n as u64),
                Err(why) if why.kind() == ErrorKind::WouldBlock => return,
                Err(why) if why.kind() == ErrorKind::Interrupted => {}
                Err(_) => break,
            }
        }
        self.stdin = None;
    }

    fn read(&mut self) -> Option<Outcome> {
        let room = self.limit.saturating_sub(self.stdout.len() as u64);
        let (n_out, out_ended) = take(self.out.as_mut(), room, &mut self.stdout);
        let (n_err, err_ended) = take(self.err.as_mut(), self.limit.saturating_sub(self.n_err), &mut self.stderr);
        self.n_err += n_err;
        self.stderr.drain(..self.stderr.len().saturating_sub(STDERR_KEPT));
        if out_ended {
            self.out = None;
        }
        if err_ended {
            self.err = None;
        }
        match () {
            () if n_out > room => Some(Outcome::TooMuchOutput(Stream::Stdout)),
            () if self.n_err > self.limit => Some(Outcome::TooMuchOutput(Stream::Stderr)),
            () => None,
        }
    }
}

/// Moves what can be read now, at most one byte above `room`, behind `kept`; says how much, and whether the stream ended.
fn take(stream: Option<&mut impl Read>, room: u64, kept: &mut Vec<u8>) -> (u64, bool) {
    let Some(stream) = stream else { return (0, false) };
    let mut n = 0;
    let mut block = [0; 16 << 10];
    while n <= room {
        match stream.read(&mut block) {
            Ok(0) => return (n, true),
            Ok(len) => {
                n += len as u64;
                kept.extend(&block[..len]);
            }
            Err(why) if why.kind() == ErrorKind::WouldBlock => return (n, false),
            Err(why) if why.kind() == ErrorKind::Interrupted => {}
            Err(_) => return (n, true),
        }
    }
    (n, false)
}
