//! What a class is made of: submissions with their records.

use crate::record::Record;

/// A submission of the class.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The id, which names its files; of letters, digits, `.`, `_`, `-` and `~` alone.
    pub id: String,
    /// The name as it was handed in.
    pub name: String,
    /// The record; `None` where the grader or the machine failed, so that there is no score yet.
    pub record: Option<Record>,
}
