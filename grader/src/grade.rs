//! One submission from folder to record.

use std::collections::BTreeMap;
use std::path::PathBuf;

use cases::answer::Tolerance;
use cases::film::Image;

use crate::record::Record;

/// What to grade, and which part of the exam.
#[derive(Clone, Debug)]
pub struct Options {
    /// Folder or archive.
    pub submission: PathBuf,
    /// How it is called in the record.
    pub name: String,
    /// Stages to grade: ids, or what they begin with, such as `02`. Empty: all.
    pub stages: Vec<String>,
    /// Checks to grade: ids, or what they begin with, such as `01_ray_casting/sphere`. Empty: all.
    pub cases: Vec<String>,
    /// Programs that run at once; at least 1.
    pub jobs: usize,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Graded {
    /// All there is to say, for reports.
    pub record: Record,
    /// The pictures behind the image cases that have an answer, by id of the case.
    pub pictures: BTreeMap<String, Pictures>,
}

/// Both pictures of an image case.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// The right one.
    pub expected: Image,
    /// The program's; `None` where it wrote none that can be read. NaN and infinity may stand in it.
    pub actual: Option<Image>,
    /// How far they may be apart.
    pub tolerance: Tolerance,
}

/// Hears how far the work has come. Called from several threads.
pub trait Progress: Sync {
    /// Something that takes a while begins, such as `compiling`.
    fn phase(&self, what: &str);
    /// `n_checks` programs are about to be run.
    fn begin(&self, n_checks: u64);
    /// One of them has ended.
    fn step(&self);
}

/// Hears nothing.
pub struct Silent;

impl Progress for Silent {
    fn phase(&self, _what: &str) {}
    fn begin(&self, _n_checks: u64) {}
    fn step(&self) {}
}

/// Why there is no record: nothing of this is the student's fault.
#[derive(Debug, thiserror::Error)]
pub enum GradeError {
    /// What was asked for cannot be read, or is not there: exit code 2.
    #[error("{0}")]
    Input(String),
    /// The machine or the grader failed: exit code 3.
    #[error("{0}")]
    Machine(String),
}
