//! Lists the hand-ins of a class as its platform exported them, and joins them to the roster.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use cases::problem::Problems;

use super::error::BatchError;
use super::submissions::{self, LeftAside, Submission};
use crate::collect::class::{Class, Count, Score};
use crate::collect::export::{Entry, Export, Exported, hand_ins, missing};
use crate::collect::gradescope;
use crate::collect::policy::Policy;
use crate::collect::roll::Roll;
use crate::collect::roster::Roster;
use crate::plain;

/// A roster, and how hand-ins are joined to it.
#[derive(Clone, Debug)]
pub struct Collect {
    /// The students.
    pub roster: Roster,
    /// The policy for late hand-ins.
    pub policy: Option<Policy>,
    /// The platform that exported the folder.
    pub export: Export,
    /// The hand-in that counts.
    pub count: Count,
}

/// The content of a folder of hand-ins.
pub(super) struct Listed {
    /// The submissions to be graded.
    pub(super) submissions: Vec<Submission>,
    pub(super) left_aside: Vec<LeftAside>,
    /// The class, if there is a roster.
    pub(super) collected: Option<Collected>,
}

/// The hand-ins of a folder, joined to the students.
pub(super) struct Collected {
    class: Class,
    /// The id of each hand-in, in the order of the class.
    ids: Vec<String>,
}

/// Most bytes of Gradescope's metadata, which hold the results of all earlier submissions.
const MAX_METADATA_BYTES: u64 = 256 << 20;

/// Lists the hand-ins in `folder`, and joins them to the students if there is a roster.
pub(super) fn list(
    folder: &Path,
    out: &Path,
    collect: Option<&Collect>,
) -> Result<Listed, BatchError> {
    let unreadable = |source| BatchError::Folder { folder: folder.to_owned(), source };
    let Some(collect) = collect else {
        let (submissions, left_aside) = submissions::list(folder, out).map_err(unreadable)?;
        return Ok(Listed { submissions, left_aside, collected: None });
    };
    let top = top(folder, collect.export).map_err(unreadable)?;
    let (mut found, mut left_aside) = submissions::list(&top, out).map_err(unreadable)?;
    left_aside.retain(|aside| aside.name != gradescope::FILE);
    if top != folder {
        left_aside.extend(beside(folder, &top).map_err(unreadable)?);
    }
    let metadata = metadata(&top, collect.export)?;
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let entry = |one: &Submission| Entry { name: name(&one.path), is_folder: one.path.is_dir() };
    let entries: Vec<Entry> = found.iter().map(entry).collect();
    let shown = name(&top.canonicalize().unwrap_or_else(|_| top.clone()));
    let exported = Exported { folder: &shown, entries: &entries, metadata: metadata.as_ref() };
    let hand_ins = hand_ins(collect.export, exported)?;
    let mut class = Class::new(collect.roster.clone(), hand_ins, collect.policy, collect.count);
    class.note_missing(&missing(exported));
    let ids = found.iter().map(|one| one.id.clone()).collect();
    let mut is_graded = class.is_graded().into_iter();
    found.retain(|_| is_graded.next().unwrap_or(true));
    let collected = Some(Collected { class, ids });
    Ok(Listed { submissions: found, left_aside, collected })
}

impl Collected {
    /// Returns the roll, from the scores of the submissions that have a record, by id.
    pub(super) fn roll(&self, scores: &BTreeMap<&str, Score>) -> Roll {
        let scores: Vec<Option<Score>> =
            self.ids.iter().map(|id| scores.get(&**id).copied()).collect();
        self.class.settle(&scores, &self.ids)
    }
}

/// Returns the folder with the hand-ins: `folder`, or the only export of Gradescope in it.
fn top(folder: &Path, export: Export) -> io::Result<PathBuf> {
    let has_metadata = |folder: &Path| folder.join(gradescope::FILE).is_file();
    if !matches!(export, Export::Auto | Export::Gradescope) || has_metadata(folder) {
        return Ok(folder.to_owned());
    }
    let mut exports = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if !path.is_symlink() && has_metadata(&path) {
            exports.push(path);
        }
    }
    match &exports[..] {
        [] => Ok(folder.to_owned()),
        [one] => Ok(one.clone()),
        _ => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it holds several exports of Gradescope: name one of them",
        )),
    }
}

/// Returns what lies beside the export `top` in `folder`.
fn beside(folder: &Path, top: &Path) -> io::Result<Vec<LeftAside>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path != top {
            let name = path.file_name().unwrap_or_default().as_encoded_bytes();
            found.push(LeftAside { name: plain::name(name), why: "it lies beside the export" });
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

/// Returns what the metadata of Gradescope in the folder say, if there are any.
fn metadata(
    top: &Path,
    export: Export,
) -> Result<Option<BTreeMap<String, gradescope::Submission>>, BatchError> {
    let path = top.join(gradescope::FILE);
    if !matches!(export, Export::Auto | Export::Gradescope) || !path.is_file() {
        return Ok(None);
    }
    let name = path.display().to_string();
    let unreadable = |source| BatchError::Folder { folder: path.clone(), source };
    if path.metadata().map_err(unreadable)?.len() > MAX_METADATA_BYTES {
        let message = format!("it has more than {MAX_METADATA_BYTES} bytes, which is the limit");
        return Err(Problems::of_file(name, message, None).into());
    }
    let bytes = std::fs::read(&path).map_err(unreadable)?;
    Ok(Some(gradescope::parse(&name, &bytes)?))
}

#[cfg(test)]
mod tests;
