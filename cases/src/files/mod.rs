//! This module says what a file name stands for, and is the one way to write a file.
//!
//! A file is replaced whole: a reader sees the old content or the new content, never a part of it.
//! Streams, pipes and devices are written to in place, since a file must never replace them.

mod place;
mod write;

pub use place::{Place, is_standard, is_stdout, is_stream};
pub use write::{WriteError, check, is_usage, write};
