//! Exit codes, in one place.

use std::process::ExitCode;

use grader::grade::GradeError;
use grader::sandbox;
use pages::say;

/// How a command that did its work came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// All passed: 0.
    Passed,
    /// Something did not: 1.
    NotPassed,
    /// Nothing was run, since what was handed in is no submission: 2.
    NoSubmission,
    /// The grader or the machine failed somewhere, whatever passed: 3.
    Ours,
    /// The user stopped the grader before everything was run: 130.
    Interrupted,
}

impl Done {
    /// Passed or not.
    pub(crate) fn of(passed: bool) -> Self {
        if passed { Self::Passed } else { Self::NotPassed }
    }
}

/// What a command comes to.
pub(crate) type Outcome = Result<Done, GradeError>;

/// Prints a report to the output stream.
///
/// # Errors
/// What the stream says, as a failure of the machine; a reader that has gone away is no error.
pub(crate) fn print(text: &str) -> Result<(), GradeError> {
    say::out(text).map_err(|why| unprintable(&why))
}

/// Prints bytes of our own making as they are; the errors are those of [`print`].
pub(crate) fn print_raw(bytes: &[u8]) -> Result<(), GradeError> {
    say::raw(bytes).map_err(|why| unprintable(&why))
}

fn unprintable(why: &std::io::Error) -> GradeError {
    GradeError::Machine(format!("cannot write to standard output: {why}"))
}

/// Prints what went wrong, if anything did, and returns the exit code; 130 after an interrupt.
pub(crate) fn code(outcome: Outcome) -> ExitCode {
    if let Err(why) = &outcome {
        say::err(why.to_string().trim_end());
    }
    match outcome {
        Ok(Done::Interrupted) => ExitCode::from(130),
        _ if sandbox::interrupted() => ExitCode::from(130),
        Ok(Done::Passed) => ExitCode::SUCCESS,
        Ok(Done::NotPassed) => ExitCode::from(1),
        Ok(Done::NoSubmission) | Err(GradeError::Input(_)) => ExitCode::from(2),
        Ok(Done::Ours) | Err(GradeError::Machine(_)) => ExitCode::from(3),
    }
}
