//! Lists a folder of submissions, and gives them ids that are safe as file names and in links.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

use crate::plain;
use crate::submission::{looks_handed_in, without_ending};

/// A folder, an archive, or a single file that looks like a hand-in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The id, of letters, digits, `.`, `_`, `-` and `~`. No two ids are equal, even without regard
    /// to case.
    pub id: String,
    /// The file's name without its ending, made harmless to show.
    pub name: String,
    /// The path of the folder or file.
    pub path: PathBuf,
}

/// A file or folder beside the submissions that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftAside {
    /// The file's name, made harmless to show.
    pub name: String,
    /// The reason why it was left aside.
    pub why: &'static str,
}

/// Returns all submissions in `folder` in the order of their ids, and what is left aside. `out` is
/// no submission, even if it lies there.
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
            Some("a file of an operating system, not of a student")
        }
        () if kind.is_symlink() => Some("a link: its target may be anywhere"),
        () if kind.is_dir() || (kind.is_file() && looks_handed_in(path)) => None,
        () => Some(
            "neither a folder nor an archive (.zip, .tar.gz, .tgz, .tar) nor a single source or \
                document",
        ),
    })
}

/// Gives each submission its id: its name if that is safe and unique, else the name with a part of
/// a hash of the file name.
fn named(mut paths: Vec<PathBuf>) -> Vec<Submission> {
    paths.sort();
    let mut n_by_slug: BTreeMap<String, usize> = BTreeMap::new();
    for path in &paths {
        *n_by_slug.entry(slug(stem(path)).to_lowercase()).or_default() += 1;
    }
    let submission = |path: PathBuf| {
        let slug = slug(stem(&path));
        let is_its_own =
            slug.as_bytes() == stem(&path) && n_by_slug.get(&slug.to_lowercase()) == Some(&1);
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

/// Returns at most 80 characters of a name, with `_` for every unsafe one.
fn slug(name: &[u8]) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
    let text = String::from_utf8_lossy(name);
    let safe: String = text.chars().take(80).map(|c| if is_safe(c) { c } else { '_' }).collect();
    if safe.starts_with(['.', '-']) || safe.is_empty() { format!("_{safe}") } else { safe }
}
