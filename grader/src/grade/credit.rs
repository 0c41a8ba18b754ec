//! Points for what is right in spite of a known mistake. A mistake that shows in every picture is
//! paid for in the stage that teaches its rule. Elsewhere, what it explains counts as right, up to
//! a share of the points.

use std::collections::BTreeSet;

use cases::answer::Mistake;
use cases::stage::Case;

use super::answers::{Answers, Credit, Done};
use super::plan::{Part, Plan};
use crate::diagnose::{Explanation, Sheet};
use crate::exam::Exam;
use crate::judge;
use crate::record::{Confidence, Diagnosis, Verdict};
use crate::score;

/// The share of the points of a stage's pictures below which the stage gets no credit.
const SHOWN: f64 = 0.25;

/// Returns the credits of the wrong pictures among `answers`. `sheets` are the sheets of the cases.
///
/// A picture gets a credit only for mistakes that are named surely, that belong to another stage of
/// the plan, and that cost points there. Film mistakes get none, because no stored picture holds
/// them; beside one, the stored pictures of other mistakes hold nothing that was seen. A stage of
/// which the program shows little gets none either.
pub(super) fn credits(
    exam: &Exam,
    plan: &Plan,
    answers: &Answers,
    sheets: &[&Sheet],
    explanation: &Explanation,
) -> Vec<Credit> {
    if explanation.is_undone {
        return vec![];
    }
    let is_paid = |one: &&Diagnosis| {
        let home = one.mistakes.first().and_then(|mistake| home(exam, mistake.rule));
        let part = plan.stages.iter().find(|part| Some(part.questions.stage.id.as_str()) == home);
        part.is_some_and(|part| part.ids().any(|id| explains(one, id) && is_lost(answers, id)))
    };
    let paid: Vec<&Diagnosis> = explanation
        .diagnoses
        .iter()
        .filter(|one| one.confidence == Confidence::Surely)
        .filter(is_paid)
        .collect();
    let cases = plan.stages.iter().flat_map(|part| part.cases.iter().map(move |one| (part, *one)));
    let credit = |(part, case): (&Part, &Case)| {
        let sheet = sheets.iter().find(|sheet| sheet.id == case.id)?;
        let belongs =
            |one: &&Diagnosis| one.mistakes.iter().any(|it| belongs(exam, it, part, case));
        let by: Vec<&str> = paid
            .iter()
            .filter(|one| explains(one, &case.id) && !belongs(one))
            .filter_map(|one| Some(one.mistakes.first()?.id.as_str()))
            .collect();
        let here = explanation.diagnoses.iter().filter(belongs);
        let here = here.flat_map(|one| &one.mistakes).map(|mistake| mistake.id.as_str());
        of_case(answers, part, case, sheet, (&by, &here.collect::<Vec<_>>()))
    };
    let credits: Vec<Credit> = cases.filter_map(credit).collect();
    let shown = plan.stages.iter().filter(|part| is_shown(answers, part, &credits));
    let shown: BTreeSet<&str> = shown.flat_map(Part::ids).collect();
    credits.into_iter().filter(|credit| shown.contains(credit.id.as_str())).collect()
}

/// Returns whether the program shows what a stage teaches: with the credits, its pictures earn at
/// least [`SHOWN`] of their points.
///
/// Some mistakes resemble a program without the stage: with one bounce too few, a case of a single
/// bounce shows none. Without this condition, a program of an earlier stage would earn points here.
fn is_shown(answers: &Answers, part: &Part, credits: &[Credit]) -> bool {
    let earned = |case: &&Case| {
        let credit = credits.iter().find(|credit| credit.id == case.id);
        let judgement = answers.done.get(&case.id).map(|done| &done.judgement);
        match (credit, judgement) {
            (Some(credit), _) => score::score(Verdict::Partial, credit.share, case.points).earned,
            (None, Some(one)) => score::score(one.verdict, one.share, case.points).earned,
            (None, None) => 0,
        }
    };
    let possible: u64 = part.cases.iter().map(|case| case.points).sum();
    part.cases.iter().map(earned).sum::<u64>() as f64 >= SHOWN * possible as f64
}

/// Returns the credit of a picture for the mistakes `by`, or `None` if it earns no more with them.
/// Pixels that one of the mistakes `here` changes stay wrong: they are paid for in this case.
fn of_case(
    answers: &Answers,
    part: &Part,
    case: &Case,
    sheet: &Sheet,
    (by, here): (&[&str], &[&str]),
) -> Option<Credit> {
    if by.is_empty() || !is_lost(answers, &case.id) {
        return None;
    }
    let done = answers.done.get(&case.id)?;
    let answer = part.questions.images.get(&case.id)?;
    let actual = done.picture.as_ref()?;
    let explained = sheet.explained(actual, by, here);
    let out = answer.out(actual).into_iter().zip(explained);
    let out: Vec<bool> = out.map(|(is_out, is_explained)| is_out && !is_explained).collect();
    let share = judge::earned(answer, &out).min(part.questions.stage.explained_share);
    let before = done.judgement.share;
    (share > before).then(|| Credit {
        id: case.id.clone(),
        share,
        before,
        mistakes: by.iter().map(|id| (*id).to_owned()).collect(),
    })
}

/// Raises the shares of the pictures with a credit.
pub(super) fn give(answers: &mut Answers, credits: Vec<Credit>) {
    for credit in &credits {
        let Some(done) = answers.done.get_mut(&credit.id) else { continue };
        done.judgement.verdict = Verdict::Partial;
        done.judgement.share = credit.share;
        if let Some(finding) = &mut done.judgement.finding {
            finding.share = Some(credit.share);
        }
    }
    answers.credits = credits;
}

/// Returns whether a mistake is paid for in a case: its stage teaches the rule, or the case names
/// it. A rule that no stage teaches is paid for everywhere.
fn belongs(exam: &Exam, mistake: &Mistake, part: &Part, case: &Case) -> bool {
    let home = home(exam, mistake.rule);
    home.is_none_or(|home| home == part.questions.stage.id) || case.rules.contains(&mistake.rule)
}

/// Returns the id of the stage that teaches a rule: the first with a picture that names it.
fn home(exam: &Exam, rule: u8) -> Option<&str> {
    let stages = exam.stages.iter().map(|one| &one.stage);
    let names = |case: &Case| case.rules.contains(&rule);
    stages.filter(|one| one.cases.iter().any(names)).map(|one| one.id.as_str()).next()
}

fn explains(diagnosis: &Diagnosis, id: &str) -> bool {
    diagnosis.explains.iter().any(|one| one.id == id)
}

/// Returns whether a check loses points because its answer is wrong.
fn is_lost(answers: &Answers, id: &str) -> bool {
    answers.done.get(id).is_some_and(Done::is_wrong)
}
