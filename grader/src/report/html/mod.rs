//! The report of one submission as a self-contained page: it needs no network, no other file and no
//! server.
//!
//! | file | holds |
//! |---|---|
//! | `view.rs` | the record as the values that the template shows |
//! | `front.rs` | time and error among the settings of the reference |
//! | `picture.rs` | pictures as data URIs |
//! | `submission.html`, `submission.js`, `../style.css` | the look and the interaction |
//!
//! The output of a student's program is treated as hostile. It goes through
//! [`plain::shown`](crate::plain::shown) and is escaped by the template engine. A script in it
//! could not run even then, because the policy of [`pages::page`] allows only the hash of our own.

use std::io;
use std::path::Path;

use pages::page::{Layout, Serde, Value, context};

use crate::files;
use crate::graded::Graded;

mod front;
mod picture;
#[cfg(test)]
mod tests;
mod view;

/// Returns the page for a submission.
pub fn render(graded: &Graded) -> String {
    let layout = Layout {
        template: include_str!("submission.html"),
        style: include_str!("../style.css"),
        script: include_str!("submission.js"),
    };
    let view = Value::from(Serde(view::submission(graded)));
    pages::page::html(layout, &context! { view })
}

/// Writes the page for a submission to `path`. The file appears whole or not at all.
///
/// # Errors
/// Returns the error of the file system.
pub fn write(path: &Path, graded: &Graded) -> io::Result<()> {
    files::write(path, render(graded).as_bytes())
}
