//! A graded submission: the record, and the pictures behind it that reports show.

use std::collections::BTreeMap;

use cases::answer::ImageAnswer;
use cases::film::Image;
use cases::front::FrontPoint;

use crate::record::Record;

/// The result of grading one submission.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The record of the grading.
    pub record: Record,
    /// The pictures of the image cases that have an answer, by id of the case.
    pub pictures: BTreeMap<String, Pictures>,
}

/// The expected and the actual picture of an image case.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// The stored answer: the expected picture and its envelope.
    pub answer: ImageAnswer,
    /// The picture of the program, which may contain NaN and infinity; `None` if there is none that
    /// can be read.
    pub actual: Option<Image>,
    /// Measurements of the reference's own settings; `None` if nothing was measured.
    pub front: Option<Front>,
}

/// The cost of accuracy in one case.
#[derive(Clone, Debug)]
pub struct Front {
    /// The machine on which it was measured.
    pub machine: String,
    /// Whether it was measured on other code or cases than the present ones.
    pub is_old: bool,
    /// A point for each setting of the reference.
    pub points: Vec<FrontPoint>,
}
