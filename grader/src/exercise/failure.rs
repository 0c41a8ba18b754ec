//! Finds out whether a program fails in the same way whatever it is given. Such a program is not
//! run for every check.

use std::path::Path;

use cases::program::EXIT_TODO;

use crate::sandbox::{Finished, Outcome};

/// Processes that must fail in the same way. The last of them is given nothing to do.
pub const N_SAME: u32 = 3;

/// The way in which a process failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The end of the process, with its streams cut.
    pub finished: Finished,
    /// The last line on the error stream, without the name of the work folder.
    last_line: String,
}

impl Failure {
    /// Returns the failure of a process that ran in `folder`.
    ///
    /// There is none where the end says nothing against the program: code 0, a function still to be
    /// written, a fault of the machine, an interrupt.
    pub(super) fn of(finished: &Finished, folder: &Path) -> Option<Self> {
        let is_todo = finished.outcome == Outcome::Exited(i32::from(EXIT_TODO));
        if is_todo || matches!(finished.outcome, Outcome::Exited(0) | Outcome::Machine(_) | Outcome::Interrupted) {
            return None;
        }
        let text = finished.stderr_text().unwrap_or_default();
        let last_line = text.lines().next_back().unwrap_or_default();
        let last_line = last_line.replace(&*folder.to_string_lossy(), "");
        Some(Self { finished: finished.clone().without_streams(), last_line })
    }

    fn is_like(&self, other: &Self) -> bool {
        self.finished.outcome == other.finished.outcome && self.last_line == other.last_line
    }
}

/// The evidence of the first processes of one kind (`render`, `probe`) on all others.
#[derive(Clone, Debug, Default)]
pub struct Start {
    state: State,
}

#[derive(Clone, Debug, Default)]
enum State {
    /// No process has ended yet.
    #[default]
    New,
    /// All processes so far gave nothing and failed in this way; and how many there were.
    Failing(Failure, u32),
    /// One gave something, ended without a failure, or failed otherwise. From now on all are run.
    Fine,
    /// No process will give anything.
    Broken(Failure),
}

impl Start {
    /// Returns the failure of a program that fails whatever it is given.
    pub fn broken(&self) -> Option<&Failure> {
        if let State::Broken(failure) = &self.state { Some(failure) } else { None }
    }

    /// Returns whether it is known if the program is broken.
    pub fn is_known(&self) -> bool {
        matches!(self.state, State::Fine | State::Broken(_))
    }

    /// Takes in how a process ended. `failure` is `None` where it gave anything, or did not fail.
    ///
    /// `trial` is called at most once, to run the program with nothing to do. A program that fails
    /// at one function or shape alone survives that, so none of its other checks is lost.
    pub(super) fn see(&mut self, failure: Option<&Failure>, trial: impl FnOnce() -> Option<Failure>) {
        self.state = match (std::mem::take(&mut self.state), failure) {
            (State::New, Some(failure)) => State::Failing(failure.clone(), 1),
            (State::Failing(first, n), Some(failure)) if failure.is_like(&first) => match n + 1 {
                n if n + 1 < N_SAME => State::Failing(first, n),
                _ if trial().is_some_and(|failure| failure.is_like(&first)) => State::Broken(first),
                _ => State::Fine,
            },
            (State::New | State::Failing(..), _) => State::Fine,
            (known, _) => known,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A failure by `code` with `stderr`, seen in the folder `/tmp/7`.
    fn failure(outcome: Outcome, stderr: &str) -> Option<Failure> {
        let finished = Finished { stderr: stderr.into(), ..Finished::without_run(outcome) };
        Failure::of(&finished, Path::new("/tmp/7"))
    }

    fn crash(stderr: &str) -> Option<Failure> {
        failure(Outcome::Exited(1), stderr)
    }

    /// What is known after processes ended so, and the trial as the last says: is it known, and is
    /// it broken?
    fn check(ends: &[Option<Failure>], trial: Option<Failure>, is_known: bool, is_broken: bool) {
        let mut start = Start::default();
        let mut n_trials = 0;
        for end in ends {
            start.see(end.as_ref(), || {
                n_trials += 1;
                trial.clone()
            });
        }
        assert_eq!((start.is_known(), start.broken().is_some()), (is_known, is_broken), "{ends:?}, then {trial:?}");
        assert!(n_trials <= 1, "{ends:?}: {n_trials} trials");
    }

    #[test]
    fn a_program_is_broken_if_it_fails_in_the_same_way_with_nothing_to_do() {
        let no_config = || crash("no configuration");
        check(&[], None, false, false);
        check(&[no_config()], no_config(), false, false);
        check(&[no_config(), no_config()], no_config(), true, true);
        check(&[no_config(), no_config(), no_config(), None], no_config(), true, true);
        check(&[no_config(), no_config()], None, true, false);
        check(&[no_config(), no_config()], crash("no scene"), true, false);
        check(&[no_config(), crash("no sphere")], no_config(), true, false);
        check(&[no_config(), failure(Outcome::Exited(2), "no configuration")], no_config(), true, false);
        check(&[None, no_config(), no_config()], no_config(), true, false);
        check(&[no_config(), None, no_config()], no_config(), true, false);
    }

    #[test]
    fn names_of_folders_and_earlier_lines_make_no_difference() {
        let one = crash("at 0x1234\ncannot open /tmp/7/scene.json").unwrap();
        let other = Finished { stderr: b"cannot open /tmp/8/scene.json".to_vec(), ..one.finished.clone() };
        assert!(one.is_like(&Failure::of(&other, Path::new("/tmp/8")).unwrap()));
        assert!(!one.is_like(&Failure::of(&other, Path::new("/tmp/9")).unwrap()));
    }

    #[test]
    fn what_is_not_against_the_program_is_no_failure() {
        for outcome in [Outcome::Exited(0), Outcome::Exited(75), Outcome::Interrupted] {
            assert!(failure(outcome.clone(), "").is_none(), "{outcome:?}");
        }
        assert!(failure(Outcome::NoProgram("not there".to_owned()), "").is_some());
    }
}
