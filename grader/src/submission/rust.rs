//! Reads a submission in the template: only the student's files are taken, and the grader adds the
//! rest.

use std::collections::BTreeSet;
use std::path::Path;

use super::aside::{Aside, abridged};
use super::contents::{Kind, Rust, Submission};
use super::error::SubmissionError;
use super::limits::SOURCE_BYTES;
use super::listing::Listing;
use super::locate::{Layout, MANIFEST};
use super::reading::{ReadError, read_bytes, read_text};
use super::template::Template;
use crate::blame::{self, Blame};
use crate::plain;

/// The files that no build uses and no remark mentions.
const SILENT: [&str; 3] = ["README.md", "Cargo.lock", ".gitignore"];

/// Takes the files that the student writes from `folder` of the hand-in at `top`, and reports the
/// rest.
///
/// # Errors
/// Fails if one of the student's files cannot be used, or if the machine fails.
pub(super) fn read(
    top: &Path,
    folder: &str,
    layout: Layout,
    listing: Listing,
    template: &Template,
) -> Result<Submission, SubmissionError> {
    let place = Place { folder, layout };
    let Listing { files, mut aside } = listing;
    let there: BTreeSet<&str> = files.iter().map(String::as_str).collect();
    let (mut sources, mut missing) = (template.pristine.clone(), vec![]);
    for (name, untouched) in &template.student {
        let path = place.path(name);
        if let Some(at) = aside.iter().position(|aside| aside.covers(&path)) {
            return Err(SubmissionError::of_aside(top, aside.swap_remove(at)));
        }
        let text = if there.contains(&*path) {
            let full = top.join(&path);
            read_text(&full, SOURCE_BYTES)
                .map_err(|why| SubmissionError::of_file(&full, &path, why))?
        } else {
            missing.push(format!("{name}: missing, so the template's untouched one is taken"));
            untouched.clone()
        };
        sources.insert(name.clone(), text);
    }
    let is_untouched = template.student.iter().all(|(name, text)| sources[name] == *text);
    sources.retain(|name, _| name.starts_with("src/"));
    let digest = digest(sources.iter().map(|(name, text)| (name.as_str(), text.as_bytes())));
    let own = own_folders(&files);
    let is_own = |path: &&String| own.iter().any(|folder| path.starts_with(folder));
    let others = files.iter().filter(|path| !is_own(path));
    let others = others.filter_map(|path| place.other(top, path, template).transpose());
    let others = others.collect::<Result<Vec<Other>, SubmissionError>>()?;
    let (code, others): (Vec<Other>, Vec<Other>) =
        others.into_iter().partition(|other| other.is_code);
    let unused = abridged(code.into_iter().map(|other| other.says).collect());
    let others = others
        .into_iter()
        .map(|other| other.says)
        .chain(aside.iter().map(Aside::to_string))
        .collect();
    let mut ignored = [unused.clone(), missing, abridged(others)].concat();
    if is_untouched {
        ignored.extend(own.iter().map(|folder| {
            let name = plain::name(folder.trim_end_matches('/').as_bytes());
            format!("{name}: a submission in another language; grade this folder by itself")
        }));
    }
    if !unused.is_empty() {
        let used: Vec<&str> = template.student.keys().map(String::as_str).collect();
        ignored.push(format!("all but the files that you write, which are {}", used.join(", ")));
    }
    Ok(Submission {
        kind: Kind::Rust(Rust { sources, unused }),
        digest,
        ignored,
        _unpacked: vec![],
    })
}

/// Returns the folders with a manifest of their own, each with a `/` at its end: the templates in
/// other languages are handed out below the one in Rust.
fn own_folders(files: &[String]) -> Vec<&str> {
    let folders = files.iter().filter_map(|path| path.strip_suffix(MANIFEST));
    folders.filter(|folder| folder.ends_with('/')).collect()
}

/// The place of the template in the hand-in.
struct Place<'a> {
    folder: &'a str,
    layout: Layout,
}

/// A file that does not count.
struct Other {
    says: String,
    /// Whether a build could use the file.
    is_code: bool,
}

impl Place<'_> {
    /// Returns the path in the hand-in of the template's file `name`.
    fn path(&self, name: &str) -> String {
        let name = if self.layout == Layout::Flat {
            name.strip_prefix("src/").unwrap_or(name)
        } else {
            name
        };
        if self.folder.is_empty() { name.to_owned() } else { format!("{}/{name}", self.folder) }
    }

    /// Returns the name in the template of the file at `path`; `None` where it lies elsewhere.
    fn name(&self, path: &str) -> Option<String> {
        let inner = match self.folder {
            "" => path,
            folder => path.strip_prefix(folder)?.strip_prefix('/')?,
        };
        let is_source =
            self.layout == Layout::Flat && !inner.contains('/') && inner.ends_with(".rs");
        Some(if is_source && inner != "build.rs" {
            format!("src/{inner}")
        } else {
            inner.to_owned()
        })
    }

    /// Returns a remark on the file at `path`, or `None` if it counts, is as it was handed out, or
    /// is of no interest.
    fn other(
        &self,
        top: &Path,
        path: &str,
        template: &Template,
    ) -> Result<Option<Other>, SubmissionError> {
        let name = self.name(path);
        let name = name.as_deref().unwrap_or_default();
        if template.student.contains_key(name) || SILENT.contains(&name) {
            return Ok(None);
        }
        let why = match template.pristine.get(name) {
            Some(ours) if is_text(&top.join(path), ours)? => return Ok(None),
            Some(_) => "differs from the given file, which is used instead",
            None => "not a file of the template, so it is not used",
        };
        let is_code =
            name.ends_with(".rs") || name.ends_with("Cargo.toml") || name.starts_with(".cargo/");
        Ok(Some(Other { says: format!("{}: {why}", plain::name(path.as_bytes())), is_code }))
    }
}

/// Returns whether the file holds exactly `text`. A file that cannot be read does not.
fn is_text(path: &Path, text: &str) -> Result<bool, SubmissionError> {
    match read_bytes(path, SOURCE_BYTES) {
        Err(ReadError::Io(why)) if blame::of(&why) == Blame::Machine => {
            Err(SubmissionError::of_path(path, why))
        }
        found => Ok(found.is_ok_and(|found| found == text.as_bytes())),
    }
}

/// Returns the blake3 hash over names and contents, each with its length before it.
pub(super) fn digest<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> String {
    let mut hasher = blake3::Hasher::new();
    for (name, bytes) in files {
        for part in [name.as_bytes(), bytes] {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
    }
    hasher.finalize().to_hex().to_string()
}
