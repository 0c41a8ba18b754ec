//! Resolves file names, reads and writes whole files, and digests the sources of figures.
//!
//! A file is replaced whole: a reader sees the old content or the new content, never a part of it.
//! Streams, pipes and devices are written to in place, because a file must never replace them.

mod place;
mod read;
mod set;
#[cfg(feature = "authoring")]
mod sources;
mod write;

pub use place::{Place, is_standard, is_stdout, is_stream};
pub use read::{ReadError, read, read_text};
pub use set::write_all;
#[cfg(feature = "authoring")]
pub use sources::{digest_in, sources_digest};
pub use write::{WriteError, check, is_usage, write};
