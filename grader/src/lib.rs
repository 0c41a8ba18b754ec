//! The judge: builds and runs submissions case by case, and scores them.

pub mod build;
pub mod files;
pub mod grade;
pub mod plain;
pub mod record;
pub mod report;
pub mod sandbox;
pub mod submission;
