//! Grading a class on one bench: the exam is read and the crates are compiled once for all.

use std::path::Path;

use super::{Grader, Submission};
use crate::grade::{self, Bench, GradeError, Options, Silent};
use crate::graded::Graded;
use crate::{sandbox, submission};

/// The real grader of a class.
#[derive(Debug)]
pub struct OnBench<'a> {
    bench: &'a Bench,
    stages: Vec<String>,
    epoch: String,
}

impl<'a> OnBench<'a> {
    /// Grades the stages whose ids begin with one of the given texts; all where none is given.
    ///
    /// # Errors
    /// No such stage; answers that are missing or stale; no compiler.
    pub fn new(bench: &'a Bench, stages: &[String]) -> Result<Self, GradeError> {
        bench.selected(stages, &[])?;
        let mut stages = stages.to_vec();
        stages.sort();
        grade::check_answers(bench, &Options { stages: stages.clone(), ..Options::new("") })?;
        let epoch = format!("{} {stages:?}", bench.epoch()?);
        Ok(Self { bench, stages, epoch })
    }
}

impl Grader for OnBench<'_> {
    fn epoch(&self) -> &str {
        &self.epoch
    }

    fn digest(&self, path: &Path) -> Option<String> {
        submission::read(path, &self.bench.workshop.template)
            .ok()
            .map(|submission| submission.digest)
    }

    fn grade(&self, submission: &Submission) -> Result<Graded, GradeError> {
        let options = Options {
            name: submission.name.clone(),
            stages: self.stages.clone(),
            jobs: 1,
            ..Options::new(&submission.path)
        };
        grade::grade(self.bench, &options, &Silent)
    }

    fn is_stopped(&self) -> bool {
        sandbox::interrupted()
    }
}
