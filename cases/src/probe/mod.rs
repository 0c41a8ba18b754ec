//! The wire protocol of the unit checks: one question and one answer per line, in JSON.
//! `docs/protocol.md` explains each of them.

mod answer;
mod ask;
pub(crate) mod number;
mod numbers;

use serde::{Deserialize, Serialize};

pub use answer::Answer;
pub use ask::Ask;

/// A line to a submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Question {
    /// Identifier, which the answer repeats.
    pub id: String,
    /// The function to call, and its arguments.
    #[serde(flatten)]
    pub ask: Ask,
}

/// A line from a submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Reply {
    /// Identifier of the question.
    pub id: String,
    /// The result of the function.
    #[serde(flatten)]
    pub answer: Answer,
}
