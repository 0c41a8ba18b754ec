//! The report of one submission as a self-contained page: it needs no network, no other file and no
//! server.
//!
//! | file | holds |
//! |---|---|
//! | `view.rs` | the record as the values that the template shows |
//! | `diff.rs` | two texts, line by line |
//! | `front.rs` | time and error among the settings of the reference |
//! | `picture.rs` | pictures as data URIs |
//! | `page.rs` | the template engine, the policy that lets only our script run |
//! | `submission.html`, `submission.js`, `../style.css` | the look and the interaction |
//!
//! The output of a student's program is treated as hostile. It goes through
//! [`plain::shown`](crate::plain::shown) and is escaped by the template engine. A script in it
//! could not run even then, because the policy allows only the hash of our own script.

use std::io;
use std::path::Path;

use crate::files;
use crate::graded::Graded;

mod diff;
mod front;
pub(super) mod page;
mod picture;
#[cfg(test)]
mod tests;
mod view;

/// Returns the page for a submission.
pub fn render(graded: &Graded) -> String {
    let (style, script) = (include_str!("../style.css"), include_str!("submission.js"));
    page::render(include_str!("submission.html"), style, script, &view::submission(graded))
}

/// Writes the page for a submission to `path`. The file appears whole or not at all.
///
/// # Errors
/// Returns the error of the file system.
pub fn write(path: &Path, graded: &Graded) -> io::Result<()> {
    files::write(path, render(graded).as_bytes())
}
