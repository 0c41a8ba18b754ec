//! Parts of a hand-in that are left aside. An unusable file is left out by itself; the rest of the
//! hand-in still counts.

use std::io;

use super::limits::{Excess, PATH_BYTES};
use crate::plain;

/// Largest number of files that are named when they are left aside. The rest are counted.
const MAX_NAMED: usize = 20;

/// A file, folder or entry of an archive that is not taken.
#[derive(Debug)]
pub struct Aside {
    /// The path below the top of the hand-in, with `/` between names. An unsafe path is kept as it
    /// was written.
    pub path: String,
    /// The reason why it is not taken.
    pub why: Why,
}

/// The reason why something is left aside. Its text completes "PATH ...".
#[derive(Debug, thiserror::Error)]
pub enum Why {
    /// A symbolic or hard link.
    #[error("is a link; put the file itself there")]
    Link,
    /// A device, pipe or socket.
    #[error("is neither a file nor a folder")]
    Special,
    /// The path begins at the root of a file system.
    #[error("has an absolute path")]
    Absolute,
    /// The path has `..` in it.
    #[error("leaves the folder (`..`)")]
    Leaves,
    /// A backslash or a colon: another path on another system.
    #[error("has a backslash or a colon in its name")]
    OtherSystem,
    /// NUL, a control character, or one that cannot be seen.
    #[error("has a control character or an invisible one in its name")]
    Control,
    /// The name is not UTF-8.
    #[error("has a name that is not UTF-8")]
    NotUtf8,
    /// A file without a name.
    #[error("has no name")]
    Nameless,
    /// A name of more than 255 bytes, or a path of more than [`PATH_BYTES`].
    #[error("has a name that is too long")]
    TooLong,
    /// The folders are nested too deeply.
    #[error("lies {found} names deep; at most {limit} are read")]
    TooDeep {
        /// Names in the path.
        found: usize,
        /// Names in the longest path that is read.
        limit: usize,
    },
    /// An earlier entry has the same path.
    #[error("comes twice")]
    Twice,
    /// More bytes than a file may have.
    #[error("{0}")]
    TooLarge(Excess),
    /// The entry needs a password.
    #[error("is encrypted; pack it without a password")]
    Encrypted,
    /// The entry is packed by a method that the grader cannot read.
    #[error("is packed by a method that cannot be read (only Deflate can)")]
    Method,
    /// The system does not let the grader read it.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
}

impl Aside {
    /// Returns the part with the path `name`. Only the first [`PATH_BYTES`] bytes of an unsafe path
    /// are kept.
    pub(super) fn new(name: &[u8], why: Why) -> Self {
        let path = match names(name, usize::MAX) {
            Ok(names) => names.join("/"),
            Err(_) => String::from_utf8_lossy(&name[..name.len().min(PATH_BYTES)]).into_owned(),
        };
        Self { path, why }
    }

    /// Returns whether the path lies within the hand-in, so that a file that counts could have it.
    pub fn is_within(&self) -> bool {
        names(self.path.as_bytes(), usize::MAX).is_ok()
    }

    /// Returns whether `path` is this part, or lies below it.
    pub fn covers(&self, path: &str) -> bool {
        path.strip_prefix(&*self.path).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    }
}

impl std::fmt::Display for Aside {
    /// Writes the path, made harmless to show, and the reason.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}: {}", plain::name(self.path.as_bytes()), self.why)
    }
}

/// Returns the first [`MAX_NAMED`] lines in order, and a line with the number of the rest.
pub(super) fn abridged(mut lines: Vec<String>) -> Vec<String> {
    lines.sort();
    if lines.len() > MAX_NAMED {
        let more = lines.len() - MAX_NAMED;
        lines.truncate(MAX_NAMED);
        lines.push(format!("and {more} more files"));
    }
    lines
}

/// Splits the path `name` into its names, without `.` and empty ones.
///
/// The result is empty for the top folder itself.
///
/// # Errors
/// The error says what makes the path unsafe to create.
pub(super) fn names(name: &[u8], depth: usize) -> Result<Vec<&str>, Why> {
    if name.len() > PATH_BYTES {
        return Err(Why::TooLong);
    }
    let name = str::from_utf8(name).map_err(|_| Why::NotUtf8)?;
    if name.chars().any(plain::is_hidden) {
        return Err(Why::Control);
    }
    if name.contains(['\\', ':']) {
        return Err(Why::OtherSystem);
    }
    if name.starts_with('/') {
        return Err(Why::Absolute);
    }
    let names: Vec<&str> =
        name.split('/').filter(|name| !name.is_empty() && *name != ".").collect();
    match () {
        () if names.contains(&"..") => Err(Why::Leaves),
        () if names.iter().any(|name| name.len() > 255) => Err(Why::TooLong),
        () if names.len() > depth => Err(Why::TooDeep { found: names.len(), limit: depth }),
        () => Ok(names),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_below_is_covered() {
        let aside = Aside { path: "src".to_owned(), why: Why::Link };
        for (path, expected) in
            [("src", true), ("src/sphere.rs", true), ("src2", false), ("a/src", false)]
        {
            assert_eq!(aside.covers(path), expected, "{path}");
        }
    }

    #[test]
    fn a_path_is_split_or_refused() {
        let check = |path: &str, expected: Result<&[&str], &str>| match (
            names(path.as_bytes(), 3),
            expected,
        ) {
            (Ok(found), Ok(names)) => assert_eq!(found, names, "{path}"),
            (Err(why), Err(words)) => assert!(why.to_string().contains(words), "{path}: {why}"),
            (found, _) => panic!("{path}: {found:?}"),
        };
        check("./a//b/", Ok(&["a", "b"]));
        check("", Ok(&[]));
        check("a/b/c", Ok(&["a", "b", "c"]));
        check("a/b/c/d", Err("lies 4 names deep; at most 3 are read"));
        check("/a", Err("absolute"));
        check("a/../b", Err("leaves the folder"));
        check("a:b", Err("colon"));
        check("a\\b", Err("backslash"));
        check("Icon\r", Err("control character"));
        check("\u{202e}sr.niam", Err("invisible"));
        check("aux.cpp", Ok(&["aux.cpp"]));
        check(&"é".repeat(128), Err("too long"));
        check(&"a/".repeat(501), Err("too long"));
        assert!(matches!(names(b"caf\xe9", 3), Err(Why::NotUtf8)));
    }
}
