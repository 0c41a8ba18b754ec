//! The wire protocol of the unit checks: a question a line, an answer a line, JSON.
//! `docs/protocol.md` explains each.

mod answer;
mod ask;
pub(crate) mod number;
mod numbers;

use serde::{Deserialize, Serialize};

pub use answer::Answer;
pub use ask::Ask;

/// One line to a submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Question {
    /// Comes back with the answer.
    pub id: String,
    /// Which function is asked, and its arguments.
    #[serde(flatten)]
    pub ask: Ask,
}

/// One line from a submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
pub struct Reply {
    /// The question's.
    pub id: String,
    /// What the function returned.
    #[serde(flatten)]
    pub answer: Answer,
}
