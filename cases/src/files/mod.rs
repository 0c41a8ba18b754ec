//! Resolves file names, reads whole files, and writes whole files.
//!
//! A file is replaced whole: a reader sees the old content or the new content, never a part of it.
//! Streams, pipes and devices are written to in place, because a file must never replace them.

mod place;
mod read;
mod set;
mod write;

pub use place::{Place, is_standard, is_stdout, is_stream};
pub use read::{ReadError, read, read_text};
pub use set::write_all;
pub use write::{WriteError, check, is_usage, write};
