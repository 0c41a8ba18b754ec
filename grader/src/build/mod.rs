//! Builds a program from a submission.

mod diagnostics;
mod entry;
mod error;
mod limits;
mod own;
mod program;
mod rustc;
mod sdk;
mod toolchain;
mod workshop;

pub use entry::StoreError;
pub use error::{BuildError, Fault};
pub use program::{Built, Program};
pub use sdk::{Sdk, SdkError};
pub use toolchain::{Toolchain, ToolchainError};
pub use workshop::{NoWorkspace, Workshop};

use crate::submission::{Kind, Submission};

/// Builds `submission`. `progress` is called before each step that takes a while, with a
/// description of it.
///
/// # Errors
/// See [`BuildError`].
pub fn build(
    submission: &Submission,
    workshop: &Workshop,
    progress: &dyn Fn(&str),
) -> Result<Built, BuildError> {
    match &submission.kind {
        Kind::Rust(rust) => rustc::build(&rust.sources, &submission.digest, workshop, progress),
        Kind::Own(own) => own::build(own, workshop.layers, progress),
    }
}
