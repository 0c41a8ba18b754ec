//! Decides whether a program fails in the same way whatever its input is. If so, it is not run for
//! every check.

use std::path::Path;

use cases::program::EXIT_TODO;

use crate::sandbox::{Finished, Outcome};

/// Number of processes that must fail in the same way before a trial with an empty input decides.
const N_SAME: u32 = 3;
/// The value of [`N_SAME`] for processes that print no message when they die: their ends look alike
/// whatever the cause.
const N_SILENT: u32 = 8;
/// Number of lines at the end of standard error that are compared. They hold the place and the
/// message of a Rust panic or a Python exception.
const N_LINES: usize = 5;

/// The way in which a process failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The end of the process, with its streams cut.
    pub finished: Finished,
    /// The last lines on standard error, without what differs from run to run.
    message: String,
}

impl Failure {
    /// Returns the failure of a process that ran in `folder`.
    ///
    /// Returns `None` if the end is no failure of the program: code 0, a function that is still to
    /// be written, a fault of the machine, an interrupt.
    pub(super) fn of(finished: &Finished, folder: &Path) -> Option<Self> {
        let is_todo = finished.outcome == Outcome::Exited(i32::from(EXIT_TODO));
        if is_todo
            || matches!(
                finished.outcome,
                Outcome::Exited(0) | Outcome::Machine(_) | Outcome::Interrupted
            )
        {
            return None;
        }
        let text = finished.stderr_text().unwrap_or_default();
        let lines: Vec<&str> = text.lines().collect();
        let last = lines[lines.len().saturating_sub(N_LINES)..].join("\n");
        let message = settled(&last.replace(&*folder.to_string_lossy(), ""));
        Some(Self { finished: finished.clone().without_streams(), message })
    }

    /// Returns whether both processes ended in the same way.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.finished.outcome == other.finished.outcome && self.message == other.message
    }

    /// Returns how many processes must fail like this one before a trial decides.
    pub(super) fn n_needed(&self) -> u32 {
        let is_death = matches!(self.finished.outcome, Outcome::Exited(_) | Outcome::Signalled(_));
        if is_death && self.message.trim().is_empty() { N_SILENT } else { N_SAME }
    }
}

/// Returns a message without numbers in parentheses and addresses: Rust prints the number of a
/// thread as `(1234)`, and C++ an address as `0x55d0`.
fn settled(message: &str) -> String {
    let mut settled = String::with_capacity(message.len());
    let mut rest = message;
    while let Some(at) = rest.find(['(', 'x']) {
        settled.push_str(&rest[..=at]);
        let is_address = rest[..at].ends_with('0') && rest.as_bytes()[at] == b'x';
        rest = match rest.as_bytes()[at] {
            b'(' => rest[at + 1..].trim_start_matches(|c: char| c.is_ascii_digit()),
            _ if is_address => rest[at + 1..].trim_start_matches(|c: char| c.is_ascii_hexdigit()),
            _ => &rest[at + 1..],
        };
    }
    settled + rest
}

/// The evidence that the first processes of one kind (`render`, `probe`) give about all others.
#[derive(Clone, Debug, Default)]
pub struct Start {
    state: State,
}

#[derive(Clone, Debug, Default)]
enum State {
    /// No process has ended yet.
    #[default]
    New,
    /// All processes so far gave no result and failed in this way. The number counts them.
    Failing(Failure, u32),
    /// A process gave a result, ended without a failure, or failed in another way. From now on all
    /// are run.
    Fine,
    /// No process will give a result, as this number of processes has shown.
    Broken(Failure, u32),
}

impl Start {
    /// Returns the failure of a program that fails whatever its input is, and the number of
    /// processes that have shown that.
    pub fn broken(&self) -> Option<(&Failure, u32)> {
        if let State::Broken(failure, n) = &self.state { Some((failure, *n)) } else { None }
    }

    /// Returns how many processes have failed alike while it is undecided whether the program is
    /// broken, else 0.
    pub(super) fn n_failures(&self) -> u32 {
        if let State::Failing(_, n) = self.state { n } else { 0 }
    }

    /// Returns whether it is decided if the program is broken.
    pub fn is_known(&self) -> bool {
        matches!(self.state, State::Fine | State::Broken(..))
    }

    /// Records how a process ended. `failure` is `None` if it gave a result or did not fail.
    ///
    /// `trial` is called at most once, to run the program with an empty input. A program that fails
    /// only at one function or shape survives the trial, so none of its other checks is lost.
    pub(super) fn see(
        &mut self,
        failure: Option<&Failure>,
        trial: impl FnOnce() -> Option<Failure>,
    ) {
        self.state = match (std::mem::take(&mut self.state), failure) {
            (State::New, Some(failure)) => State::Failing(failure.clone(), 1),
            (State::Failing(first, n), Some(failure)) if failure.is_like(&first) => match n + 1 {
                n if n < first.n_needed() => State::Failing(first, n),
                n if trial().is_some_and(|failure| failure.is_like(&first)) => {
                    State::Broken(first, n + 1)
                }
                _ => State::Fine,
            },
            (State::New | State::Failing(..), _) => State::Fine,
            (known, _) => known,
        };
    }
}

/// Returns the order in which `n` items are tried until it is known whether the program is broken.
///
/// The first two items come first, then the last one, then others from all over the list. The
/// program may fail only at what the first two have in common.
pub fn order(n: usize) -> Vec<usize> {
    let far_apart = (2..N_SILENT + 2).filter_map(|n_failures| spread(n_failures, n));
    let mut order: Vec<usize> = vec![];
    for place in [0, 1].into_iter().chain(far_apart).chain(0..n).filter(|place| *place < n) {
        if !order.contains(&place) {
            order.push(place);
        }
    }
    order
}

/// Returns the index of the item to try next after `n_failures` (at least two) of `n` items failed.
///
/// The last item comes first, then others from all over the list. Returns `None` if `n` is 0.
pub(super) fn spread(n_failures: u32, n: usize) -> Option<usize> {
    let last = n.checked_sub(1)?;
    let nth = (n_failures as usize).saturating_sub(2);
    Some(if nth == 0 { last } else { (nth * n / N_SILENT as usize).min(last) })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::sandbox::Clock;

    /// Returns the failure of a process that ended with `outcome` and `stderr` in the folder
    /// `/tmp/7`.
    fn failure(outcome: Outcome, stderr: &str) -> Option<Failure> {
        let finished = Finished { stderr: stderr.into(), ..Finished::without_run(outcome) };
        Failure::of(&finished, Path::new("/tmp/7"))
    }

    pub(in crate::exercise) fn crash(stderr: &str) -> Option<Failure> {
        failure(Outcome::Exited(1), stderr)
    }

    /// Checks what is decided after processes ended as in `ends`, and the trial as in `trial`.
    fn check(ends: &[Option<Failure>], trial: Option<Failure>, is_known: bool, is_broken: bool) {
        let mut start = Start::default();
        let mut n_trials = 0;
        for end in ends {
            start.see(end.as_ref(), || {
                n_trials += 1;
                trial.clone()
            });
        }
        assert_eq!(
            (start.is_known(), start.broken().is_some()),
            (is_known, is_broken),
            "{ends:?}, then {trial:?}"
        );
        assert!(n_trials <= 1, "{ends:?}: {n_trials} trials");
    }

    #[test]
    fn a_program_is_broken_if_it_fails_in_the_same_way_with_nothing_to_do() {
        let no_config = || crash("no configuration");
        let two = [no_config(), no_config()];
        check(&[], None, false, false);
        check(&two, no_config(), false, false);
        check(&[no_config(), no_config(), no_config()], no_config(), true, true);
        check(&[no_config(), no_config(), no_config(), None], no_config(), true, true);
        check(&[no_config(), no_config(), no_config()], None, true, false);
        check(&[no_config(), no_config(), no_config()], crash("no scene"), true, false);
        check(&[no_config(), no_config(), crash("no sphere")], no_config(), true, false);
        check(
            &[no_config(), failure(Outcome::Exited(2), "no configuration")],
            no_config(),
            true,
            false,
        );
        check(&[None, no_config(), no_config()], no_config(), true, false);
        check(&[no_config(), None, no_config()], no_config(), true, false);
    }

    /// Ends without a message look alike, so more of them are needed.
    #[test]
    fn silent_ends_need_more_evidence() {
        let silent = |n| vec![failure(Outcome::Signalled(11), ""); n];
        check(&silent(7), failure(Outcome::Signalled(11), ""), false, false);
        check(&silent(8), failure(Outcome::Signalled(11), ""), true, true);
        check(&silent(8), None, true, false);
        check(
            &vec![failure(Outcome::TimedOut(Clock::Cpu), ""); 3],
            failure(Outcome::TimedOut(Clock::Cpu), ""),
            true,
            true,
        );
    }

    /// All Rust panics end with the same note.
    #[test]
    fn panics_at_different_places_are_not_alike() {
        let panic = |thread: u32, at: &str| {
            let note =
                "note: run with `RUST_BACKTRACE=1` environment variable to display a backtrace";
            let text = format!(
                "thread 'main' ({thread}) panicked at src/{at}:\nindex out of bounds\n{note}\n"
            );
            failure(Outcome::Exited(101), &text).unwrap()
        };
        assert!(panic(7, "scene.rs:3:5").is_like(&panic(1234, "scene.rs:3:5")));
        assert!(!panic(7, "scene.rs:3:5").is_like(&panic(7, "scene.rs:4:5")));
    }

    #[test]
    fn names_of_folders_and_addresses_make_no_difference() {
        let one = crash("at 0x1234\ncannot open /tmp/7/scene.json").unwrap();
        let other = Finished {
            stderr: b"at 0xffe0\ncannot open /tmp/8/scene.json".to_vec(),
            ..one.finished.clone()
        };
        assert!(one.is_like(&Failure::of(&other, Path::new("/tmp/8")).unwrap()));
        assert!(!one.is_like(&Failure::of(&other, Path::new("/tmp/9")).unwrap()));
        assert_eq!(settled("(17) (abc) f(3) 0xffe0: axe 0x1"), "() (abc) f() 0x: axe 0x");
    }

    #[test]
    fn the_first_tries_are_far_apart() {
        assert_eq!(order(0), [0; 0]);
        assert_eq!(order(1), [0]);
        assert_eq!(order(3), [0, 1, 2]);
        assert_eq!(order(16)[..6], [0, 1, 15, 2, 4, 6]);
        let mut all = order(50);
        all.sort();
        assert_eq!(all, (0..50).collect::<Vec<_>>());
    }

    #[test]
    fn what_is_not_against_the_program_is_no_failure() {
        for outcome in [Outcome::Exited(0), Outcome::Exited(75), Outcome::Interrupted] {
            assert!(failure(outcome.clone(), "").is_none(), "{outcome:?}");
        }
        assert!(failure(Outcome::NoProgram("not there".to_owned()), "").is_some());
    }
}
