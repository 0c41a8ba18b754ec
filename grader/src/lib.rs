//! The grader: builds submissions, runs and judges them case by case, and scores them.

pub mod alike;
pub mod batch;
pub mod blame;
pub mod build;
pub mod cli;
pub mod collect;
pub mod diagnose;
pub mod exam;
pub mod exercise;
pub mod files;
pub mod functions;
pub mod grade;
pub mod graded;
pub mod input;
pub mod judge;
pub mod leftovers;
pub mod lint;
pub mod record;
pub mod report;
pub mod sandbox;
pub mod score;
pub mod submission;
pub mod tracer;
pub mod workers;

pub use pages::plain;
