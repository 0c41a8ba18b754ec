//! The three streams of a running program: fed and read in turn without blocking, and bounded.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::os::fd::AsFd;
use std::time::Duration;

use super::launcher::Running;
use super::{Outcome, Stream, sys};

/// The streams, and the data that went through them.
pub(super) struct Pump {
    stdin: Option<File>,
    unsent: std::io::Cursor<Vec<u8>>,
    out: Option<File>,
    err: Option<File>,
    limit: u64,
    /// All of standard output, up to the limit.
    pub(super) stdout: Vec<u8>,
    /// All of standard error, up to the limit.
    pub(super) stderr: Vec<u8>,
}

impl Pump {
    pub(super) fn new(running: &mut Running, stdin: &[u8], limit: u64) -> std::io::Result<Self> {
        let (input, [out, err]) = (running.stdin.take(), std::mem::take(&mut running.outputs));
        input.iter().try_for_each(sys::set_nonblocking)?;
        out.iter().try_for_each(sys::set_nonblocking)?;
        err.iter().try_for_each(sys::set_nonblocking)?;
        let unsent = std::io::Cursor::new(stdin.to_vec());
        Ok(Self { stdin: input, unsent, out, err, limit, stdout: vec![], stderr: vec![] })
    }

    /// Waits at most `pause` until a stream is ready or there is news, then writes and reads all of
    /// them. Returns an outcome if the program wrote too much.
    pub(super) fn turn(&mut self, pause: Duration, running: &Running) -> Option<Outcome> {
        let streams = self.out.iter().chain(&self.err).map(AsFd::as_fd);
        let readers: Vec<_> = streams.chain([running.status()]).collect();
        sys::wait_for(&readers, self.stdin.as_ref().map(AsFd::as_fd), pause);
        self.feed();
        self.read()
    }

    /// Reads what is left in the pipes, without waiting for more.
    pub(super) fn drain(&mut self) {
        self.stdin = None;
        self.read();
    }

    /// Writes as much input as the program accepts now. If the program has closed its input, the
    /// rest is dropped.
    fn feed(&mut self) {
        let Some(stdin) = &mut self.stdin else { return };
        loop {
            let rest =
                self.unsent.get_ref().get(self.unsent.position() as usize..).unwrap_or_default();
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
        let out_is_over = take(&mut self.out, self.limit, &mut self.stdout);
        let err_is_over = take(&mut self.err, self.limit, &mut self.stderr);
        match (out_is_over, err_is_over) {
            (true, _) => Some(Outcome::TooMuchOutput(Stream::Stdout)),
            (_, true) => Some(Outcome::TooMuchOutput(Stream::Stderr)),
            _ => None,
        }
    }
}

/// Appends what can be read now to `kept`, up to `limit` bytes in all. Returns whether there is
/// more than that.
fn take(stream: &mut Option<impl Read>, limit: u64, kept: &mut Vec<u8>) -> bool {
    let Some(reader) = stream else { return false };
    let limit = usize::try_from(limit).unwrap_or(usize::MAX);
    let mut block = [0; 16 << 10];
    loop {
        match reader.read(&mut block) {
            Ok(len) if kept.len() + len > limit => {
                kept.extend(&block[..limit.saturating_sub(kept.len())]);
                return true;
            }
            Ok(0) => break,
            Ok(len) => kept.extend(&block[..len]),
            Err(why) if why.kind() == ErrorKind::WouldBlock => return false,
            Err(why) if why.kind() == ErrorKind::Interrupted => {}
            Err(_) => break,
        }
    }
    *stream = None;
    false
}
