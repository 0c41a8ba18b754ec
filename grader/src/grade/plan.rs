//! The checks that are run: the part of the exam that the options select.

use cases::stage::{Case, Check};
use pages::lines::{count, some};

use super::words;
use crate::exam::{Exam, Questions};
use crate::score;

/// The selected checks of the selected stages, each with its points.
pub(super) struct Plan<'a> {
    /// The parts in the order of the exam. No part is empty.
    pub(super) stages: Vec<Part<'a>>,
}

/// The selected checks of one stage.
pub(super) struct Part<'a> {
    /// The whole stage and its answers.
    pub(super) questions: &'a Questions,
    /// The image cases.
    pub(super) cases: Vec<&'a Case>,
    /// The unit checks, each with its thousandths of a point.
    pub(super) checks: Vec<(&'a Check, u64)>,
}

impl<'a> Plan<'a> {
    /// Selects by stage and by check. An empty list selects all.
    ///
    /// # Errors
    /// Returns a message with the possible choices if a word selects nothing.
    pub(super) fn new(
        exam: &'a Exam,
        stages: &[String],
        checks: &[String],
    ) -> Result<Self, String> {
        let ids: Vec<&str> =
            exam.stages.iter().map(|questions| questions.stage.id.as_str()).collect();
        if let Some(word) =
            stages.iter().find(|word| !ids.iter().any(|id| id.starts_with(word.as_str())))
        {
            return Err(words::no_stage(word, &ids));
        }
        let is_chosen = |questions: &&Questions| is_selected(&questions.stage.id, stages);
        let parts: Vec<Part> =
            exam.stages.iter().filter(is_chosen).map(|questions| part(questions, checks)).collect();
        let is_idle = |word: &&String| {
            let one = std::slice::from_ref(*word);
            !parts.iter().flat_map(Part::ids).any(|id| is_selected(id, one))
        };
        if let Some(word) = checks.iter().find(is_idle) {
            let of = |questions: &'a Questions| part(questions, &[]).ids().collect::<Vec<_>>();
            let known: Vec<&str> = exam.stages.iter().filter(is_chosen).flat_map(of).collect();
            return Err(words::no_check(word, &known));
        }
        let is_empty = |part: &Part| part.cases.is_empty() && part.checks.is_empty();
        Ok(Self { stages: parts.into_iter().filter(|part| !is_empty(part)).collect() })
    }

    /// Returns the plan without its unit checks.
    pub(super) fn pictures_only(mut self) -> Self {
        self.stages.iter_mut().for_each(|part| part.checks.clear());
        self
    }

    /// Returns a line on what the words select, or `None` if each of them names one whole stage.
    pub(super) fn summary(&self, stages: &[String], checks: &[String]) -> Option<String> {
        if checks.is_empty() && self.stages.len() <= stages.len().max(1)
            || stages.is_empty() && checks.is_empty()
        {
            return None;
        }
        let words = if checks.is_empty() { stages } else { checks };
        let n = self.stages.iter().flat_map(Part::ids).count();
        let place = match self.stages.as_slice() {
            [one] => one.questions.stage.id.clone(),
            several => count(several.len(), "stage"),
        };
        let verb = if n == 1 { "matches" } else { "match" };
        Some(format!(
            "{} in {place} {verb} {}",
            count(n, "check"),
            some(words.iter().map(String::as_str), 5)
        ))
    }
}

fn part<'a>(questions: &'a Questions, words: &[String]) -> Part<'a> {
    let stage = &questions.stage;
    let points = score::split(stage.unit_points, stage.checks.len());
    Part {
        questions,
        cases: stage.cases.iter().filter(|case| is_selected(&case.id, words)).collect(),
        checks: stage
            .checks
            .iter()
            .zip(points)
            .filter(|(check, _)| is_selected(&check.id, words))
            .collect(),
    }
}

impl<'a> Part<'a> {
    /// Returns the ids of the selected checks.
    pub(super) fn ids(&self) -> impl Iterator<Item = &'a str> {
        let checks = self.checks.iter().map(|(check, _)| check.id.as_str());
        self.cases.iter().map(|case| case.id.as_str()).chain(checks)
    }
}

/// Returns whether `id`, or its part after the stage, begins with one of `words`. An empty list
/// selects all.
fn is_selected(id: &str, words: &[String]) -> bool {
    words.is_empty()
        || words
            .iter()
            .any(|word| id.starts_with(word.as_str()) || behind(id).starts_with(word.as_str()))
}

/// Returns the part of an id after the stage.
fn behind(id: &str) -> &str {
    id.split_once('/').map_or("", |(_, behind)| behind)
}
