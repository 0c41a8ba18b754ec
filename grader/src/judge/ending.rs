//! The judgement on how a program ended.

use cases::program::EXIT_TODO;

use super::Judgement;
use crate::record::{Finding, FindingKind};
use crate::sandbox::{Clock, Finished, Limits, Outcome, Stream};

/// Returns the judgement on a program that ended without giving the requested result.
pub fn ending(finished: &Finished, limits: &Limits) -> Judgement {
    let fail = |kind, message: String| Judgement::fail(Finding::new(kind, message));
    let seconds = |duration: std::time::Duration| duration.as_secs_f64();
    let judgement = match &finished.outcome {
        Outcome::Exited(0) => {
            fail(FindingKind::Missing, "it ended without an error, but wrote nothing".to_owned())
        }
        Outcome::Exited(code) => {
            fail(FindingKind::Crash, format!("it ended with code {code}{}", why(finished)))
        }
        Outcome::Signalled(signal) => fail(
            FindingKind::Crash,
            format!("it was ended by {}{}", signal_name(*signal), why(finished)),
        ),
        Outcome::TimedOut(Clock::Idle) => {
            let message =
                format!("it was idle for more than {} s, computing nothing", seconds(limits.idle));
            fail(FindingKind::Timeout, message)
        }
        Outcome::TimedOut(Clock::Wall) => {
            fail(FindingKind::Timeout, format!("it did not end within {} s", seconds(limits.wall)))
        }
        Outcome::TimedOut(Clock::Cpu) => fail(
            FindingKind::Timeout,
            format!("it used more than {} s of CPU time", seconds(limits.cpu)),
        ),
        Outcome::OutOfMemory => fail(
            FindingKind::Memory,
            format!("it requested more than {} of memory", bytes(limits.memory)),
        ),
        Outcome::TooMuchOutput(Stream::Files) => {
            let message =
                format!("it wrote files of more than {} in all", bytes(limits.folder_size));
            fail(FindingKind::Output, message)
        }
        Outcome::TooMuchOutput(Stream::File) => fail(
            FindingKind::Output,
            format!("it wrote a file of more than {}", bytes(limits.file_size)),
        ),
        Outcome::TooMuchOutput(stream) => fail(
            FindingKind::Output,
            format!("it wrote more than {} to {stream}", bytes(limits.output)),
        ),
        Outcome::TooManyProcesses => {
            fail(FindingKind::Crash, format!("it started more than {} processes", limits.processes))
        }
        Outcome::NoProgram(why) => fail(
            FindingKind::Crash,
            format!(
                "its command cannot be run: {why} (is the program there, is it made for this \
                 machine, and does the first line of a script name an interpreter that is here?)"
            ),
        ),
        Outcome::Machine(shortage) => Judgement::ours(shortage.to_string()),
        Outcome::Interrupted => Judgement::not_run(Finding::new(
            FindingKind::Internal,
            "the grader was interrupted before this ended",
        )),
    };
    judgement.with_stderr(finished.stderr_text())
}

/// Returns the judgement if the exit code says that a function is still to be written, else `None`.
/// The check then counts as not run, not as wrong.
pub fn todo(finished: &Finished) -> Option<Judgement> {
    let text = finished.stderr_text().unwrap_or_default();
    let what = text.lines().rev().find_map(|line| line.strip_prefix("todo: "));
    (finished.outcome == Outcome::Exited(i32::from(EXIT_TODO))).then(|| {
        let message = format!("still to be written: {}", what.unwrap_or("a function it needs"));
        Judgement::not_run(Finding::new(FindingKind::Todo, message))
    })
}

/// Returns the last line of the error stream, after `: `, since it most often names the reason. A
/// line that begins with `panic: ` is preferred. Empty if nothing was written.
fn why(finished: &Finished) -> String {
    let text = finished.stderr_text().unwrap_or_default();
    let line = text
        .lines()
        .rev()
        .find(|line| line.starts_with("panic: "))
        .or_else(|| text.lines().next_back());
    line.map(|line| format!(": {}", line.chars().take(200).collect::<String>())).unwrap_or_default()
}

fn signal_name(signal: i32) -> String {
    let name = match signal {
        libc::SIGSEGV => "SIGSEGV (memory that is not its own, or a stack overflow)",
        libc::SIGABRT => "SIGABRT (it gave up by itself; a stack overflow ends so too)",
        libc::SIGFPE => "SIGFPE (a division by zero)",
        libc::SIGILL => "SIGILL (an instruction that does not exist)",
        libc::SIGBUS => "SIGBUS (memory that is not there)",
        libc::SIGKILL => "SIGKILL",
        other => return format!("signal {other}"),
    };
    name.to_owned()
}

fn bytes(n: u64) -> String {
    if n >= 1 << 30 && n.is_multiple_of(1 << 30) {
        format!("{} GiB", n >> 30)
    } else {
        format!("{} MiB", n >> 20)
    }
}
