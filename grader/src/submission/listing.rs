//! Lists an untrusted folder: follows no link, and counts everything.

use std::fs::DirEntry;
use std::io;
use std::path::Path;

use super::aside::{Aside, Why, names};
use super::error::SubmissionError;
use super::limits::{Limits, SKIPPED, is_of_system};
use crate::blame::{self, Blame};

/// The files below a folder.
#[derive(Debug, Default)]
pub(super) struct Listing {
    /// Regular files in order, relative to the folder, with `/` between names.
    pub(super) files: Vec<String>,
    /// Everything that was not listed, in order.
    pub(super) aside: Vec<Aside>,
}

/// Lists `folder`, without the files that tools and operating systems leave there.
///
/// # Errors
/// Fails if the folder cannot be read, the machine fails, or there are more entries than `limits`
/// permit.
pub(super) fn list(folder: &Path, limits: &Limits) -> Result<Listing, SubmissionError> {
    let mut walk = Walk { top: folder, limits, n_entries: 0, listing: Listing::default() };
    walk.folder("", 0)?;
    let mut listing = walk.listing;
    listing.files.sort();
    listing.aside.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(listing)
}

struct Walk<'a> {
    top: &'a Path,
    limits: &'a Limits,
    n_entries: usize,
    listing: Listing,
}

impl Walk<'_> {
    /// Lists the folder `below` the top, `depth` folders deep.
    fn folder(&mut self, below: &str, depth: usize) -> Result<(), SubmissionError> {
        let folder = self.top.join(below);
        let entries = match std::fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(why) if depth == 0 => return Err(SubmissionError::of_path(&folder, why)),
            Err(why) => return self.unreadable(below, why),
        };
        for entry in entries {
            match entry {
                Ok(entry) => self.entry(below, depth, &entry)?,
                Err(why) => return self.unreadable(below, why),
            }
        }
        Ok(())
    }

    fn entry(
        &mut self,
        below: &str,
        depth: usize,
        entry: &DirEntry,
    ) -> Result<(), SubmissionError> {
        let file_name = entry.file_name();
        let bytes = match below {
            "" => file_name.as_encoded_bytes().to_owned(),
            below => [below.as_bytes(), file_name.as_encoded_bytes()].join(&b'/'),
        };
        let kind = match entry.file_type() {
            Ok(kind) => kind,
            Err(why) => return self.unreadable(&String::from_utf8_lossy(&bytes), why),
        };
        let name = file_name.to_string_lossy();
        if kind.is_dir() && SKIPPED.contains(&&*name) || kind.is_file() && is_of_system(&name) {
            return Ok(());
        }
        self.n_entries += 1;
        if self.n_entries > self.limits.entries {
            let most = self.limits.entries;
            let why =
                format!("it holds more than {most} files and folders: hand in the sources alone");
            return Err(SubmissionError::Refused(why));
        }
        let path = match names(&bytes, self.limits.depth) {
            Ok(names) => names.join("/"),
            Err(why) => return self.leave(Aside::new(&bytes, why)),
        };
        match () {
            () if kind.is_dir() => self.folder(&path, depth + 1),
            () if kind.is_file() => {
                self.listing.files.push(path);
                Ok(())
            }
            () if kind.is_symlink() => self.leave(Aside { path, why: Why::Link }),
            () => self.leave(Aside { path, why: Why::Special }),
        }
    }

    fn unreadable(&mut self, path: &str, why: io::Error) -> Result<(), SubmissionError> {
        match blame::of(&why) {
            Blame::Machine => Err(SubmissionError::of_path(&self.top.join(path), why)),
            Blame::File => self.leave(Aside { path: path.to_owned(), why: Why::Unreadable(why) }),
        }
    }

    fn leave(&mut self, aside: Aside) -> Result<(), SubmissionError> {
        self.listing.aside.push(aside);
        Ok(())
    }
}
