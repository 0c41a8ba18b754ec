//! A submission written in the template: the student's files, and nothing else, join the pristine rest.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::listing::{self, shown};
use super::{Kind, Submission, SubmissionError, Template, refuse};

/// Bytes that one source file may have.
const MAX_SOURCE: u64 = 1 << 20;
/// Files that are named when they are left aside; of more the number is told.
const MAX_NAMED: usize = 20;

/// Sources that are ready to be compiled.
#[derive(Debug)]
pub struct Rust {
    /// Text by path, such as `src/sphere.rs`; `src/main.rs` is among them.
    pub sources: BTreeMap<String, String>,
}

/// Takes the files that the template lists as the student's; of the rest it only tells.
pub(super) fn read(folder: &Path, template: &Template) -> Result<Submission, SubmissionError> {
    let listing = listing::list(folder).ok_or_else(|| {
        SubmissionError::Refused("it holds more than 2000 files: hand in the template alone".to_owned())
    })?;
    let files: BTreeSet<&Path> = listing.files.iter().map(PathBuf::as_path).collect();
    let mut ignored = listing.ignored;
    ignored.extend(listing.files.iter().filter_map(|file| left_aside(folder, file, template)));
    abridge(&mut ignored);
    let mut sources = template.pristine.clone();
    for (name, untouched) in &template.student {
        let path = folder.join(name);
        let text = if files.contains(Path::new(name)) {
            listing::read_text(&path, MAX_SOURCE).map_err(|why| refuse(name, &why))?
        } else if path.symlink_metadata().is_ok() {
            return Err(refuse(name, "is a link or lies behind one; put the file itself there"));
        } else {
            ignored.push(format!("{name}: missing, so the template's untouched one is taken"));
            untouched.clone()
        };
        sources.insert(name.clone(), text);
    }
    sources.retain(|name, _| name.starts_with("src/"));
    let digest = digest(sources.iter().map(|(name, text)| (name.as_str(), text.as_bytes())));
    Ok(Submission { kind: Kind::Rust(Rust { sources }), digest, ignored, _unpacked: None })
}

/// Why a file of the folder does not count; `None` where it does, or where it is as handed out.
fn left_aside(folder: &Path, file: &Path, template: &Template) -> Option<String> {
    let Some(name) = file.to_str() else {
        return Some(format!("{}: its name is not UTF-8", shown(file)));
    };
    if template.student.contains_key(name) {
        return None;
    }
    let ours = std::fs::read(template.folder.join(name)).ok();
    match ours {
        None => Some(format!("{}: not a file of the template", shown(file))),
        Some(ours) if listing::read_bytes(&folder.join(file), MAX_SOURCE).is_ok_and(|theirs| theirs == ours) => None,
        Some(_) => Some(format!("{}: differs from the template's, which is taken instead", shown(file))),
    }
}

fn abridge(ignored: &mut Vec<String>) {
    if ignored.len() > MAX_NAMED {
        let more = ignored.len() - MAX_NAMED;
        ignored.truncate(MAX_NAMED);
        ignored.push(format!("and {more} more files"));
    }
}

/// blake3 over names and contents, each with its length before it.
pub(super) fn digest<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> String {
    let mut hasher = blake3::Hasher::new();
    for (name, bytes) in files {
        for part in [name.as_bytes(), bytes] {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
    }
    hasher.finalize().to_hex().to_string()
}
