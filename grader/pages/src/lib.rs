//! What both programs share when they print: guards for foreign text, streams, wrapping, progress,
//! completions, man pages.
//!
//! The crate knows no other crate of the workspace, so that the grader and the reference can both
//! use it and stay apart.

pub mod bar;
pub mod lines;
pub mod plain;
pub mod say;
pub mod shell;
