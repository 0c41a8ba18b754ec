//! The result of a run of a program.

use std::fmt;
use std::io;
use std::time::Duration;

use super::room::Room;
use super::shortage::Shortage;

/// The ways in which a run ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The program ended by itself, with this code.
    Exited(i32),
    /// The program was ended by this signal, which the grader did not send.
    Signalled(i32),
    /// The program was killed because its time was over, or used more CPU time than it may.
    TimedOut(Clock),
    /// The program requested more memory than it may have.
    OutOfMemory,
    /// The program wrote more than it may.
    TooMuchOutput(Stream),
    /// The program was killed because it started too many processes.
    TooManyProcesses,
    /// The machine lacked something, so the run says nothing about the program.
    Machine(Shortage),
    /// The program never ran, since the file is no program; the text says why.
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
    /// Wall time.
    Wall,
}

/// A place to which a program may write too much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Standard output.
    Stdout,
    /// Standard error.
    Stderr,
    /// A file.
    File,
    /// All files in the folder.
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

/// Largest number of bytes of standard error that are shown.
const SHOWN: usize = 4096;

/// The end of a run, with its output and what it used.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The outcome.
    pub outcome: Outcome,
    /// The content of standard output, cut at the limit.
    pub stdout: Vec<u8>,
    /// The content of standard error, cut at the limit.
    pub stderr: Vec<u8>,
    /// Wall time.
    pub wall: Duration,
    /// CPU time of all processes of the program.
    pub cpu: Duration,
    /// Time in which no process of the program did anything.
    pub idle: Duration,
    /// Largest resident size, in bytes; an upper bound if the run was too short to be measured.
    pub peak_bytes: u64,
    /// Number of processes that the program left running, which were killed.
    pub left_behind: u32,
    /// Whether other programs may have slowed this one down.
    pub is_disturbed: bool,
    /// The least room on the file system of the work folder that was seen during the run.
    pub least: Room,
    /// Number of processes that the system killed during the run because memory ran out.
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

    /// Returns the CPU time and the idle time: the wall time on a machine with one free core,
    /// whatever else this machine does.
    pub fn time(&self) -> Duration {
        self.cpu + self.idle
    }

    /// Returns the run without those parts of its streams that are not shown. One such run is kept
    /// for each question of a stage.
    pub fn without_streams(mut self) -> Self {
        self.stdout = vec![];
        let kept = self.stderr.len().min(SHOWN + 1); // one more, so that the cut is still seen
        self.stderr = self.stderr.split_off(self.stderr.len() - kept);
        self.stderr.shrink_to_fit();
        self
    }

    /// Returns the end of standard error as text that is safe to show, about 4 KiB at most, or
    /// `None` if nothing was written.
    pub fn stderr_text(&self) -> Option<String> {
        let end = self.stderr.len().saturating_sub(SHOWN);
        let text = crate::plain::shown(String::from_utf8_lossy(&self.stderr[end..]).trim());
        let cut = if end > 0 { "[…] " } else { "" };
        (!text.is_empty()).then(|| format!("{cut}{text}"))
    }
}

/// Returns the outcome of a program that could not be started, which depends on who is to blame.
///
/// The program is to blame if it is missing, was not built for this machine, names an interpreter
/// that does not exist, or has a command that the system does not accept. Otherwise the machine is
/// to blame.
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
