//! The diagnosis of a submission: collects the evidence of every case and check, and names the
//! mistakes that explain it.

use std::collections::BTreeMap;

use cases::answer::{Mistake, Wrong, image_answer_path, load};
use cases::stage::{Case, Check};
use rayon::prelude::*;

use super::answers::{Answers, Done, State};
use super::credit;
use super::plan::{Part, Plan};
use crate::diagnose::{self, Explanation, Reply, Sheet};
use crate::exam::Exam;
use crate::record::{Diagnosis, FindingKind};
use crate::submission::Language;
use crate::tracer::Tracer;

/// Returns the known mistakes that explain the errors in `answers`, and what they leave
/// unexplained. Also writes the ids of the mistakes to the findings that they explain most of, and
/// raises the shares of pictures that earn more because of them. The layers of the mistakes are
/// unpacked only if an answer is wrong.
///
/// If there is a tracer, it confirms the mistakes. Points do not depend on it, so that a
/// student's own run gives the same ones.
///
/// The place to look at names a file only if the program is made from a `template`.
pub(super) fn diagnose(
    (exam, tracer): (&Exam, Option<&Tracer>),
    plan: &Plan,
    answers: &mut Answers,
    template: Option<Language>,
) -> Explanation {
    if !answers.done.values().any(|done| done.state() == State::Wrong) {
        return Explanation::default();
    }
    let cases: Vec<(&Part, &Case)> = plan
        .stages
        .iter()
        .flat_map(|part| part.cases.iter().map(move |one| (part, *one)))
        .collect();
    let sheets: Vec<(Sheet, &Case)> = cases
        .par_iter()
        .filter_map(|(part, case)| {
            answers.done.get(&case.id).filter(|done| done.state() != State::Undecided)?;
            Some((sheet(exam, part, case)?, *case))
        })
        .collect();
    let picture = |id: &str| answers.done.get(id)?.picture.as_ref();
    let (pictures, cases): (Vec<_>, Vec<&Case>) = sheets
        .iter()
        .filter_map(|(sheet, case)| Some(((sheet, picture(&case.id)?), *case)))
        .unzip();
    let checks = plan
        .stages
        .iter()
        .flat_map(|part| part.checks.iter().map(move |(check, _)| (part, *check)));
    let replies =
        checks.filter_map(|(part, check)| reply(part, check, answers.done.get(&check.id)?));
    let known: Vec<Mistake> =
        exam.mistakes.iter().map(|mistake| addressed(mistake, template)).collect();
    let explanation = diagnose::diagnose(&pictures, replies.collect(), &known);
    let all: Vec<&Sheet> = sheets.iter().map(|(sheet, _)| sheet).collect();
    let credits = credit::credits(exam, plan, answers, &all, &explanation);
    let explanation = match tracer {
        None => explanation,
        Some(tracer) => {
            let end = tracer.end();
            let render = |at: usize, ids: &[&str]| tracer.render(&exam.folder, cases[at], ids, end);
            diagnose::confirm(&pictures, explanation, &known, &render)
        }
    };
    credit::give(answers, credits);
    label(answers, &explanation.diagnoses);
    explanation
}

/// Returns the mistake with a place to look at that the author of the program knows: the file in
/// the language of the template, or no file if the program is not made from a template.
fn addressed(mistake: &Mistake, template: Option<Language>) -> Mistake {
    let (file, function) = mistake.look_at.split_once(' ').unwrap_or_default();
    let look_at = match template {
        Some(language) if !file.is_empty() => {
            let stem = file.strip_suffix(".rs").unwrap_or(file);
            format!("{} {function}", language.file(stem))
        }
        _ => function.to_owned(),
    };
    Mistake { look_at, ..mistake.clone() }
}

/// Writes to each finding the id of the mistake that explains most of it. Of equal ones the first
/// counts.
fn label(answers: &mut Answers, diagnoses: &[Diagnosis]) {
    let mut most: BTreeMap<&str, (u64, &str)> = BTreeMap::new();
    for diagnosis in diagnoses {
        let Some(mistake) = diagnosis.mistakes.first() else { continue };
        for one in &diagnosis.explains {
            let best = most.entry(&one.id).or_insert((one.pixels, &mistake.id));
            if one.pixels > best.0 {
                *best = (one.pixels, &mistake.id);
            }
        }
    }
    for (id, (_, mistake)) in most {
        let finding = answers.done.get_mut(id).and_then(|done| done.judgement.finding.as_mut());
        if let Some(finding) = finding.filter(|finding| finding.kind == FindingKind::Wrong) {
            finding.diagnosis = Some(mistake.to_owned());
        }
    }
}

fn sheet(exam: &Exam, part: &Part, case: &Case) -> Option<Sheet> {
    let (width, height) = (case.scene.render.width, case.scene.render.height);
    let bytes = load::bytes(&image_answer_path(&exam.folder, &case.id)).ok()?;
    let mistakes = Wrong::decode_all(&bytes, width, height).ok()?;
    Some(Sheet::new(&case.id, part.questions.images.get(&case.id)?, &mistakes))
}

fn reply(part: &Part, check: &Check, done: &Done) -> Option<Reply> {
    let right = part.questions.units.get(&check.id)?;
    let state = done.state();
    let is_right = state == State::Right;
    (state != State::Undecided).then_some(Reply::new(
        &check.id,
        is_right,
        done.answer.as_ref()?,
        right,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::Judgement;
    use crate::record::{Confidence, Explained, Finding};

    fn mistake(id: &str) -> Mistake {
        Mistake {
            id: id.to_owned(),
            rule: 7,
            says: "the mirror is turned".to_owned(),
            look_at: "reflection.rs reflect".to_owned(),
            field: "mirror".to_owned(),
        }
    }

    #[test]
    fn a_place_to_look_at_is_named_as_its_author_knows_it() {
        let table = [
            ("sphere.rs intersect_sphere", Some(Language::Rust), "sphere.rs intersect_sphere"),
            ("sphere.rs intersect_sphere", Some(Language::Cpp), "sphere.cpp intersect_sphere"),
            ("cuboid.rs intersect_box", Some(Language::Python), "cuboid.py intersect_box"),
            ("cuboid.rs intersect_box", None, "intersect_box"),
            ("", Some(Language::Cpp), ""),
        ];
        for (look_at, template, expected) in table {
            let mistake = Mistake { look_at: look_at.to_owned(), ..mistake("a") };
            assert_eq!(addressed(&mistake, template).look_at, expected);
        }
    }

    #[test]
    fn a_finding_gets_the_mistake_that_explains_most_of_it() {
        let wrong = || Judgement::fail(Finding::new(FindingKind::Wrong, "wrong"));
        let todo = Judgement::not_run(Finding::new(FindingKind::Todo, "to do"));
        let judgements = [("x", wrong()), ("y", wrong()), ("z", todo), ("p", Judgement::PASS)];
        let done = judgements.map(|(id, one)| (id.to_owned(), Done::unmeasured(one, None)));
        let mut answers = Answers { done: done.into(), ..Answers::default() };
        let diagnosis = |id: &str, explains: &[(&str, u64)]| Diagnosis {
            mistakes: vec![mistake(id)],
            confidence: Confidence::Perhaps,
            explains: explains
                .iter()
                .map(|(id, pixels)| Explained {
                    id: (*id).to_owned(),
                    pixels: *pixels,
                    region: None,
                })
                .collect(),
        };
        let first = diagnosis("a", &[("x", 10), ("y", 30), ("z", 9), ("p", 1)]);
        label(&mut answers, &[first, diagnosis("b", &[("x", 20), ("y", 30)])]);
        let named = |id: &str| answers.done[id].judgement.finding.as_ref()?.diagnosis.clone();
        assert_eq!(
            ["x", "y", "z", "p"].map(named),
            [Some("b".into()), Some("a".into()), None, None]
        );
        let states = ["x", "z", "p"].map(|id| answers.done[id].state());
        assert!(states == [State::Wrong, State::Undecided, State::Right]);
    }
}
