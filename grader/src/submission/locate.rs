//! Finds the submission in a hand-in: people nest folders, platforms flatten them, systems add
//! junk.

use std::collections::BTreeMap;

use super::aside::Why;
use super::limits::NESTED;
use super::listing::Listing;
use super::nature::{self, Nature};
use super::template::Template;
use crate::plain;

/// The file that makes a folder a submission that says how it is built and run.
pub(super) const MANIFEST: &str = "submission.toml";

/// The layout of a submission in its folder. If several apply to one folder, the first counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Layout {
    /// There is a `submission.toml`.
    Own,
    /// The sources of the template lie in `src`.
    Template,
    /// The sources of the template lie in the folder itself.
    Flat,
}

/// The result of a successful search.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Located {
    /// A submission in the folder of that path, which is empty for the top.
    Submission(String, Layout),
    /// No submission, but one archive, which may hold one.
    Archive(String),
}

/// Finds the only submission among the files. Everything below a submission belongs to it.
///
/// # Errors
/// Returns a message for the student if there is none, or if there are several.
pub(super) fn locate(listing: &Listing, template: &Template) -> Result<Located, String> {
    let mut found: BTreeMap<String, Layout> = BTreeMap::new();
    let mut too_deep = None;
    let files = listing.files.iter().map(|path| (path.as_str(), false));
    let aside = listing.aside.iter().filter(|aside| aside.is_within());
    let aside = aside.map(|aside| (aside.path.as_str(), matches!(aside.why, Why::Link)));
    for (path, is_link) in files.chain(aside) {
        match sign(path, is_link, template) {
            None => {}
            Some((folder, _)) if depth(folder) > NESTED => too_deep = too_deep.or(Some(folder)),
            Some((folder, layout)) => {
                let known = found.entry(folder.to_owned()).or_insert(layout);
                *known = layout.min(*known);
            }
        }
    }
    let owners: Vec<String> = found
        .iter()
        .filter(|(_, layout)| **layout != Layout::Flat)
        .map(|(folder, _)| folder.clone())
        .collect();
    found
        .retain(|folder, _| !owners.iter().any(|owner| owner != folder && is_below(folder, owner)));
    match (found.pop_first(), found.is_empty()) {
        (Some((folder, layout)), true) => Ok(Located::Submission(folder, layout)),
        (Some((first, _)), false) => Err(several(std::iter::once(&first).chain(found.keys()))),
        (None, _) => archive(listing).unwrap_or_else(|| match too_deep {
            Some(folder) => Err(format!(
                "the submission lies in `{}`, more than {NESTED} folders deep: hand in that folder",
                plain::name(folder.as_bytes())
            )),
            None => Err(nothing(listing, template)),
        }),
    }
}

/// Returns the folder that `path` marks as a submission, and its layout; `None` if it marks none.
fn sign<'a>(path: &'a str, is_link: bool, template: &Template) -> Option<(&'a str, Layout)> {
    let (folder, name) = split(path);
    let (above, last) = split(folder);
    let is_students = |name: &str| template.student.contains_key(&format!("src/{name}"));
    match name {
        MANIFEST => Some((folder, Layout::Own)),
        "src" if is_link => Some((folder, Layout::Template)),
        name if !is_students(name) => None,
        _ if last == "src" => Some((above, Layout::Template)),
        _ => Some((folder, Layout::Flat)),
    }
}

/// Splits a path into its folder, empty for the top, and its last name.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('/').unwrap_or(("", path))
}

fn depth(folder: &str) -> usize {
    if folder.is_empty() { 0 } else { folder.matches('/').count() + 1 }
}

fn is_below(path: &str, folder: &str) -> bool {
    folder.is_empty() || path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'))
}

/// Returns the only archive, the error for several, or `None` if there is none.
fn archive(listing: &Listing) -> Option<Result<Located, String>> {
    let is_archive = |path: &&String| {
        depth(split(path).0) <= NESTED
            && matches!(nature::by_name(path.as_bytes()), Some(Nature::Archive(_)))
    };
    let mut archives = listing.files.iter().filter(is_archive);
    let first = archives.next()?;
    Some(match archives.next() {
        None => Ok(Located::Archive(first.clone())),
        Some(second) => Err(several([first, second].into_iter().chain(archives))),
    })
}

fn several<'a>(found: impl Iterator<Item = &'a String>) -> String {
    format!("several parts of it look like submissions: {}; hand in one of them", few(found))
}

/// Lists the first of `paths` and the number of the rest.
fn few<'a>(paths: impl Iterator<Item = &'a String>) -> String {
    let mut shown: Vec<String> = paths
        .map(|path| match path.as_str() {
            "" => "the top folder".to_owned(),
            path => format!("`{}`", plain::name(path.as_bytes())),
        })
        .collect();
    if shown.len() > 5 {
        let more = shown.len() - 4;
        shown.truncate(4);
        shown.push(format!("and {more} more"));
    }
    shown.join(", ")
}

/// Returns a message that says what was expected, what is there, and what was left aside.
fn nothing(listing: &Listing, template: &Template) -> String {
    let sources: Vec<&String> = listing.files.iter().filter(|path| path.ends_with(".rs")).collect();
    let mut text = match (sources.is_empty(), listing.files.is_empty()) {
        (false, _) => {
            let expected: Vec<&str> = template.student.keys().map(|name| split(name).1).collect();
            let found = few(sources.into_iter());
            let expected = expected.join(", ");
            format!(
                "none of its .rs files is one that you write: it holds {found}; \
                 expected in a folder `src` are {expected}"
            )
        }
        (true, false) => format!(
            "there is neither a folder `src` with files of the template nor a `{}` in it, nor in \
             folders up to {NESTED} deep; it holds {}: hand in the folder of the template, with \
             its `src`",
            MANIFEST,
            few(listing.files.iter()),
        ),
        (true, true) => {
            let what = if listing.aside.is_empty() {
                "there is no file in it"
            } else {
                "no file in it can be taken"
            };
            format!("{what}: hand in the folder of the template, with its `src`")
        }
    };
    for aside in listing.aside.iter().take(5) {
        text += &format!("\nleft aside: {aside}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission::aside::Aside;

    fn template() -> Template {
        let student =
            ["src/sphere.rs", "src/plane.rs"].map(|name| (name.to_owned(), String::new()));
        Template { pristine: BTreeMap::new(), student: student.into(), dependencies: vec![] }
    }

    /// Checks the search among files. A name that ends in `@` is a link.
    fn check(paths: &[&str], expected: Result<(&str, Layout), &str>) {
        let mut listing = Listing::default();
        for path in paths {
            match path.strip_suffix('@') {
                Some(link) => listing.aside.push(Aside::new(link.as_bytes(), Why::Link)),
                None => listing.files.push((*path).to_owned()),
            }
        }
        match (locate(&listing, &template()), expected) {
            (Ok(Located::Submission(folder, layout)), Ok(expected)) => {
                assert_eq!((folder.as_str(), layout), expected, "{paths:?}");
            }
            (Err(why), Err(words)) => {
                assert!(why.contains(words), "{paths:?}: {why}\nshould speak of: {words}")
            }
            (found, _) => panic!("{paths:?}: {found:?}"),
        }
    }

    #[test]
    fn a_submission_is_found_where_people_put_it() {
        check(&["src/sphere.rs", "src/main.rs", "README.md"], Ok(("", Layout::Template)));
        check(
            &["a/b/c/src/plane.rs", "report.pdf", "a/notes.txt"],
            Ok(("a/b/c", Layout::Template)),
        );
        check(&["sphere.rs", "main.rs", "report.pdf"], Ok(("", Layout::Flat)));
        check(&["hw/sphere.rs", "report.pdf"], Ok(("hw", Layout::Flat)));
        check(&["a/submission.toml", "a/main.py"], Ok(("a", Layout::Own)));
        check(&["submission.toml", "src/sphere.rs", "sphere.rs"], Ok(("", Layout::Own)));
        check(
            &["src/sphere.rs", "sphere.rs", "old/src/sphere.rs", "old/plane.rs"],
            Ok(("", Layout::Template)),
        );
        check(&["hw/src/sphere.rs@"], Ok(("hw", Layout::Template)));
        check(&["src@", "README.md"], Ok(("", Layout::Template)));
        check(
            &["hw/src/sphere.rs", "/etc/sphere.rs@", "../a/src/plane.rs@"],
            Ok(("hw", Layout::Template)),
        );
    }

    #[test]
    fn several_are_named() {
        check(&["a/src/sphere.rs", "b/c/src/plane.rs"], Err("`a`, `b/c`; hand in one"));
        check(&["sphere.rs", "old/sphere.rs"], Err("the top folder, `old`"));
        check(&["a/submission.toml", "b/sphere.rs"], Err("`a`, `b`"));
        let many: Vec<String> = (0..9).map(|n| format!("{n}/src/sphere.rs")).collect();
        let many: Vec<&str> = many.iter().map(String::as_str).collect();
        check(&many, Err("`0`, `1`, `2`, `3`, and 5 more"));
        check(&["a.zip", "b.tar.gz"], Err("`a.zip`, `b.tar.gz`"));
    }

    #[test]
    fn none_is_said_to_be_none() {
        check(
            &["src/ball.rs", "src/main.rs"],
            Err("it holds `src/ball.rs`, `src/main.rs`; expected in a folder"),
        );
        check(&["ball.rs"], Err("`src` are plane.rs, sphere.rs"));
        check(&["notes.txt"], Err("it holds `notes.txt`: hand in"));
        check(&["a/b/c/d/src/sphere.rs"], Err("lies in `a/b/c/d`, more than 3 folders deep"));
        check(&[], Err("there is no file in it"));
        check(&["odd@"], Err("left aside: odd: is a link"));
    }

    #[test]
    fn the_only_archive_may_hold_one() {
        let listing =
            Listing { files: vec!["a/hw.zip".to_owned(), "a/x.pdf".to_owned()], aside: vec![] };
        assert_eq!(locate(&listing, &template()), Ok(Located::Archive("a/hw.zip".to_owned())));
    }
}
