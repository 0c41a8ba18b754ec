//! What lies in a folder of submissions, under ids that are safe as file names and in links.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

use crate::plain;
use crate::submission::{looks_handed_in, without_ending};

/// A folder, an archive, or a single file that looks like somebody's work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// Of letters, digits, `.`, `_`, `-` and `~`; no two are equal, not even but for case.
    pub id: String,
    /// The file's name without its ending, made harmless to show.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
}

/// What lies beside the submissions and is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftAside {
    /// The file's name, made harmless to show.
    pub name: String,
    /// Why it was left aside.
    pub why: &'static str,
}

/// All submissions in `folder`, ordered by id; `out`, should it lie there, is not one.
pub(super) fn list(folder: &Path, out: &Path) -> io::Result<(Vec<Submission>, Vec<LeftAside>)> {
    let out = out.canonicalize().ok();
    let (mut found, mut left_aside) = (Vec::new(), Vec::new());
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let is_out = out.is_some() && path.canonicalize().ok() == out;
        match why_not(&path)? {
            Some(why) => left_aside
                .push(LeftAside { name: plain::name(file_name(&path).as_encoded_bytes()), why }),
            None if is_out => {}
            None => found.push(path),
        }
    }
    left_aside.sort_by(|a, b| a.name.cmp(&b.name));
    Ok((named(found), left_aside))
}

fn why_not(path: &Path) -> io::Result<Option<&'static str>> {
    let kind = path.symlink_metadata()?.file_type();
    let name = file_name(path).as_encoded_bytes();
    Ok(match () {
        () if name.starts_with(b".") || name == b"__MACOSX" => {
            Some("made by a system, not by a student")
        }
        () if kind.is_symlink() => Some("a link: its target may be anywhere"),
        () if kind.is_dir() || (kind.is_file() && looks_handed_in(path)) => None,
        () => Some(
            "neither a folder nor an archive (.zip, .tar.gz, .tgz, .tar) nor a single source or \
                document",
        ),
    })
}

/// Gives each its id: its name where that is safe and nobody else's, else with a piece of its hash.
fn named(mut paths: Vec<PathBuf>) -> Vec<Submission> {
    paths.sort();
    let mut takers: BTreeMap<String, usize> = BTreeMap::new();
    for path in &paths {
        *takers.entry(slug(stem(path)).to_lowercase()).or_default() += 1;
    }
    let submission = |path: PathBuf| {
        let slug = slug(stem(&path));
        let is_its_own =
            slug.as_bytes() == stem(&path) && takers.get(&slug.to_lowercase()) == Some(&1);
        let hash = blake3::hash(file_name(&path).as_encoded_bytes()).to_hex();
        let id = if is_its_own { slug } else { format!("{slug}~{}", &hash[..12]) };
        Submission { id, name: plain::name(stem(&path)), path }
    };
    let mut submissions: Vec<Submission> = paths.into_iter().map(submission).collect();
    submissions.sort_by(|a, b| a.id.cmp(&b.id));
    submissions
}

fn file_name(path: &Path) -> &OsStr {
    path.file_name().unwrap_or_default()
}

/// Returns the name without the ending of an archive.
fn stem(path: &Path) -> &[u8] {
    let name = file_name(path).as_encoded_bytes();
    if path.is_dir() { name } else { without_ending(name) }
}

/// At most 80 safe characters; others become `_`.
fn slug(name: &[u8]) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
    let text = String::from_utf8_lossy(name);
    let safe: String = text.chars().take(80).map(|c| if is_safe(c) { c } else { '_' }).collect();
    if safe.starts_with(['.', '-']) || safe.is_empty() { format!("_{safe}") } else { safe }
}
