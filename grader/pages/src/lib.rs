//! Output code that the grader and the reference share: guards for foreign text, formats of
//! numbers, pages, differences between texts, streams, wrapping, progress, completions, man pages.
//!
//! The crate depends on no other crate of the workspace, so the grader and the reference can use it
//! without depending on each other.

pub mod bar;
pub mod diff;
pub mod figures;
pub mod lines;
pub mod page;
pub mod plain;
pub mod say;
pub mod shell;
