//! What is handed in: a folder or an archive, read with care and not yet built.

pub mod archive;
mod listing;
mod own;
mod rust;
mod template;

use std::path::{Path, PathBuf};

pub use listing::{open_regular, read_text};
pub use own::Own;
pub use rust::Rust;
pub use template::Template;

use crate::plain;
use crate::sandbox::{Folder, FolderError};

/// A submission whose files have been read or listed.
#[derive(Debug)]
pub struct Submission {
    /// How it is to be built.
    pub kind: Kind,
    /// blake3 over the names and contents of the files that count.
    pub digest: String,
    /// What was left aside, and why.
    pub ignored: Vec<String>,
    /// Where an archive was unpacked; goes away with this.
    _unpacked: Option<Folder>,
}

/// The two kinds of submission.
#[derive(Debug)]
pub enum Kind {
    /// The template, filled in.
    Rust(Rust),
    /// Anything else, with a `submission.toml`.
    Own(Own),
}

/// Why there is nothing to grade.
#[derive(Debug, thiserror::Error)]
pub enum SubmissionError {
    /// The path leads nowhere: whoever called us is to blame.
    #[error("{}: {why}", path.display())]
    Unreadable {
        /// As it was given.
        path: PathBuf,
        /// What the system says.
        why: std::io::Error,
    },
    /// What is there is no submission; says why and what to do.
    #[error("{0}")]
    Refused(String),
    /// The machine kept it from being read; nobody who wrote it is to blame.
    #[error(transparent)]
    Machine(#[from] FolderError),
}

/// Reads the submission at `path`: a folder, a folder with a single folder in it, or an archive of either.
///
/// # Errors
/// A path that leads nowhere, what is no submission, and no room to unpack an archive.
pub fn read(path: &Path, template: &Template) -> Result<Submission, SubmissionError> {
    let unreadable = |why| SubmissionError::Unreadable { path: path.to_owned(), why };
    if std::fs::metadata(path).map_err(unreadable)?.is_dir() {
        return read_folder(&find(path)?, template);
    }
    let unpacked = Folder::new()?;
    archive::unpack(path, unpacked.path(), &archive::Limits::default())
        .map_err(|why| SubmissionError::Refused(format!("the archive cannot be taken: {why}")))?;
    let submission = read_folder(&find(unpacked.path())?, template)?;
    Ok(Submission { _unpacked: Some(unpacked), ..submission })
}

fn read_folder(folder: &Path, template: &Template) -> Result<Submission, SubmissionError> {
    if folder.join(own::MANIFEST).exists() { own::read(folder) } else { rust::read(folder, template) }
}

/// The folder that holds `submission.toml` or `src`: `folder` itself, or the only one in it that does.
fn find(folder: &Path) -> Result<PathBuf, SubmissionError> {
    let is_one = |folder: &Path| folder.join(own::MANIFEST).is_file() || folder.join("src").is_dir();
    if is_one(folder) {
        return Ok(folder.to_owned());
    }
    let mut inner: Vec<PathBuf> = std::fs::read_dir(folder)
        .map_err(|why| SubmissionError::Unreadable { path: folder.to_owned(), why })?
        .flatten()
        .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()))
        .map(|entry| entry.path())
        .filter(|folder| is_one(folder))
        .collect();
    match (inner.pop(), inner.is_empty()) {
        (Some(only), true) => Ok(only),
        (None, _) => Err(SubmissionError::Refused(format!(
            "there is neither a folder `src` nor a `{}` in it: hand in the folder of the template, with its `src`",
            own::MANIFEST
        ))),
        (Some(_), false) => {
            Err(SubmissionError::Refused("several folders in it look like submissions: hand in one of them".to_owned()))
        }
    }
}

/// Refuses for what is wrong with one file.
fn refuse(file: &str, why: &str) -> SubmissionError {
    SubmissionError::Refused(format!("{}: {why}", plain::name(file.as_bytes())))
}

#[cfg(test)]
mod tests;
