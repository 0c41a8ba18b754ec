//! Writes the record from the plan and its results.

use std::collections::BTreeMap;

use cases::front::FrontPoint;

use super::answers::{self, Answers, Done};
use super::bounds;
use super::plan::{Part, Plan};
use crate::diagnose::Explanation;
use crate::exam::Exam;
use crate::functions;
use crate::graded::{Front, Pictures};
use crate::judge::Judgement;
use crate::record::{
    Build, CheckKind, CheckRecord, Credit, FindingKind, Record, SCHEMA, Score, StageRecord,
    Submission, Verdict,
};
use crate::score;
use crate::submission::Language;

/// The version of the grader.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The protection of a record for which nothing was run.
const NOTHING_RUN: &str = "nothing was run";

/// Returns the whole record, as of a submission of which nothing was run.
pub(super) fn record(
    epoch: String,
    submission: Submission,
    build: Build,
    stages: Vec<StageRecord>,
    explanation: Explanation,
) -> Record {
    let of = |stage: &StageRecord| Score { earned: stage.earned, possible: stage.possible };
    Record {
        schema: SCHEMA,
        grader: VERSION.to_owned(),
        epoch,
        interrupted: is_interrupted(&build, &stages),
        submission,
        sandbox: NOTHING_RUN.to_owned(),
        build,
        score: score::total(stages.iter().map(of)),
        diagnoses: explanation.diagnoses,
        unexplained: explanation.unexplained,
        stages,
    }
}

/// Rewrites the messages on functions that are still to be written, so that they name the function,
/// and its file if the program is made from a `template`.
pub(super) fn name_functions(answers: &mut Answers, template: Option<Language>) {
    let findings = answers.done.values_mut().filter_map(|done| done.judgement.finding.as_mut());
    for finding in findings.filter(|finding| finding.kind == FindingKind::Todo) {
        let key = finding
            .asked
            .as_ref()
            .and_then(|question| question.get("fn"))
            .and_then(|key| key.as_str());
        if let Some(key) = key {
            finding.message = functions::still_to_be_written(key, template);
        }
    }
}

/// Returns whether the user stopped the grader, so that the build or a check was not run to its
/// end. Only an interrupt is the fault of neither the submission nor the machine.
fn is_interrupted(build: &Build, stages: &[StageRecord]) -> bool {
    let checks =
        stages.iter().flat_map(|stage| &stage.checks).map(|check| (check.verdict, &check.finding));
    checks.chain([(build.verdict, &build.finding)]).any(|(verdict, finding)| {
        let is_internal =
            finding.as_ref().is_some_and(|finding| finding.kind == FindingKind::Internal);
        verdict == Verdict::NotRun && is_internal
    })
}

/// Returns the stages in order, and both pictures of each image case that has an answer.
pub(super) fn stages(
    plan: &Plan,
    mut answers: Answers,
    exam: &Exam,
) -> (Vec<StageRecord>, BTreeMap<String, Pictures>) {
    let mut pictures = BTreeMap::new();
    let stage = |part| stage(part, &mut answers, &mut pictures);
    let mut stages: Vec<StageRecord> = plan.stages.iter().map(stage).collect();
    bounds::apply(&mut stages);
    if let Ok(Some(fronts)) = &exam.fronts {
        for (id, pictures) in &mut pictures {
            let front = |points: &Vec<FrontPoint>| Front {
                machine: fronts.machine.clone(),
                is_old: exam.fronts_are_old,
                points: points.clone(),
            };
            pictures.front = fronts.cases.get(id).map(front);
        }
    }
    (stages, pictures)
}

fn stage(
    part: &Part,
    answers: &mut Answers,
    pictures: &mut BTreeMap<String, Pictures>,
) -> StageRecord {
    let stage = &part.questions.stage;
    let mut checks = vec![];
    for case in &part.cases {
        let mut done = take(answers, &case.id);
        if let Some(answer) = part.questions.images.get(&case.id) {
            let (answer, actual) = (answer.clone(), done.picture.take());
            pictures.insert(case.id.clone(), Pictures { answer, actual, front: None });
        }
        let about = (case.about.as_str(), case.rules.as_slice());
        let mut record = check(&case.id, CheckKind::Image, about, case.points, done);
        let credit = answers.credits.iter().find(|credit| credit.id == case.id);
        record.credit = credit.map(|credit| credited(credit, record.earned, case.points));
        checks.push(record);
    }
    for (unit, points) in &part.checks {
        let done = take(answers, &unit.id);
        checks.push(check(&unit.id, CheckKind::Unit, (&unit.about, &unit.rules), *points, done));
    }
    let Score { earned, possible } = score::total(
        checks.iter().map(|check| Score { earned: check.earned, possible: check.possible }),
    );
    let remarks = answers.remarks.remove(&stage.id).unwrap_or_default();
    StageRecord {
        id: stage.id.clone(),
        title: stage.title.clone(),
        earned,
        possible,
        checks,
        remarks,
    }
}

/// Returns the part of the points that a picture earns only because of its credit.
fn credited(credit: &answers::Credit, earned: u64, points: u64) -> Credit {
    let before = score::score(Verdict::Partial, credit.before, points).earned;
    Credit { points: earned.saturating_sub(before), mistakes: credit.mistakes.clone() }
}

fn take(answers: &mut Answers, id: &str) -> Done {
    let ours = || Done::unmeasured(Judgement::ours("it was planned, but not run"), None);
    answers.done.remove(id).unwrap_or_else(ours)
}

fn check(
    id: &str,
    kind: CheckKind,
    (about, rules): (&str, &[u8]),
    points: u64,
    done: Done,
) -> CheckRecord {
    let Judgement { verdict, share, finding } = done.judgement;
    let Score { earned, possible } = score::score(verdict, share, points);
    // Less than a thousandth of a point is nothing.
    let verdict = if verdict == Verdict::Partial && earned == 0 { Verdict::Fail } else { verdict };
    CheckRecord {
        id: id.to_owned(),
        kind,
        about: about.trim().to_owned(),
        rules: rules.to_vec(),
        verdict,
        earned,
        possible,
        credit: None,
        finding,
        time_s: done.time_s,
        cpu_s: done.cpu_s,
        peak_bytes: done.peak_bytes,
    }
}
