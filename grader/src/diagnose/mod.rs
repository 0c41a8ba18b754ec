//! Which known mistakes explain what is wrong. Pure functions: from what came back and what mistakes would give, to a ranked list.

mod picture;
mod rank;
mod unit;

use std::collections::BTreeMap;

pub use picture::picture;
pub use rank::{Named, rank};
pub use unit::unit;

/// What one case or check says about the known mistakes. What could not be judged (a crash, a function still to be written) says nothing
/// and is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// The case's or check's.
    pub id: String,
    /// What it counts for: its thousandths of a point.
    pub weight: u64,
    /// What came back.
    pub came: Came,
    /// Every mistake that makes this case or check fail, by its id, with the share of what came back wrong that it explains: 0 to 1, and 0
    /// where all is right.
    pub shares: BTreeMap<String, f64>,
}

/// What came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Came {
    /// What is right: every mistake that would have made it fail is not there.
    Right,
    /// Something wrong.
    Wrong,
}

impl Evidence {
    /// A right answer, which these mistakes would have got wrong.
    pub fn right(id: &str, weight: u64, mistakes: impl IntoIterator<Item = String>) -> Self {
        let shares = mistakes.into_iter().map(|id| (id, 0.0)).collect();
        Self { id: id.to_owned(), weight, came: Came::Right, shares }
    }

    /// A wrong answer, and how much of it each mistake explains.
    pub fn wrong(id: &str, weight: u64, shares: BTreeMap<String, f64>) -> Self {
        Self { id: id.to_owned(), weight, came: Came::Wrong, shares }
    }
}
