//! From a submission to a program that can be run.

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
pub use toolchain::Toolchain;
pub use workshop::Workshop;

use crate::submission::{Kind, Submission};

/// Builds `submission`; `tell` hears what takes a while.
///
/// # Errors
/// [`BuildError`].
pub fn build(
    submission: &Submission,
    workshop: &Workshop,
    tell: &dyn Fn(&str),
) -> Result<Built, BuildError> {
    match &submission.kind {
        Kind::Rust(rust) => rustc::build(&rust.sources, &submission.digest, workshop, tell),
        Kind::Own(own) => own::build(own, tell),
    }
}
