//! The ways in which a command ends early.

use cases::files::WriteError;
use cases::problem::Problems;

/// The reason for which a command ended early, and with it the exit code.
#[derive(Debug)]
pub(super) enum Stop {
    /// The command is done, but something did not pass: 1.
    NotPassed(String),
    /// A scene or case that cannot be read: 2.
    Problems(Problems),
    /// The arguments make no sense, or an input cannot be read: 2.
    Usage(String),
    /// The machine failed: 3.
    Machine(String),
    /// The user has interrupted the command: 130.
    Interrupted(String),
}

impl From<Problems> for Stop {
    fn from(problems: Problems) -> Self {
        Self::Problems(problems)
    }
}

impl From<WriteError> for Stop {
    fn from(why: WriteError) -> Self {
        if why.is_usage() { Self::Usage(why.to_string()) } else { Self::Machine(why.to_string()) }
    }
}
