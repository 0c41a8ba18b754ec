//! How a program ended.

use std::fmt;
use std::io;
use std::path::Path;
use std::time::Duration;

use super::Call;
use super::pump::Pump;
use super::sys::Reaped;
use super::watch::Watch;

/// The ways in which a run ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// By itself, with this code.
    Exited(i32),
    /// By this signal, which we did not send.
    Signalled(i32),
    /// It was killed, its time being over.
    TimedOut(Clock),
    /// It asked for more memory than it may have.
    OutOfMemory,
    /// It was killed for what it wrote.
    TooMuchOutput(Stream),
    /// It was killed for starting too many processes.
    TooManyProcesses,
    /// It never ran, for want of something of the machine's; says why.
    CouldNotStart(String),
    /// It never ran, since what is there is no program; says why.
    NoProgram(String),
    /// The user stopped the grader.
    Interrupted,
}

/// The clocks that limit a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// The one on the wall.
    Wall,
    /// CPU time.
    Cpu,
}

/// Where a program may write too much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Standard output.
    Stdout,
    /// Standard error.
    Stderr,
    /// A file.
    File,
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stdout => "standard output",
            Self::Stderr => "standard error",
            Self::File => "a file",
        })
    }
}

/// Bytes of standard error that are shown at most.
const SHOWN: usize = 4096;

/// All that is known of a run.
#[derive(Clone, Debug)]
pub struct Finished {
    /// How it ended.
    pub outcome: Outcome,
    /// What it wrote, cut at the limit.
    pub stdout: Vec<u8>,
    /// What it wrote there, cut at the limit.
    pub stderr: Vec<u8>,
    /// Time by the clock.
    pub wall: Duration,
    /// CPU time of it and of what it waited for.
    pub cpu: Duration,
    /// Largest resident bytes; for a run too short to be looked at an upper bound.
    pub peak_bytes: u64,
    /// Processes that it left running; they were killed.
    pub left_behind: u32,
}

impl Finished {
    pub(super) fn not_started(why: &io::Error) -> Self {
        Self {
            outcome: blame(why),
            stdout: vec![],
            stderr: vec![],
            wall: Duration::ZERO,
            cpu: Duration::ZERO,
            peak_bytes: 0,
            left_behind: 0,
        }
    }

    /// The same without what is not shown of its streams: some are kept for each question of a stage.
    pub fn without_streams(mut self) -> Self {
        self.stdout = vec![];
        let kept = self.stderr.len().min(SHOWN + 1); // one more, so that the cut is still seen
        self.stderr = self.stderr.split_off(self.stderr.len() - kept);
        self.stderr.shrink_to_fit();
        self
    }

    /// The end of standard error as text that is safe to show, at most some 4 KiB; `None` where nothing was written.
    pub fn stderr_text(&self) -> Option<String> {
        let end = self.stderr.len().saturating_sub(SHOWN);
        let text = crate::plain::shown(String::from_utf8_lossy(&self.stderr[end..]).trim());
        let cut = if end > 0 { "[…] " } else { "" };
        (!text.is_empty()).then(|| format!("{cut}{text}"))
    }
}

/// Whether the machine kept a program from starting, or the program itself: it is missing, has not been made for this
/// machine, names an interpreter that is not there, or its command holds what no command can.
fn blame(why: &io::Error) -> Outcome {
    use io::ErrorKind::{ArgumentListTooLong, InvalidInput, IsADirectory, NotADirectory, NotFound, PermissionDenied};
    let kinds = [ArgumentListTooLong, InvalidInput, IsADirectory, NotADirectory, NotFound, PermissionDenied];
    let codes = [libc::ENOEXEC, libc::ELOOP, libc::ENAMETOOLONG];
    let is_no_program = kinds.contains(&why.kind()) || why.raw_os_error().is_some_and(|code| codes.contains(&code));
    if is_no_program { Outcome::NoProgram(why.to_string()) } else { Outcome::CouldNotStart(why.to_string()) }
}

/// Puts together what the kernel, the streams and the watch have to say of `call`.
pub(super) fn finish(
    call: &Call,
    reaped: io::Result<Reaped>,
    stopped: Option<Outcome>,
    pump: Pump,
    watch: &Watch,
    wall: Duration,
    left_behind: u32,
) -> Finished {
    let reaped = match reaped {
        Ok(reaped) => reaped,
        Err(why) => return Finished::not_started(&why),
    };
    let peak_bytes = if watch.peak == 0 { reaped.max_resident } else { watch.peak };
    let outcome = match stopped.unwrap_or_else(|| classify(&reaped, watch, &pump.stderr)) {
        Outcome::Exited(code) if code != 0 && holds_full_file(&call.folder, call.limits.file_size) => {
            Outcome::TooMuchOutput(Stream::File)
        }
        outcome => outcome,
    };
    Finished { outcome, stdout: pump.stdout, stderr: pump.stderr, wall, cpu: reaped.cpu, peak_bytes, left_behind }
}

/// The outcome of a process that ended before we ended it; the kernel may have done so for us.
fn classify(reaped: &Reaped, watch: &Watch, stderr: &[u8]) -> Outcome {
    match reaped.end {
        Ok(0) => Outcome::Exited(0),
        _ if says_out_of_memory(stderr) => Outcome::OutOfMemory,
        Ok(code) => Outcome::Exited(code),
        Err(libc::SIGXCPU) => Outcome::TimedOut(Clock::Cpu),
        Err(libc::SIGKILL) if reaped.cpu >= watch.cpu_limit() => Outcome::TimedOut(Clock::Cpu),
        Err(libc::SIGXFSZ) => Outcome::TooMuchOutput(Stream::File),
        Err(signal) => Outcome::Signalled(signal),
    }
}

/// Whether a file in `folder` has grown to its limit: some runtimes turn the kernel's signal into an error of their own.
fn holds_full_file(folder: &Path, limit: u64) -> bool {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.metadata().ok()).any(|found| found.is_file() && found.len() >= limit)
}

/// Whether the allocator of a known language gave up: what the limit on address space looks like from outside.
fn says_out_of_memory(stderr: &[u8]) -> bool {
    let text = String::from_utf8_lossy(stderr);
    ["memory allocation of ", "std::bad_alloc", "MemoryError", "OutOfMemoryError", "out of memory"]
        .iter()
        .any(|sign| text.contains(sign))
}
