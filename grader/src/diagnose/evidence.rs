//! The evidence that one case or check gives about the known mistakes.

use std::collections::BTreeMap;

/// The evidence of one case or check. A result that could not be judged (a crash, a function still
/// to be written) is no evidence and is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// The id of the case or check.
    pub id: String,
    /// Thousandths of a point that the case or check is worth.
    pub weight: u64,
    /// Correctness of the answer.
    pub correctness: Correctness,
    /// The known mistakes that make the case or check fail, by id. The value is the share of the
    /// observed error that the mistake explains, 0 to 1; it is 0 if the answer is correct.
    pub shares: BTreeMap<String, f64>,
}

/// The kind of answer that a program gave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correctness {
    /// A correct answer: the program makes none of the mistakes that fail this case or check.
    Right,
    /// A wrong answer.
    Wrong,
}

impl Evidence {
    /// Returns the evidence of a correct answer to a case or check that these mistakes fail.
    pub fn right(id: &str, weight: u64, mistakes: impl IntoIterator<Item = String>) -> Self {
        let shares = mistakes.into_iter().map(|id| (id, 0.0)).collect();
        Self { id: id.to_owned(), weight, correctness: Correctness::Right, shares }
    }

    /// Returns the evidence of a wrong answer, with the share of it that each mistake explains.
    pub fn wrong(id: &str, weight: u64, shares: BTreeMap<String, f64>) -> Self {
        Self { id: id.to_owned(), weight, correctness: Correctness::Wrong, shares }
    }
}
