//! Stored answers to unit checks.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Digest;
use super::mistake::lines;
use crate::probe::Answer;

/// The stored answer to a unit check, an item of the list `checks.answers.json` in its stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckAnswer {
    /// The id of the check.
    pub id: String,
    /// Digest of the course, the rules and the check that the answer was made from. An item without
    /// a digest gets the default digest, which makes the answer stale.
    #[serde(default)]
    pub made_from: Digest,
    /// The correct answer.
    pub answer: Answer,
    /// Greatest absolute error of each number of the answer, from the conditioning of the question.
    pub allowed: f64,
    /// The correct answers that decide otherwise (a miss, another object), where the decision flips
    /// within the rounding of the inputs. The same error is allowed of their numbers.
    pub also: Vec<Answer>,
    /// Answers of programs that make a known mistake, by the id of the mistake. Mistakes that leave
    /// the answer correct are missing.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub wrong: BTreeMap<String, Answer>,
}

/// Returns the text to store for the unit checks of a stage: a JSON list with one answer per line.
///
/// # Errors
/// An error of the JSON encoder.
pub fn check_answers_to_string(answers: &[CheckAnswer]) -> Result<String, serde_json::Error> {
    lines(answers)
}

/// Parses the stored answers in `text`.
///
/// # Errors
/// A part that is missing or of the wrong kind, with line and column.
pub fn check_answers_from_str(text: &str) -> Result<Vec<CheckAnswer>, serde_json::Error> {
    serde_json::from_str(text)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::Course;

    #[test]
    fn check_answers_come_back_infinities_included() {
        let to_light = Answer::ToLight { direction: DVec3::Y, t: f64::INFINITY };
        let wrong = BTreeMap::from([("light_reversed".to_owned(), Answer::Miss(true))]);
        let answer = |id: &str, answer, also, wrong| CheckAnswer {
            id: id.to_owned(),
            made_from: Digest::of_mistakes(&Course::default()),
            answer,
            allowed: 1.9e-6,
            also,
            wrong,
        };
        let answers = vec![
            answer("a/b/c", to_light.clone(), vec![], wrong),
            answer("a/b/d", Answer::Miss(true), vec![to_light], BTreeMap::default()),
        ];
        let text = check_answers_to_string(&answers).unwrap();
        assert_eq!(check_answers_from_str(&text).unwrap(), answers);
        assert_eq!(text.lines().count(), 4);
        assert_eq!(check_answers_from_str(&check_answers_to_string(&[]).unwrap()).unwrap(), vec![]);
    }
}
