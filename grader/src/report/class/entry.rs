//! The members of a class: submissions with their records.

use crate::record::Record;

/// A submission of the class.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The id, which names the files of the submission. It has only letters, digits, `.`, `_`, `-`
    /// and `~`.
    pub id: String,
    /// The name of the hand-in.
    pub name: String,
    /// The record. `None` if the grader or the machine failed, so that there is no score yet.
    pub record: Option<Record>,
}

/// Returns the name of the submission `id`, or its id if there is none.
pub(super) fn name<'a>(entries: &'a [Entry], id: &'a str) -> &'a str {
    entries.iter().find(|entry| entry.id == id).map_or(id, |entry| &entry.name)
}
