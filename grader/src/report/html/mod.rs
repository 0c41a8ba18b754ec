//! The report of one submission as a page that needs nothing else: no network, no neighbour, no
//! server.
//!
//! | file | holds |
//! |---|---|
//! | `view.rs` | the record turned into what the template shows |
//! | `diff.rs` | two texts, line by line |
//! | `front.rs` | time and error among those of the reference |
//! | `picture.rs` | pictures as data URIs |
//! | `page.rs` | the template engine, the policy that lets only our script run |
//! | `submission.html`, `submission.js`, `../style.css` | how it looks and moves |
//!
//! What a student's program wrote is hostile here: it goes through
//! [`plain::shown`](crate::plain::shown), is escaped by the template engine, and could not run if
//! it got through, for the policy names the hash of the one script allowed.

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

/// The page for a submission.
pub fn render(graded: &Graded) -> String {
    let (style, script) = (include_str!("../style.css"), include_str!("submission.js"));
    page::render(include_str!("submission.html"), style, script, &view::submission(graded))
}

/// Writes the page for a submission to `path`; it appears whole or not at all.
///
/// # Errors
/// What the file system says.
pub fn write(path: &Path, graded: &Graded) -> io::Result<()> {
    files::write(path, render(graded).as_bytes())
}
