//! A graded submission: the record, and the pictures behind it that reports show.

use std::collections::BTreeMap;

use cases::answer::ImageAnswer;
use cases::film::Image;
use cases::front::FrontPoint;

use crate::record::Record;

/// The result of grading one submission.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The record, which holds all there is to say.
    pub record: Record,
    /// The pictures behind the image cases that have an answer, by id of the case.
    pub pictures: BTreeMap<String, Pictures>,
}

/// Both pictures of an image case.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// The right one, and how far from it a right one may be.
    pub answer: ImageAnswer,
    /// The program's; `None` where it wrote none that can be read. NaN and infinity may stand in
    /// it.
    pub actual: Option<Image>,
    /// Measurements of the reference's own settings; `None` where nothing was measured.
    pub front: Option<Front>,
}

/// The cost of accuracy in one case.
#[derive(Clone, Debug)]
pub struct Front {
    /// The machine on which it was measured.
    pub machine: String,
    /// A point for each setting of the reference.
    pub points: Vec<FrontPoint>,
}
