//! The argument that selects who confirms diagnoses.

use clap::ValueEnum;

use crate::grade::GradeError;
use crate::tracer::Tracer;

/// The values of `--confirm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Confirm {
    /// If the program is there
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

impl Confirm {
    /// Returns the tracer that confirms diagnoses.
    ///
    /// # Errors
    /// Fails if the tracer is demanded, but is not there.
    pub(crate) fn tracer(self) -> Result<Option<Tracer>, GradeError> {
        match (self, Tracer::beside()) {
            (Self::Never, _) => Ok(None),
            (Self::Always, None) => Err(GradeError::Usage(
                "there is no program `reference` beside the grader; build it, or leave out \
                 --confirm"
                    .to_owned(),
            )),
            (_, tracer) => Ok(tracer),
        }
    }
}
