//! Courses that differ from the lecture in one key.

use super::{Course, DECISIONS, Decision, Legal, parse};
use crate::effects::{Effect, Effects};

/// A course that differs from the lecture in one key.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The line of `course.toml` that differs, such as `highlight = "phong"`.
    pub line: String,
    /// The decision that differs.
    pub decision: &'static Decision,
    /// The course with this one difference.
    pub course: Course,
}

/// Returns the courses that differ from the lecture in one key, in the order of [`DECISIONS`].
///
/// A choice gives every value but the lecture's. A range gives a value within and its far end,
/// because students' programs may choose any value of it. A set of effects gives shadows alone, and
/// all effects.
pub fn deviations() -> Vec<Deviation> {
    let of_decision = |decision: &'static Decision| {
        let values: Vec<String> = match decision.legal {
            Legal::OneOf(values) => {
                values.iter().skip(1).map(|(value, _)| (*value).to_owned()).collect()
            }
            Legal::Range { least, most, .. } => {
                vec![format!("{:e}", (least * most).sqrt()), format!("{most:e}")]
            }
            Legal::Effects => {
                let sets = [Effects::NONE.with(Effect::Shadows), Effects::ALL];
                sets.map(super::choice::effects_as_written).to_vec()
            }
        };
        values.into_iter().map(move |value| deviation(decision, &value))
    };
    DECISIONS.iter().flat_map(of_decision).collect()
}

fn deviation(decision: &'static Decision, value: &str) -> Deviation {
    let line = format!("{} = {value}", decision.key);
    let course = parse("a deviation", &line).expect("a legal value of a key is legal in a file");
    Deviation { line, decision, course }
}
