//! Which checks are asked: those of the exam that the options select.

use cases::stage::{Case, Check};

use crate::exam::{Exam, Questions};
use crate::score;

/// The selected checks of the selected stages, each with its points.
pub(super) struct Plan<'a> {
    /// In order; none of them empty.
    pub(super) stages: Vec<Part<'a>>,
}

/// What is asked of a stage.
pub(super) struct Part<'a> {
    /// The whole stage and its answers.
    pub(super) questions: &'a Questions,
    /// Image cases.
    pub(super) cases: Vec<&'a Case>,
    /// Unit checks, each with its thousandths of a point.
    pub(super) checks: Vec<(&'a Check, u64)>,
}

impl<'a> Plan<'a> {
    /// Selects by stage and by check; an empty list selects all.
    ///
    /// # Errors
    /// A word that selects nothing; says what there is.
    pub(super) fn new(exam: &'a Exam, stages: &[String], checks: &[String]) -> Result<Self, String> {
        let ids = || exam.stages.iter().map(|questions| questions.stage.id.as_str());
        for word in stages {
            if !ids().any(|id| id.starts_with(word.as_str())) {
                let known: Vec<&str> = ids().collect();
                return Err(format!("there is no stage `{word}`; there are {}", known.join(", ")));
            }
        }
        let is_chosen = |questions: &&Questions| is_selected(&questions.stage.id, stages);
        let parts: Vec<Part> = exam.stages.iter().filter(is_chosen).map(|questions| part(questions, checks)).collect();
        let n_all = |word: &String| {
            let one = std::slice::from_ref(word);
            parts.iter().flat_map(Part::ids).filter(|id| is_selected(id, one)).count()
        };
        if let Some(word) = checks.iter().find(|word| n_all(word) == 0) {
            return Err(format!("there is no case or check `{word}`; ids look like `02_shadows/two_lamps`"));
        }
        let is_empty = |part: &Part| part.cases.is_empty() && part.checks.is_empty();
        Ok(Self { stages: parts.into_iter().filter(|part| !is_empty(part)).collect() })
    }

    /// The same without unit checks.
    pub(super) fn pictures_only(mut self) -> Self {
        self.stages.iter_mut().for_each(|part| part.checks.clear());
        self
    }
}

fn part<'a>(questions: &'a Questions, words: &[String]) -> Part<'a> {
    let stage = &questions.stage;
    let points = score::split(stage.unit_points, stage.checks.len());
    Part {
        questions,
        cases: stage.cases.iter().filter(|case| is_selected(&case.id, words)).collect(),
        checks: stage.checks.iter().zip(points).filter(|(check, _)| is_selected(&check.id, words)).collect(),
    }
}

impl<'a> Part<'a> {
    /// The ids of all that is asked.
    pub(super) fn ids(&self) -> impl Iterator<Item = &'a str> {
        let checks = self.checks.iter().map(|(check, _)| check.id.as_str());
        self.cases.iter().map(|case| case.id.as_str()).chain(checks)
    }
}

/// Whether `id` begins with one of `words`, or its part behind the stage does; an empty list selects all.
fn is_selected(id: &str, words: &[String]) -> bool {
    let behind = id.split_once('/').map_or("", |(_, behind)| behind);
    words.is_empty() || words.iter().any(|word| id.starts_with(word.as_str()) || behind.starts_with(word.as_str()))
}
