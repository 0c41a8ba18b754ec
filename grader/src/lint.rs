//! Finds problems in a set of cases and its answers, beyond those that keep it from being read.

mod apart;
mod layers;
mod sharpness;

use std::collections::BTreeSet;
use std::path::Path;

use cases::answer::{check_answers_path, expected_png_path, image_answer_path, mistakes_path};
use cases::stage::{Base, Case};
use cases::{Course, effects};

pub use apart::alike;
pub use layers::LayersError;
use layers::layers;
use pages::say;

use crate::blame::{self, Blame};
use crate::exam::{Exam, Questions};
use crate::files;
use crate::judge;
use crate::record::Verdict;
use crate::report::words::points;

/// The least number of image cases in a stage; fewer leave too much to chance.
const MIN_CASES: usize = 8;

/// The result of checking a set of cases.
#[derive(Debug)]
pub struct Found {
    /// All problems. A problem that quotes a file has escape codes for colour.
    pub problems: Vec<String>,
    /// A line for each stage, and a line with the sum.
    pub summary: Vec<String>,
    /// The party to blame for the problems: the machine if it fails to read one of the files.
    pub blame: Blame,
}

/// Checks the stages in `folder`. If a file is invalid, only the problems of the files are
/// reported.
pub fn lint(folder: &Path) -> Found {
    let exam = match Exam::load(folder) {
        Ok(exam) => exam,
        Err(problems) => {
            let blame = blame::of_problems(&problems);
            return Found { problems: vec![problems.render(true)], summary: vec![], blame };
        }
    };
    let mut problems = vec![];
    for questions in &exam.stages {
        cases(&exam, questions, &mut problems);
        checks(questions, &mut problems);
        sharpness(&exam, questions, &mut problems);
    }
    answers(&exam, &mut problems);
    if let Err(why) = &exam.fronts {
        problems.push(format!("{} (`reference cost --store` measures it again)", say::chain(why)));
    }
    unknown_files(&exam, &mut problems);
    let is_of_machine = exam.faults.iter().any(|fault| blame::of(&fault.why) == Blame::Machine);
    let blame = if is_of_machine { Blame::Machine } else { Blame::File };
    Found { problems, summary: summary(&exam), blame }
}

/// Checks that there are enough cases, and at least one for each effect that the stage adds.
fn cases(exam: &Exam, questions: &Questions, problems: &mut Vec<String>) {
    let stage = &questions.stage;
    let added = match stage.base {
        Base::Background => stage.allows,
        Base::Without(added) => added,
    };
    if stage.cases.len() < MIN_CASES {
        problems.push(format!(
            "{}: {} image cases, at least {MIN_CASES} are wanted",
            stage.id,
            stage.cases.len()
        ));
    }
    // A choice of the course may remove an effect, as opaque shadows remove tinted ones. Then it is
    // enough that a case shows the effect in the lecture's course.
    let shows = |case: &Case, effect| {
        [&exam.course, &Course::default()]
            .iter()
            .any(|course| effects::called_for(&case.scene, course).has(effect))
    };
    for effect in added.iter() {
        if !stage.cases.iter().any(|case| shows(case, effect)) {
            problems
                .push(format!("{}: allows `{effect}`, but no case of it calls for that", stage.id));
        }
    }
    for id in stage.cases.iter().filter(|case| case.points == 0).map(|case| &case.id) {
        problems.push(format!("{id}: is worth no points"));
    }
    if stage.checks.is_empty() != (stage.unit_points == 0) {
        let (n, all) = (stage.checks.len(), points(stage.unit_points));
        problems.push(format!("{}: {n} unit checks share {all} points", stage.id));
    }
}

/// Checks that each question has a trusted answer, and that no answer is left over.
fn answers(exam: &Exam, problems: &mut Vec<String>) {
    for fault in &exam.faults {
        let renewal = exam.renewal(&fault.subject);
        problems.push(format!("{}: {} (`{renewal}` renews it)", fault.subject, fault.why));
    }
    for id in &exam.surplus {
        problems.push(format!(
            "{id}: there is a stored answer, but no such check (`reference expect` removes it)"
        ));
    }
}

/// Checks the pictures of a stage. Correct tracers must agree on them, the intended mistakes must
/// show, and a tracer without the stage must not produce them.
fn sharpness(exam: &Exam, questions: &Questions, problems: &mut Vec<String>) {
    for case in &questions.stage.cases {
        let Some(answer) = questions.images.get(&case.id) else { continue };
        match layers(exam, case) {
            Ok(wrong) => problems.extend(sharpness::problems(case, answer, &wrong, &exam.mistakes)),
            Err(why) => problems.push(say::chain(&why)),
        }
    }
}

/// Checks that stored answers agree with those on paper, and can be judged.
fn checks(questions: &Questions, problems: &mut Vec<String>) {
    let mut seen = BTreeSet::new();
    for check in &questions.stage.checks {
        if !seen.insert(&check.id) {
            problems.push(format!("{}: there are two checks of this name", check.id));
        }
        let Some(right) = questions.units.get(&check.id) else { continue };
        if let Some(paper) = &check.paper
            && judge::unit(paper, right, check.ask.function()).verdict != Verdict::Pass
        {
            let (paper, stored) = judge::lines(paper, &right.answer, right.allowed);
            problems.push(format!(
                "{}: paper and stored answer differ\non paper:\n{paper}stored:\n{stored}",
                check.id
            ));
        }
        if !right.allowed.is_finite() || right.allowed < 0.0 {
            problems.push(format!("{}: the allowed error is {}", check.id, right.allowed));
        }
    }
}

/// Reports answers and pictures that belong to no case.
fn unknown_files(exam: &Exam, problems: &mut Vec<String>) {
    let stages = exam.stages.iter().map(|questions| &questions.stage);
    let mut known: BTreeSet<_> =
        stages.clone().map(|stage| check_answers_path(&exam.folder, &stage.id)).collect();
    known.insert(mistakes_path(&exam.folder));
    for case in stages.flat_map(|stage| &stage.cases) {
        known.insert(image_answer_path(&exam.folder, &case.id));
        known.insert(expected_png_path(&exam.folder, &case.id));
    }
    let is_answer = |name: &str| {
        [".answer.exr", ".expected.png", ".answers.json"].iter().any(|end| name.ends_with(end))
    };
    for file in files::below(&exam.folder).unwrap_or_default() {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if is_answer(&name) && !known.contains(&file) {
            problems.push(format!("{}: belongs to no case", file.display()));
        }
    }
}

fn summary(exam: &Exam) -> Vec<String> {
    let mut all = 0;
    let line = |questions: &Questions| {
        let stage = &questions.stage;
        let possible = stage.cases.iter().map(|case| case.points).sum::<u64>() + stage.unit_points;
        all += possible;
        let (n_cases, n_checks) = (stage.cases.len(), stage.checks.len());
        format!(
            "{}: {n_cases} cases, {n_checks} unit checks, {} points",
            stage.id,
            points(possible)
        )
    };
    let mut lines: Vec<String> = exam.stages.iter().map(line).collect();
    lines.push(format!("{} points in all", points(all)));
    lines.extend(mistakes(exam));
    lines
}

/// Returns a line on the known mistakes, with those that no case and no check distinguishes; `None`
/// where the stored mistakes cannot be read.
fn mistakes(exam: &Exam) -> Option<String> {
    let alike: Vec<String> = alike(exam).ok()?.iter().map(|pair| pair.join(" = ")).collect();
    let n = exam.mistakes.len();
    Some(match alike.as_slice() {
        [] => format!("{n} known mistakes, any two of which differ in some case or check"),
        alike => {
            format!("{n} known mistakes; no case and no check distinguishes {}", alike.join(", "))
        }
    })
}
