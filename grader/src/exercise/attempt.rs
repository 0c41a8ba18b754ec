//! Runs one process of a program, and decides whether the program or the machine is to blame for a
//! failure.
//!
//! A failure counts only if it is the program's own. The process is run once more, alone, if others
//! may have slowed it down or filled the disk, if the program's file was changed, or if the machine
//! could not start it.

use std::ffi::OsString;
use std::path::Path;

use pages::say;

use super::allowance::Candidate;
use super::failure::Failure;
use crate::sandbox::{self, Call, Clock, Finished, Folder, Limits, Outcome, Room, Shortage, Turn};

/// The input and the limits of a process.
pub(super) struct Task<'a> {
    pub(super) limits: Limits,
    /// Bytes that a correct program may have to write to its folder.
    pub(super) needed: u64,
    pub(super) stdin: &'a [u8],
    /// Writes the input files of the program into the folder, and returns the arguments.
    pub(super) prepare: &'a dyn Fn(&Path) -> std::io::Result<Vec<OsString>>,
}

/// Room, in bytes, for files that programs write besides their output, such as compiled scripts.
pub(super) const NEEDED: u64 = 64 << 10;

/// Number of free files on the disk below which a failure may be due to their lack. A program may
/// create this many besides its output.
const FEW_FILES: u64 = 1000;

/// The result of a process.
pub(super) struct Attempt<T> {
    /// The value that `read` took from the process and its folder.
    pub(super) output: T,
    pub(super) finished: Finished,
    /// The failure of the program, or `None` if it did not fail by its own fault.
    pub(super) failure: Option<Failure>,
}

/// Runs the program with `task`, and takes its output by `read`, which also returns whether the
/// program did its task.
pub(super) fn attempt<T>(
    candidate: &Candidate,
    task: &Task,
    read: &dyn Fn(&Path, &Finished) -> (T, bool),
) -> Attempt<T> {
    let (first, is_good) = once(candidate, task, Turn::Shared, read);
    if is_good {
        return first;
    }
    let is_intact = candidate.program.is_intact();
    if !is_intact && let Err(why) = candidate.program.restore() {
        return first.not_the_programs(Shortage::Other(say::chain(&why)));
    }
    if is_intact && !is_doubtful(&first.finished, &task.limits) {
        return first;
    }
    let (second, is_good) = once(candidate, task, Turn::Alone, read);
    if !candidate.program.is_intact() {
        // Nothing else ran, so the program changed its file itself. If the file cannot be restored,
        // the next process reports it.
        let _ = candidate.program.restore();
    }
    let Finished { wall, cpu, .. } = second.finished;
    match second.finished.outcome {
        // The program was neither idle nor computing, so other processes or a disk held it up.
        Outcome::TimedOut(Clock::Wall) if !is_good && sandbox::sees_processes() => {
            second.not_the_programs(Shortage::Busy { wall: wall.as_secs(), cpu: cpu.as_secs() })
        }
        _ => second,
    }
}

impl<T> Attempt<T> {
    fn not_the_programs(mut self, shortage: Shortage) -> Self {
        self.finished.outcome = Outcome::Machine(shortage);
        Self { failure: None, ..self }
    }
}

/// Returns whether a second run may end differently for a reason outside the program.
fn is_doubtful(finished: &Finished, limits: &Limits) -> bool {
    match finished.outcome {
        Outcome::TimedOut(Clock::Wall) | Outcome::Machine(Shortage::NotStarted(_)) => true,
        Outcome::TimedOut(Clock::Cpu) => {
            finished.is_disturbed && finished.cpu < limits.cpu_at_most()
        }
        Outcome::Exited(_) | Outcome::Signalled(_) => is_tight(finished.least, limits),
        _ => false,
    }
}

/// Returns whether the disk may have been full for a moment. Another program, which has ended
/// since, may have taken all that was left.
fn is_tight(least: Room, limits: &Limits) -> bool {
    least.bytes < limits.folder_size || least.files < FEW_FILES
}

/// Runs one process in a fresh folder, and returns its result and whether it did its task.
fn once<T>(
    candidate: &Candidate,
    task: &Task,
    turn: Turn,
    read: &dyn Fn(&Path, &Finished) -> (T, bool),
) -> (Attempt<T>, bool) {
    let (folder, call) = match prepared(candidate, task) {
        Ok(prepared) => prepared,
        Err(shortage) => {
            let finished = Finished::without_run(Outcome::Machine(shortage));
            let (output, _) = read(Path::new(""), &finished);
            return (Attempt { output, finished, failure: None }, false);
        }
    };
    let (finished, work) = sandbox::run(&call, turn);
    let (output, is_good) = read(work.path(), &finished);
    let finished = if is_good { finished } else { sandbox::blame(&call, finished) };
    let failure = Failure::of(&finished, folder.path());
    (Attempt { output, finished, failure }, is_good)
}

fn prepared(candidate: &Candidate, task: &Task) -> Result<(Folder, Call), Shortage> {
    let folder = Folder::new().map_err(|why| Shortage::Other(why.to_string()))?;
    let filled = (task.prepare)(folder.path());
    let args = filled.map_err(|why| {
        Shortage::Other(format!(
            "the work folder {} cannot be filled: {why}",
            folder.path().display()
        ))
    })?;
    let program = candidate.program;
    let environment = [
        ("PATH", program.search.clone()),
        ("HOME", folder.path().into()),
        ("TMPDIR", folder.path().into()),
        ("LANG", "C.UTF-8".into()),
    ];
    let call = Call {
        program: program.path.clone(),
        args: program.args.iter().cloned().chain(args).collect(),
        folder: folder.path().to_owned(),
        in_memory: true,
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin: task.stdin.to_vec(),
        limits: task.limits,
        layers: candidate.layers,
        access: program.access(),
        needed: task.needed,
    };
    Ok((folder, call))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::Allowance;

    fn check(outcome: Outcome, least: Room, expected: bool) {
        let finished = Finished { least, ..Finished::without_run(outcome.clone()) };
        assert_eq!(
            is_doubtful(&finished, &Allowance::default().picture),
            expected,
            "{outcome:?}, {least:?}"
        );
    }

    #[test]
    fn a_failure_on_a_disk_that_may_have_been_full_is_doubtful() {
        let limit = Allowance::default().picture.folder_size;
        for (bytes, files, expected) in [
            (limit, FEW_FILES, false),
            (limit - 1, FEW_FILES, true),
            (limit, FEW_FILES - 1, true),
            (0, u64::MAX, true),
            (u64::MAX, u64::MAX, false),
        ] {
            check(Outcome::Exited(1), Room { bytes, files }, expected);
            check(Outcome::Signalled(11), Room { bytes, files }, expected);
            check(Outcome::TooMuchOutput(sandbox::Stream::Files), Room { bytes, files }, false);
        }
    }
}
