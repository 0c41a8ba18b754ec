//! Grades a class on one bench: the exam is read and the crates are compiled once for all
//! submissions.

use std::path::Path;

use super::obtain::Read;
use super::{Grader, Submission};
use crate::alike::Sketch;
use crate::grade::{self, Bench, GradeError, Options, Silent};
use crate::graded::Graded;
use crate::{sandbox, submission};

/// The grader of a class that builds and runs programs.
#[derive(Debug)]
pub struct OnBench<'a> {
    bench: &'a Bench,
    stages: Vec<String>,
    epoch: String,
    /// The fingerprints of the template, which all submissions share.
    given: Sketch,
}

impl<'a> OnBench<'a> {
    /// Returns a grader for the stages whose ids begin with one of the given texts, or for all
    /// stages if none is given.
    ///
    /// # Errors
    /// Fails if there is no such stage, if answers are missing or stale, or if there is no
    /// compiler.
    pub fn new(bench: &'a Bench, stages: &[String]) -> Result<Self, GradeError> {
        bench.selected(stages, &[])?;
        let mut stages = stages.to_vec();
        stages.sort();
        grade::check_answers(bench, &Options { stages: stages.clone(), ..Options::new("") })?;
        let epoch = format!("{} {stages:?}", bench.epoch()?);
        let template = &bench.workshop.template;
        let given = template.pristine.values().chain(template.student.values());
        let given = Sketch::new(given.map(String::as_str), &Sketch::default());
        Ok(Self { bench, stages, epoch, given })
    }
}

impl Grader for OnBench<'_> {
    fn epoch(&self) -> &str {
        &self.epoch
    }

    fn read(&self, path: &Path) -> Option<Read> {
        let submission = submission::read(path, &self.bench.workshop.template).ok()?;
        let sources = submission.sources();
        let sketch = Sketch::new(sources.iter().map(String::as_str), &self.given);
        Some(Read { digest: submission.digest, sketch })
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
