//! The ways in which a command ends early.

use std::error::Error;

use cases::files::WriteError;
use cases::problem::Problems;
use pages::say;

/// The reason for which a command ended early, and with it the exit code.
#[derive(Debug)]
pub(super) enum Stop {
    /// The command is done, but something did not pass: 1.
    NotPassed(String),
    /// A scene or case that cannot be read: 2.
    Problems(Problems),
    /// The arguments make no sense, or an input cannot be read: 2.
    Usage(String),
    /// A file cannot be written: 2 if the name is to blame, 3 if the machine is.
    Write(WriteError),
    /// The machine failed: 3.
    Machine {
        /// The failure, such as `cannot start threads`.
        what: &'static str,
        /// The cause.
        source: Box<dyn Error>,
    },
    /// The user has interrupted the command: 130.
    Interrupted(String),
}

/// Returns the end of a command because `what`, such as a picture or a scene, takes more than
/// `most` rays.
pub(super) fn too_many_rays(what: &str, most: u64) -> Stop {
    Stop::NotPassed(format!(
        "error: {what} takes more than {most} rays, the limit of --max-rays\n\
            help: raise --max-rays, or limit the depth of the rays with `max_depth` or `threshold`"
    ))
}

impl From<Problems> for Stop {
    fn from(problems: Problems) -> Self {
        Self::Problems(problems)
    }
}

impl From<WriteError> for Stop {
    fn from(why: WriteError) -> Self {
        Self::Write(why)
    }
}

impl Stop {
    /// Returns a function that turns the cause of a failure of the machine into a [`Stop`]. `what`
    /// says what failed.
    pub(super) fn machine<E: Error + 'static>(what: &'static str) -> impl FnOnce(E) -> Self {
        move |source| Self::Machine { what, source: Box::new(source) }
    }

    /// Returns the exit code and the text for the error stream.
    pub(super) fn code_and_text(&self) -> (u8, String) {
        match self {
            Self::NotPassed(text) => (1, text.clone()),
            Self::Problems(problems) => (2, problems.render(true)),
            Self::Usage(text) => (2, format!("error: {text}")),
            Self::Write(why) => {
                (if why.is_usage() { 2 } else { 3 }, format!("error: {}", say::chain(why)))
            }
            Self::Machine { what, source } => {
                (3, format!("error: {what}: {}", say::chain(&**source)))
            }
            Self::Interrupted(text) => (130, text.clone()),
        }
    }
}
