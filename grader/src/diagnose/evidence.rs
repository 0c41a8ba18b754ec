//! The evidence that one case or check gives about the known mistakes.

use std::collections::BTreeMap;

/// The evidence of one case or check. What could not be judged (a crash, a function still to be
/// written) is no evidence and is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// The id of the case or check.
    pub id: String,
    /// Thousandths of a point that the case or check is worth.
    pub weight: u64,
    /// The sort of answer that came back.
    pub came: Came,
    /// Mistakes that make the case or check fail, by id, each with the share of what came back
    /// wrong that it explains: 0 to 1, and 0 where all is right.
    pub shares: BTreeMap<String, f64>,
}

/// The sort of answer that came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Came {
    /// A right one: every mistake that would have made the case or check fail is not there.
    Right,
    /// A wrong one.
    Wrong,
}

impl Evidence {
    /// Returns the evidence of a right answer, which these mistakes would have got wrong.
    pub fn right(id: &str, weight: u64, mistakes: impl IntoIterator<Item = String>) -> Self {
        let shares = mistakes.into_iter().map(|id| (id, 0.0)).collect();
        Self { id: id.to_owned(), weight, came: Came::Right, shares }
    }

    /// Returns the evidence of a wrong answer, and how much of it each mistake explains.
    pub fn wrong(id: &str, weight: u64, shares: BTreeMap<String, f64>) -> Self {
        Self { id: id.to_owned(), weight, came: Came::Wrong, shares }
    }
}
