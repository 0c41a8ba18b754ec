//! The diagnosis of a submission: collects the evidence of every case and check about the known
//! mistakes, and names the mistakes that explain it.

use std::collections::BTreeMap;

use cases::answer::{Mistake, Wrong, image_answer_path, load};
use cases::stage::{Case, Check};
use rayon::prelude::*;

use super::perform::{Answers, Done};
use super::plan::{Part, Plan};
use crate::diagnose::{self, Evidence, Named};
use crate::exam::Exam;
use crate::record::{Diagnosis, FindingKind, Verdict};

/// Returns the known mistakes that explain the errors in `answers`, the one that explains most
/// first. Also writes their ids to the findings that they explain. The pictures of mistakes are
/// unpacked only if an answer is wrong.
pub(super) fn diagnose(exam: &Exam, plan: &Plan, answers: &mut Answers) -> Vec<Diagnosis> {
    if !answers.done.values().any(|done| state(done) == State::Wrong) {
        return vec![];
    }
    let cases: Vec<(&Part, &Case)> = plan
        .stages
        .iter()
        .flat_map(|part| part.cases.iter().map(move |one| (part, *one)))
        .collect();
    let checks = plan
        .stages
        .iter()
        .flat_map(|part| part.checks.iter().map(move |(one, points)| (part, *one, *points)));
    let mut evidence: Vec<Evidence> = cases
        .par_iter()
        .filter_map(|(part, case)| of_case(exam, part, case, answers.done.get(&case.id)?))
        .collect();
    evidence.extend(checks.filter_map(|(part, check, points)| {
        of_check(part, check, points, answers.done.get(&check.id)?)
    }));
    let named = diagnose::rank(&evidence);
    for one in &named {
        for id in &one.explains {
            let finding = answers.done.get_mut(id).and_then(|done| done.judgement.finding.as_mut());
            finding
                .into_iter()
                .for_each(|finding| finding.diagnosis = one.mistakes.first().cloned());
        }
    }
    let known: BTreeMap<&str, &Mistake> =
        exam.mistakes.iter().map(|mistake| (mistake.id.as_str(), mistake)).collect();
    named.iter().map(|named| diagnosis(named, &known)).collect()
}

fn diagnosis(named: &Named, known: &BTreeMap<&str, &Mistake>) -> Diagnosis {
    let mistakes = named
        .mistakes
        .iter()
        .filter_map(|id| known.get(id.as_str()).map(|mistake| (*mistake).clone()));
    Diagnosis { mistakes: mistakes.collect(), explains: named.explains.clone() }
}

/// The meaning of a judgement for a diagnosis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Right,
    Wrong,
    /// The result could not be judged, or only a person can judge it.
    Undecided,
}

fn state(done: &Done) -> State {
    let kind = done.judgement.finding.as_ref().map(|finding| finding.kind);
    match (done.judgement.verdict, kind) {
        (Verdict::Pass, None | Some(FindingKind::Remark)) => State::Right,
        (Verdict::Partial | Verdict::Fail, Some(FindingKind::Wrong)) => State::Wrong,
        _ => State::Undecided,
    }
}

fn of_case(exam: &Exam, part: &Part, case: &Case, done: &Done) -> Option<Evidence> {
    let (width, height) = (case.scene.render.width, case.scene.render.height);
    let bytes = || load::bytes(&image_answer_path(&exam.folder, &case.id)).ok();
    match state(done) {
        State::Right => {
            Some(Evidence::right(&case.id, case.points, Wrong::ids(&bytes()?, width, height).ok()?))
        }
        State::Wrong => {
            let answer = part.questions.images.get(&case.id)?;
            let mistakes = Wrong::decode_all(&bytes()?, width, height).ok()?;
            let shares = diagnose::picture(done.picture.as_ref()?, answer, &mistakes);
            Some(Evidence::wrong(&case.id, case.points, shares))
        }
        State::Undecided => None,
    }
}

fn of_check(part: &Part, check: &Check, points: u64, done: &Done) -> Option<Evidence> {
    let right = part.questions.units.get(&check.id)?;
    match state(done) {
        State::Right => Some(Evidence::right(&check.id, points, right.wrong.keys().cloned())),
        State::Wrong => {
            Some(Evidence::wrong(&check.id, points, diagnose::unit(done.answer.as_ref()?, right)))
        }
        State::Undecided => None,
    }
}
