//! Runs one process of a program, and finds out who is to blame where it did not give what it
//! should.
//!
//! A failure counts only if it is the program's own. The process is run again, once and alone,
//! where others may have slowed it down or filled the disk, where the program's file was changed,
//! and where the machine could not start it.

use std::ffi::OsString;
use std::path::Path;

use super::allowance::Candidate;
use super::failure::Failure;
use crate::sandbox::{self, Call, Clock, Finished, Folder, Limits, Outcome, Room, Shortage, Turn};

/// The input of a process.
pub(super) struct Task<'a> {
    pub(super) limits: Limits,
    /// Bytes that a right program may have to write to its folder.
    pub(super) needed: u64,
    pub(super) stdin: &'a [u8],
    /// Puts into the folder what the program reads there, and returns the arguments.
    pub(super) prepare: &'a dyn Fn(&Path) -> std::io::Result<Vec<OsString>>,
}

/// Room for what programs write beside what is asked for, such as compiled scripts.
pub(super) const NEEDED: u64 = 64 << 10;

/// Fewer free files than this are few: a program may make so many beside what is asked for.
const FEW_FILES: u64 = 1000;

/// The result of a process.
pub(super) struct Attempt<T> {
    /// What `read` took from the process and its folder.
    pub(super) output: T,
    pub(super) finished: Finished,
    /// The failure of the program, or `None` where its end says nothing against it.
    pub(super) failure: Option<Failure>,
}

/// Runs the program with `task`, and takes its output by `read`, which also says whether it is what
/// was due.
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
        return first.not_the_programs(Shortage::Other(why.to_string()));
    }
    if is_intact && !is_doubtful(&first.finished, &task.limits) {
        return first;
    }
    let (second, is_good) = once(candidate, task, Turn::Alone, read);
    if !candidate.program.is_intact() {
        // The program changed its file itself, as nothing else ran. The next process finds a fault.
        let _ = candidate.program.restore();
    }
    let Finished { wall, cpu, .. } = second.finished;
    match second.finished.outcome {
        // It was neither idle nor did it compute: others kept it from that, or a disk did.
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

/// Returns whether a second run may end otherwise, for a reason that is not the program's.
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

/// Returns whether the disk may have been full for a moment: another program, which has ended
/// since, may have taken as much as was left.
fn is_tight(least: Room, limits: &Limits) -> bool {
    least.bytes < limits.folder_size || least.files < FEW_FILES
}

/// Runs one process in a fresh folder, and returns whether it gave what was due.
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
    let finished = sandbox::run(&call, turn);
    let (output, is_good) = read(folder.path(), &finished);
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
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin: task.stdin.to_vec(),
        limits: task.limits,
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
