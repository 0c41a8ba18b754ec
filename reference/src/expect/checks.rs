//! The answers to the unit checks: the correct answer, its allowed error, and the answers of known
//! mistakes.

use std::collections::BTreeMap;
use std::path::Path;

use cases::Course;
use cases::answer::{self, CheckAnswer, Digest};
use cases::probe::{Answer, Ask};
use cases::stage::{Check, Stage};

use super::allowed::{self, Allowance};
use super::expected::Expected;
use crate::rules::Rules;
use crate::rules::misconceptions;
use crate::trace::answers;

/// Allowed relative error of an answer on paper against the reference in double precision.
const PAPER: f64 = 1e-12;

/// Returns the file of answers to the unit checks of a stage that was loaded for `course`, or
/// `None` if it has no checks.
///
/// # Errors
/// A sentence for each check that is ill posed, or whose answer on paper differs from the
/// reference's.
pub fn of_checks(
    stages: &Path,
    stage: &Stage,
    course: &Course,
) -> Result<Option<Expected>, Vec<String>> {
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
    let text = answer::check_answers_to_string(&answers).map_err(|why| vec![why.to_string()])?;
    Ok(Some(Expected {
        path: answer::check_answers_path(stages, &stage.id),
        bytes: text.into_bytes(),
    }))
}

/// Returns the answer to one check of a stage that was loaded for `course`, with the answers of
/// known mistakes.
///
/// # Errors
/// A sentence if the check is ill posed, or its answer on paper differs from the reference's.
pub fn of_check(check: &Check, course: &Course) -> Result<CheckAnswer, String> {
    let rules = &Rules::of(course);
    let (answer, allowance) = right_answer(check, rules)?;
    let made_from = Digest::of_check(course, check);
    let wrong = wrong(rules, &check.ask, &answer, &allowance);
    let Allowance { allowed, either } = allowance;
    Ok(CheckAnswer { id: check.id.clone(), made_from, answer, allowed, either, wrong })
}

/// Returns the correct answer to one check by these rules, and its allowed error. It is the
/// author's answer on paper if there is one, otherwise the reference's.
///
/// # Errors
/// A sentence if the check is ill posed, or its answer on paper differs from the reference's.
pub fn right_answer(check: &Check, rules: &Rules) -> Result<(Answer, Allowance), String> {
    let ours = answers::answer(rules, &check.ask);
    if let Answer::Panic(why) = &ours {
        return Err(format!("{}: the question cannot be answered: {why}", check.id));
    }
    let allowance = allowed::allowance(rules, &check.ask, &ours)
        .map_err(|why| format!("{}: {why}; choose numbers farther from the edge", check.id))?;
    if let Some(paper) = &check.paper {
        let scale = allowed::numbers(paper)
            .into_iter()
            .filter(|n| n.is_finite())
            .fold(1.0, |most, n| n.abs().max(most));
        // The allowed roundings, of 2⁻⁵³ instead of 2⁻²⁴, with a margin.
        let double = allowance.allowed * f64::from(f32::EPSILON);
        let rounding = Allowance { allowed: PAPER * scale + double, either: false };
        if !rounding.takes(&ours, paper) {
            return Err(format!(
                "{}: on paper the answer is {}, the reference has {}; name in `under` the \
                    courses in which it holds",
                check.id,
                json(paper),
                json(&ours)
            ));
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
