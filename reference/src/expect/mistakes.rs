//! The list of known mistakes, as the judge needs it.

use std::path::Path;

use cases::answer::{self, Mistake};

use super::Expected;
use crate::misconceptions::{self, Misconception};
use crate::rules::Rules;

/// The list of all that are mistakes under these rules, stored beside the stages.
///
/// # Errors
/// What the encoder says.
pub fn mistakes(stages: &Path, rules: &Rules) -> Result<Expected, serde_json::Error> {
    let list: Vec<Mistake> = misconceptions::of(rules).into_iter().map(mistake).collect();
    let text = answer::mistakes_to_string(&list)?;
    Ok(Expected { path: answer::mistakes_path(stages), bytes: text.into_bytes() })
}

fn mistake(misconception: &Misconception) -> Mistake {
    let Misconception { id, rule, says, look_at, .. } = misconception;
    Mistake { id: (*id).to_owned(), rule: *rule, says: (*says).to_owned(), look_at: (*look_at).to_owned() }
}
