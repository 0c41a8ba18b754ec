//! The commands of `grader`, one module each.

pub(crate) mod batch;
pub(crate) mod compare;
pub(crate) mod doctor;
pub(crate) mod explain;
pub(crate) mod grade;
pub(crate) mod gradebook;
pub(crate) mod images;
pub(crate) mod lint;
pub(crate) mod publish;
pub(crate) mod shell;
