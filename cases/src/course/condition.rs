//! Conditions on courses: for example, a paper answer may hold for some courses only.

use toml::de::DeValue;

use super::choice::{Decision, Legal, value_as_written};
use super::{Course, DECISIONS};
use crate::problem::{did_you_mean, quoted};
use crate::scene::raw::read::{Notes, Read, Value};

/// A set of courses: for some keys of `course.toml`, the values that a course of the set may have.
///
/// It is written as `{ index_of_air = 1.0003, two_sided = ["never", "transmissive"] }`. A key that
/// is left out may have any value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Condition(Vec<Clause>);

/// The values that a key may have.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Clause {
    /// The index of the key in [`DECISIONS`].
    decision: usize,
    /// The values, as they are written in a file.
    values: Vec<String>,
}

impl Condition {
    /// Returns whether `course` is in the set.
    pub(crate) fn holds(&self, course: &Course) -> bool {
        let written = course.written();
        self.0.iter().all(|clause| clause.values.contains(&written[clause.decision]))
    }
}

impl Read for Condition {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let Some(entries) = value.get_ref().as_table() else {
            notes.wrong(
                value,
                "a table of the keys of course.toml, each with one legal value or a list of them",
            );
            return None;
        };
        let keys = || DECISIONS.iter().map(|decision| decision.key);
        let mut clauses = Some(vec![]);
        for (key, value) in entries {
            let clause = match DECISIONS
                .iter()
                .position(|decision| decision.key == key.get_ref().as_ref())
            {
                Some(decision) => values(&DECISIONS[decision], value, notes)
                    .map(|values| Clause { decision, values }),
                None => {
                    let message = format!("unknown key `{}`", key.get_ref());
                    let problem = notes.add(key.span(), message, "course.toml has no such key");
                    problem.help(match did_you_mean(key.get_ref(), keys()) {
                        Some(meant) => format!("did you mean `{meant}`?"),
                        None => format!("its keys are {}", quoted(keys())),
                    });
                    None
                }
            };
            clauses = clauses.zip(clause).map(|(all, clause)| [all, vec![clause]].concat());
        }
        clauses.map(Self)
    }
}

/// Reads one legal value of `decision`, or a list of them.
fn values(decision: &Decision, value: &Value<'_>, notes: &mut Notes) -> Option<Vec<String>> {
    match (decision.legal, value.get_ref()) {
        (Legal::Effects, _) | (_, DeValue::String(_) | DeValue::Integer(_) | DeValue::Float(_)) => {
            value_as_written(decision, value, notes).map(|one| vec![one])
        }
        (_, DeValue::Array(items)) => {
            items.iter().map(|item| value_as_written(decision, item, notes)).collect()
        }
        _ => {
            notes.wrong(value, "a legal value of this key, or a list of them");
            None
        }
    }
}
