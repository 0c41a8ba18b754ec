//! The answers to the unit checks: the right one, how far from it a right one may be, and what known mistakes say.

use std::collections::BTreeMap;
use std::path::Path;

use cases::answer::{self, CheckAnswer};
use cases::probe::{Answer, Ask};
use cases::stage::{Check, Stage};

use super::Expected;
use super::allowed::{self, Allowance};
use crate::answers;
use crate::misconceptions;
use crate::rules::Rules;

/// Relative error of an answer on paper against the reference in double precision.
const PAPER: f64 = 1e-12;

/// The answers to the unit checks of a stage by these rules; `None` where it has none.
///
/// # Errors
/// A sentence for every check that is ill posed, or whose answer on paper is not the reference's.
pub fn of_checks(stages: &Path, stage: &Stage, rules: &Rules) -> Result<Option<Expected>, Vec<String>> {
    if stage.checks.is_empty() {
        return Ok(None);
    }
    let (mut answers, mut wrong) = (Vec::new(), Vec::new());
    for check in &stage.checks {
        match of_check(check, rules) {
            Ok(answer) => answers.push(answer),
            Err(why) => wrong.push(why),
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let text = answer::check_answers_to_string(&answers).map_err(|why| vec![why.to_string()])?;
    Ok(Some(Expected { path: answer::check_answers_path(stages, &stage.id), bytes: text.into_bytes() }))
}

/// The answer to one check: the author's where there is one and it is right, else the reference's.
///
/// # Errors
/// Why the check cannot stand as it is.
pub fn of_check(check: &Check, rules: &Rules) -> Result<CheckAnswer, String> {
    let ours = answers::answer(rules, &check.ask);
    if let Answer::Panic(why) = &ours {
        return Err(format!("{}: the question cannot be answered: {why}", check.id));
    }
    let allowance = allowed::allowance(rules, &check.ask, &ours)
        .map_err(|why| format!("{}: {why}; choose numbers farther from the edge", check.id))?;
    if let Some(paper) = &check.paper {
        let scale =
            allowed::numbers(paper).into_iter().filter(|n| n.is_finite()).fold(1.0, |most, n| n.abs().max(most));
        let double = allowance.allowed * f64::from(f32::EPSILON); // the same roundings, of 2⁻⁵³ in the place of 2⁻²⁴, with room
        let agrees = allowed::distance(paper, &ours).is_some_and(|distance| distance <= PAPER * scale + double);
        if !agrees {
            return Err(format!(
                "{}: on paper the answer is {}, the reference has {}",
                check.id,
                json(paper),
                json(&ours)
            ));
        }
    }
    let answer = check.paper.clone().unwrap_or(ours);
    let wrong = wrong(rules, &check.ask, &answer, &allowance);
    let Allowance { allowed, either } = allowance;
    Ok(CheckAnswer { id: check.id.clone(), answer, allowed, either, wrong })
}

/// What each known mistake says, where that is not right.
fn wrong(rules: &Rules, ask: &Ask, right: &Answer, allowance: &Allowance) -> BTreeMap<String, Answer> {
    let known = misconceptions::of(rules).into_iter();
    let answers = known.map(|wrong| (wrong.id.to_owned(), answers::answer(&wrong.on(rules), ask)));
    answers.filter(|(_, answer)| !allowance.takes(right, answer)).collect()
}

fn json(answer: &Answer) -> String {
    serde_json::to_string(answer).unwrap_or_else(|why| why.to_string())
}
