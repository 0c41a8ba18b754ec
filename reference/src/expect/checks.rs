//! The answers to the unit checks: the correct answer, its allowed error, and the answers of known
//! mistakes.

use std::collections::BTreeMap;
use std::path::Path;

use cases::Course;
use cases::answer::{self, CheckAnswer, Digest};
use cases::probe::{Answer, Ask};
use cases::stage::{Check, Stage};

use super::allowed::{self, Allowance, AllowanceError};
use super::expected::Expected;
use crate::rules::Rules;
use crate::rules::misconceptions;
use crate::trace::answers;

/// Allowed relative error of an answer on paper against the reference in double precision.
const PAPER: f64 = 1e-12;

/// The reason why a check has no answer.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The reference cannot answer the question.
    #[error("{id}: the question cannot be answered: {why}")]
    Unanswered {
        /// The check.
        id: String,
        /// The answer of the reference.
        why: String,
    },
    /// The error of the answer has no bound.
    #[error("{id}")]
    Edge {
        /// The check.
        id: String,
        /// The number at which the answer jumps.
        source: AllowanceError,
    },
    /// The author's answer differs.
    #[error(
        "{id}: on paper the answer is {paper}, the reference has {ours}; name in `under` the \
         courses in which it holds"
    )]
    Paper {
        /// The check.
        id: String,
        /// The answer on paper, as JSON.
        paper: String,
        /// The reference's answer, as JSON.
        ours: String,
    },
    /// The list cannot be encoded.
    #[error("the answers cannot be encoded")]
    Encode(#[from] serde_json::Error),
}

/// Returns the file of answers to the unit checks of a stage that was loaded for `course`, or
/// `None` if it has no checks.
///
/// # Errors
/// An error for each check that is ill posed, or whose answer on paper differs from the
/// reference's.
pub fn of_checks(
    stages: &Path,
    stage: &Stage,
    course: &Course,
) -> Result<Option<Expected>, Vec<CheckError>> {
    if stage.checks.is_empty() {
        return Ok(None);
    }
    let (mut answers, mut wrong) = (Vec::new(), Vec::new());
    for check in &stage.checks {
        match of_check(check, course) {
            Ok(answer) => answers.push(answer),
            Err(why) => wrong.push(why),
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let text = answer::check_answers_to_string(&answers).map_err(|why| vec![why.into()])?;
    Ok(Some(Expected {
        path: answer::check_answers_path(stages, &stage.id),
        bytes: text.into_bytes(),
    }))
}

/// Returns the answer to one check of a stage that was loaded for `course`, with the answers of
/// known mistakes.
///
/// # Errors
/// The check is ill posed, or its answer on paper differs from the reference's.
pub fn of_check(check: &Check, course: &Course) -> Result<CheckAnswer, CheckError> {
    let rules = &Rules::of(course);
    let (answer, allowance) = right_answer(check, rules)?;
    let made_from = Digest::of_check(course, check);
    let wrong = wrong(rules, &check.ask, &answer, &allowance);
    let Allowance { allowed, also } = allowance;
    Ok(CheckAnswer { id: check.id.clone(), made_from, answer, allowed, also, wrong })
}

/// Returns the correct answer to one check by these rules, and its allowed error. It is the
/// author's answer on paper if there is one, otherwise the reference's.
///
/// # Errors
/// The check is ill posed, or its answer on paper differs from the reference's.
pub fn right_answer(check: &Check, rules: &Rules) -> Result<(Answer, Allowance), CheckError> {
    let ours = answers::answer(rules, &check.ask);
    if let Answer::Panic(why) = &ours {
        return Err(CheckError::Unanswered { id: check.id.clone(), why: why.clone() });
    }
    let allowance = allowed::allowance(rules, &check.ask, &ours)
        .map_err(|source| CheckError::Edge { id: check.id.clone(), source })?;
    if let Some(paper) = &check.paper {
        let scale = allowed::numbers(paper)
            .into_iter()
            .filter(|n| n.is_finite())
            .fold(1.0, |most, n| n.abs().max(most));
        // The allowed roundings, of 2⁻⁵³ instead of 2⁻²⁴, with a margin.
        let double = allowance.allowed * f64::from(f32::EPSILON);
        let rounding = Allowance { allowed: PAPER * scale + double, also: Vec::new() };
        if !rounding.takes(&ours, paper) {
            let (id, paper, ours) = (check.id.clone(), json(paper), json(&ours));
            return Err(CheckError::Paper { id, paper, ours });
        }
    }
    Ok((check.paper.clone().unwrap_or(ours), allowance))
}

/// Returns the answer of each known mistake that is not accepted as correct.
fn wrong(
    rules: &Rules,
    ask: &Ask,
    right: &Answer,
    allowance: &Allowance,
) -> BTreeMap<String, Answer> {
    let known = misconceptions::of(rules).into_iter();
    let answers = known.map(|wrong| (wrong.id.to_owned(), answers::answer(&wrong.on(rules), ask)));
    answers.filter(|(_, answer)| !allowance.takes(right, answer)).collect()
}

fn json(answer: &Answer) -> String {
    serde_json::to_string(answer).unwrap_or_else(|why| why.to_string())
}
