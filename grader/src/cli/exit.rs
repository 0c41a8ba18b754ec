//! Exit codes, in one place.

use std::process::ExitCode;

use pages::say;

use crate::blame::Blame;
use crate::grade::GradeError;
use crate::sandbox;

/// The result of a command that returned no error, with its exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// All passed: 0.
    Passed,
    /// Something did not pass: 1.
    NotPassed,
    /// Nothing was run, since the hand-in is no submission: 2.
    NoSubmission,
    /// The grader or the machine failed somewhere, whatever passed: 3.
    Ours,
    /// The user stopped the grader before everything was run: 130.
    Interrupted,
}

impl Done {
    /// Returns [`Done::Passed`] or [`Done::NotPassed`].
    pub(crate) fn of(passed: bool) -> Self {
        if passed { Self::Passed } else { Self::NotPassed }
    }
}

/// The result of a command, or the error that ended it.
pub(crate) type Outcome = Result<Done, GradeError>;

/// Prints a report to the output stream.
///
/// # Errors
/// A failed write is a failure of the machine. A reader that has gone away is no error.
pub(crate) fn print(text: &str) -> Result<(), GradeError> {
    say::out(text).map_err(GradeError::Output)
}

/// Prints bytes that the grader generated itself, unchanged. The errors are those of [`print`].
pub(crate) fn print_raw(bytes: &[u8]) -> Result<(), GradeError> {
    say::raw(bytes).map_err(GradeError::Output)
}

/// Prints the error with its causes, if there is one. Returns the exit code, which is 130 after an
/// interrupt.
pub(crate) fn code(outcome: Outcome) -> ExitCode {
    if let Err(why) = &outcome {
        say::err(say::chain(why).trim_end());
    }
    match outcome {
        Ok(Done::Interrupted) => ExitCode::from(130),
        _ if sandbox::interrupted() => ExitCode::from(130),
        Ok(Done::Passed) => ExitCode::SUCCESS,
        Ok(Done::NotPassed) => ExitCode::from(1),
        Ok(Done::NoSubmission) => ExitCode::from(2),
        Ok(Done::Ours) => ExitCode::from(3),
        Err(why) => match why.blame() {
            Blame::File => ExitCode::from(2),
            Blame::Machine => ExitCode::from(3),
        },
    }
}
