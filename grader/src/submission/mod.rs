//! Reads a hand-in, a folder or an archive, as untrusted data before it is built.

pub mod archive;
mod aside;
mod contents;
mod error;
mod language;
pub mod limits;
mod listing;
mod locate;
mod nature;
mod own;
mod reading;
mod rust;
mod template;

use std::io;
use std::path::{Path, PathBuf};

pub use contents::{Kind, Own, Rust, Submission};
pub use error::SubmissionError;
pub use language::Language;
pub use nature::without_ending;
pub use reading::{ReadError, open_regular};
pub use template::Template;

use crate::plain;
use crate::sandbox::Folder;
use archive::ArchiveError;
use aside::{Aside, Why};
use limits::LIMITS;
use listing::Listing;
use locate::{Layout, Located};
use nature::Nature;

/// Reads the submission at `path`, a folder or an archive.
///
/// The submission may lie some folders deep, or in the only archive of the hand-in.
///
/// # Errors
/// See [`SubmissionError`].
pub fn read(path: &Path, template: &Template) -> Result<Submission, SubmissionError> {
    let is_folder =
        std::fs::metadata(path).map_err(|why| SubmissionError::of_path(path, why))?.is_dir();
    let mut place = if is_folder { Place::folder(path)? } else { Place::archive(path)? };
    let mut remarks = vec![];
    let mut unpacked = vec![];
    if let Located::Archive(name) = place.locate(template)? {
        remarks.push(outside("archive", &name));
        let inner = Place::archive(&place.top.join(name))?;
        unpacked.extend(std::mem::replace(&mut place, inner).unpacked);
    }
    let Located::Submission(folder, layout) = place.locate(template)? else {
        return Err(SubmissionError::Refused(
            "it holds nothing but an archive within an archive".to_owned(),
        ));
    };
    remarks.extend(taken_from(&folder, layout));
    let mut submission = match layout {
        Layout::Own => own::read(&place.top, &folder, place.listing)?,
        Layout::Template | Layout::Flat => {
            rust::read(&place.top, &folder, layout, place.listing, template)?
        }
    };
    submission.ignored.splice(0..0, remarks);
    submission._unpacked = unpacked.into_iter().chain(place.unpacked).collect();
    Ok(submission)
}

/// Returns a remark on where the submission lies, if not at the top and in its usual form.
///
/// The remark completes "left aside ...".
fn taken_from(folder: &str, layout: Layout) -> Option<String> {
    match (folder, layout) {
        ("", Layout::Flat) => Some(
            "the missing folder `src`: the .rs files at the top are taken as its files".to_owned(),
        ),
        (_, Layout::Flat) => {
            Some(outside("folder", folder) + ", its .rs files as those of the missing folder `src`")
        }
        ("", _) => None,
        (_, _) => Some(outside("folder", folder)),
    }
}

fn outside(kind: &str, name: &str) -> String {
    format!(
        "everything outside of the {kind} `{}`: the submission is taken from there",
        plain::name(name.as_bytes())
    )
}

/// A folder, and the files that lie in it.
struct Place {
    top: PathBuf,
    listing: Listing,
    unpacked: Option<Folder>,
}

impl Place {
    fn folder(path: &Path) -> Result<Self, SubmissionError> {
        Ok(Self { top: path.to_owned(), listing: listing::list(path, &LIMITS)?, unpacked: None })
    }

    fn archive(path: &Path) -> Result<Self, SubmissionError> {
        let (unpacked, aside) = unpack(path)?;
        let mut place = Self::folder(unpacked.path())?;
        place.listing.aside.extend(aside);
        Ok(Self { unpacked: Some(unpacked), ..place })
    }

    /// Finds the submission. If there is none, it may lie in a folder that cannot be read, which is
    /// then the error.
    fn locate(&mut self, template: &Template) -> Result<Located, SubmissionError> {
        locate::locate(&self.listing, template).map_err(|why| {
            let aside = &mut self.listing.aside;
            match aside.iter().position(|aside| matches!(aside.why, Why::Unreadable(_))) {
                Some(at) => SubmissionError::of_aside(&self.top, aside.swap_remove(at)),
                None => SubmissionError::Refused(why),
            }
        })
    }
}

/// Unpacks the archive at `path`. Returns the folder with its files, and the parts that were left
/// aside.
fn unpack(path: &Path) -> Result<(Folder, Vec<Aside>), SubmissionError> {
    let name = path.file_name().unwrap_or_default().as_encoded_bytes();
    let failed = |why| match why {
        ReadError::Io(source) => SubmissionError::of_path(path, source),
        ReadError::TooLarge(excess) => SubmissionError::Refused(format!("the archive {excess}")),
        why => SubmissionError::of_path(path, io::Error::new(io::ErrorKind::InvalidInput, why)),
    };
    let start = reading::start(path, nature::START_BYTES).map_err(failed)?;
    let Some(Nature::Archive(format)) = nature::of(name, &start) else {
        return Err(SubmissionError::Refused(nature::refusal(name, nature::of(name, &start))));
    };
    if start.is_empty() {
        return Err(SubmissionError::Refused("the file is empty: hand it in again".to_owned()));
    }
    let bytes =
        reading::open_named(path).and_then(|file| reading::read_rest(file, LIMITS.archive_bytes));
    let bytes = bytes.map_err(failed)?;
    let into = Folder::new()?;
    let aside = archive::unpack(&bytes, format, into.path(), &LIMITS).map_err(|why| match why {
        ArchiveError::Machine(source) => SubmissionError::of_temporary(source),
        why => SubmissionError::Refused(format!("the archive cannot be taken: {why}")),
    })?;
    Ok((into, aside))
}

/// Returns whether a regular file beside other hand-ins is one of them: an archive of any kind, a
/// source or a document.
///
/// Lists and notes of the people who collect the hand-ins are none. A file without an ending in its
/// name is judged by its first bytes.
pub fn looks_handed_in(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().as_encoded_bytes();
    let by_bytes =
        || nature::by_bytes(&reading::start(path, nature::START_BYTES).unwrap_or_default());
    match nature::by_name(name) {
        None if !name.contains(&b'.') => {
            matches!(by_bytes(), Some(Nature::Archive(_) | Nature::Packed(_)))
        }
        by_name => by_name.is_some(),
    }
}

#[cfg(test)]
mod tests;
