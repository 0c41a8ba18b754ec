//! The list of known mistakes in the form that the judge reads.

use std::path::Path;

use cases::Course;
use cases::answer::{self, Digest, Mistake};

use super::expected::Expected;
use crate::rules::Rules;
use crate::rules::misconceptions::{self, Misconception};

/// Returns the list of the mistakes in `course`, to be stored beside the stages.
///
/// # Errors
/// The error of the JSON encoder.
pub fn mistakes(stages: &Path, course: &Course) -> Result<Expected, serde_json::Error> {
    let list: Vec<Mistake> =
        misconceptions::of(&Rules::of(course)).into_iter().map(mistake).collect();
    let text = answer::mistakes_to_string(&Digest::of_mistakes(course), &list)?;
    Ok(Expected { path: answer::mistakes_path(stages), bytes: text.into_bytes() })
}

fn mistake(misconception: &Misconception) -> Mistake {
    let Misconception { id, rule, says, look_at, field, .. } = misconception;
    Mistake {
        id: (*id).to_owned(),
        rule: *rule,
        says: (*says).to_owned(),
        look_at: (*look_at).to_owned(),
        field: (*field).to_owned(),
    }
}
