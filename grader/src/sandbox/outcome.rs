//! How a program ended.

use std::fmt;
use std::io;
use std::time::Duration;

use super::room::Room;
use super::shortage::Shortage;

/// The ways in which a run ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// By itself, with this code.
    Exited(i32),
    /// By this signal, which we did not send.
    Signalled(i32),
    /// It was killed because its time was over, or it took more CPU time than it may.
    TimedOut(Clock),
    /// It asked for more memory than it may have.
    OutOfMemory,
    /// It was killed for what it wrote.
    TooMuchOutput(Stream),
    /// It was killed for starting too many processes.
    TooManyProcesses,
    /// The machine fell short, so the run says nothing about the program.
    Machine(Shortage),
    /// It never ran, since what is there is no program; says why.
    NoProgram(String),
    /// The user stopped the grader.
    Interrupted,
}

/// The clocks that limit a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// CPU time.
    Cpu,
    /// Time in which the program did nothing.
    Idle,
    /// The clock on the wall.
    Wall,
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
    /// All files together.
    Files,
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stdout => "standard output",
            Self::Stderr => "standard error",
            Self::File => "a file",
            Self::Files => "its folder",
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
    /// Wall time.
    pub wall: Duration,
    /// CPU time of all processes of the program.
    pub cpu: Duration,
    /// Time in which no process of the program did anything.
    pub idle: Duration,
    /// Largest resident bytes; for a run too short to be looked at an upper bound.
    pub peak_bytes: u64,
    /// Processes that it left running; they were killed.
    pub left_behind: u32,
    /// Whether other programs may have slowed this one down.
    pub is_disturbed: bool,
    /// The least room that was seen on the file system of the work folder.
    pub least: Room,
    /// Processes that the system killed for want of memory meanwhile.
    pub n_killed: u64,
}

impl Finished {
    pub(super) fn not_started(why: &io::Error) -> Self {
        Self::without_run(cannot_start(why))
    }

    /// Returns the end of a program that did not run.
    pub fn without_run(outcome: Outcome) -> Self {
        Self {
            outcome,
            stdout: vec![],
            stderr: vec![],
            wall: Duration::ZERO,
            cpu: Duration::ZERO,
            idle: Duration::ZERO,
            peak_bytes: 0,
            left_behind: 0,
            is_disturbed: false,
            least: Room::ALL,
            n_killed: 0,
        }
    }

    /// The same without what is not shown of its streams: some are kept for each question of a
    /// stage.
    pub fn without_streams(mut self) -> Self {
        self.stdout = vec![];
        let kept = self.stderr.len().min(SHOWN + 1); // one more, so that the cut is still seen
        self.stderr = self.stderr.split_off(self.stderr.len() - kept);
        self.stderr.shrink_to_fit();
        self
    }

    /// The end of standard error as text that is safe to show, at most some 4 KiB; `None` where
    /// nothing was written.
    pub fn stderr_text(&self) -> Option<String> {
        let end = self.stderr.len().saturating_sub(SHOWN);
        let text = crate::plain::shown(String::from_utf8_lossy(&self.stderr[end..]).trim());
        let cut = if end > 0 { "[…] " } else { "" };
        (!text.is_empty()).then(|| format!("{cut}{text}"))
    }
}

/// Returns whose fault it is that a program was not started.
///
/// It is the program's where the program is missing, was not made for this machine, or names an
/// interpreter that is not there, and where its command holds what no command can.
fn cannot_start(why: &io::Error) -> Outcome {
    use io::ErrorKind::{
        ArgumentListTooLong, InvalidInput, IsADirectory, NotADirectory, NotFound, PermissionDenied,
    };
    let kinds = [
        ArgumentListTooLong,
        InvalidInput,
        IsADirectory,
        NotADirectory,
        NotFound,
        PermissionDenied,
    ];
    let codes = [libc::ENOEXEC, libc::ELOOP, libc::ENAMETOOLONG];
    let is_no_program =
        kinds.contains(&why.kind()) || why.raw_os_error().is_some_and(|code| codes.contains(&code));
    let text = why.to_string();
    if is_no_program {
        Outcome::NoProgram(text)
    } else {
        Outcome::Machine(Shortage::NotStarted(text))
    }
}
