//! The reasons why a command of the grader ends without its result.

use std::io;
use std::path::PathBuf;

use cases::files::WriteError;
use cases::film::PictureError;
use cases::problem::Problems;

use crate::batch::{BatchError, KeyError};
use crate::blame::{self, Blame};
use crate::build::{Fault, NoWorkspace};
use crate::exam::SingleError;
use crate::input::{self, InputError};
use crate::report::junit::JunitError;
use crate::sandbox::MissingLayers;
use crate::submission::SubmissionError;
use crate::workers::Panicked;

/// The reason why there is no record, or no other result. Only [`GradeError::Refused`] is the
/// student's fault.
#[derive(Debug, thiserror::Error)]
pub enum GradeError {
    /// The arguments select nothing, or make no sense. The text says what to do.
    #[error("{0}")]
    Usage(String),
    /// The cases or the course cannot be used.
    #[error(transparent)]
    Cases(#[from] Problems),
    /// Some of the selected questions have no trusted answer.
    #[error("{message}")]
    Untrusted {
        /// The party to blame.
        blame: Blame,
        /// The answers, and the command that renews them.
        message: String,
    },
    /// A single stored answer cannot be used.
    #[error(transparent)]
    Answer(#[from] SingleError),
    /// There is no workspace of the assignment.
    #[error(transparent)]
    Workspace(#[from] NoWorkspace),
    /// The grader or the machine cannot build submissions.
    #[error(transparent)]
    Build(#[from] Fault),
    /// The submission cannot be read.
    #[error(transparent)]
    Submission(#[from] SubmissionError),
    /// There is no submission whose ray tree could be shown. The text says why.
    #[error("{0}")]
    Refused(String),
    /// The run over a class failed as a whole.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// There is no key for the results of a class.
    #[error(transparent)]
    Key(#[from] KeyError),
    /// A picture or another input cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An input is not the picture that is needed.
    #[error("{}", input::shown(.name))]
    Picture {
        /// The name as the caller gave it.
        name: PathBuf,
        /// The reason.
        source: PictureError,
    },
    /// An output cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A report cannot be encoded.
    #[error(transparent)]
    Junit(#[from] JunitError),
    /// The output stream fails.
    #[error("cannot write to standard output")]
    Output(#[source] io::Error),
    /// No program shows the page.
    #[error("cannot run {program} to show the page")]
    Open {
        /// The program that opens files.
        program: &'static str,
        /// The error of the system.
        source: io::Error,
    },
    /// The machine lacks a layer of protection that is demanded.
    #[error(transparent)]
    Protection(#[from] MissingLayers),
    /// The user has interrupted the command.
    #[error("interrupted while {0}")]
    Interrupted(&'static str),
    /// The grader itself has a fault.
    #[error(transparent)]
    Panicked(#[from] Panicked),
}

impl GradeError {
    /// Returns the party to blame, which decides the exit code.
    pub fn blame(&self) -> Blame {
        let of_file = |is_of_file| if is_of_file { Blame::File } else { Blame::Machine };
        match self {
            Self::Usage(_) | Self::Refused(_) => Blame::File,
            Self::Cases(problems) => blame::of_problems(problems),
            Self::Untrusted { blame, .. } => *blame,
            Self::Answer(why) => why.blame(),
            Self::Submission(why) => of_file(matches!(why, SubmissionError::Unreadable { .. })),
            Self::Batch(why) => of_file(why.is_usage()),
            Self::Key(why) => of_file(why.is_usage()),
            Self::Input(why) => of_file(why.is_usage()),
            Self::Picture { source, .. } => of_file(!matches!(source, PictureError::Io(_))),
            Self::Write(why) => of_file(why.is_usage()),
            Self::Workspace(_)
            | Self::Build(_)
            | Self::Junit(_)
            | Self::Output(_)
            | Self::Open { .. }
            | Self::Protection(_)
            | Self::Interrupted(_)
            | Self::Panicked(_) => Blame::Machine,
        }
    }
}
