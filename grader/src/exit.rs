//! Exit codes, in one place.

use std::process::ExitCode;

use grader::grade::GradeError;
use grader::sandbox;

/// How a command that did its work came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// All passed: 0.
    Passed,
    /// Something did not: 1.
    NotPassed,
    /// The grader or the machine failed somewhere, whatever passed: 3.
    Ours,
}

impl Done {
    /// Passed or not.
    pub(crate) fn of(passed: bool) -> Self {
        if passed { Self::Passed } else { Self::NotPassed }
    }
}

/// What a command comes to.
pub(crate) type Outcome = Result<Done, GradeError>;

/// Prints what went wrong, if anything did, and says the code; 130 after an interrupt.
pub(crate) fn code(outcome: Outcome) -> ExitCode {
    if let Err(why) = &outcome {
        anstream::eprintln!("{}", why.to_string().trim_end());
    }
    match outcome {
        _ if sandbox::interrupted() => ExitCode::from(130),
        Ok(Done::Passed) => ExitCode::SUCCESS,
        Ok(Done::NotPassed) => ExitCode::from(1),
        Err(GradeError::Input(_)) => ExitCode::from(2),
        Ok(Done::Ours) | Err(GradeError::Machine(_)) => ExitCode::from(3),
    }
}
