//! The digest of the code and the cases that stored figures were measured on.

use std::io;
use std::path::{Path, PathBuf};

/// Returns the digest of the code and cases that figures of the reference depend on, in the
/// workspace `root`: 16 hexadecimal digits. The compiler and the profile are not part of it.
///
/// It covers the names and contents of the sources of `reference` and `cases`, the versions of all
/// dependencies, the course, the cases and their assets. Stored answers and figures are excluded.
/// Hidden files are, too. `None` if the folder has no sources of the reference, such as a set of
/// cases beside an installed program.
///
/// # Errors
/// A folder or file that cannot be read.
pub fn sources_digest(root: &Path) -> io::Result<Option<String>> {
    if !root.join("reference/src").is_dir() {
        return Ok(None);
    }
    let mut files = Vec::new();
    for part in ["Cargo.lock", "reference/src", "cases/src", "cases/course.toml", "cases/assets"] {
        collect(&root.join(part), &|_| true, &mut files)?;
    }
    let is_toml = |path: &Path| path.extension().is_some_and(|extension| extension == "toml");
    collect(&root.join("cases/stages"), &is_toml, &mut files)?;
    let name = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string();
    let mut named: Vec<(String, PathBuf)> =
        files.into_iter().map(|path| (name(&path), path)).collect();
    named.sort();
    let mut hasher = blake3::Hasher::new();
    for (name, path) in named {
        let content = std::fs::read(path)?;
        for part in [name.as_bytes(), &content] {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
    }
    Ok(Some(hasher.finalize().to_hex()[..16].to_owned()))
}

/// Returns the digest in a page with measured figures, which follows the words "Code and cases:".
/// `None` if there is none.
pub fn digest_in(page: &str) -> Option<&str> {
    let (_, rest) = page.split_once("Code and cases: `")?;
    rest.split_once('`').map(|(digest, _)| digest)
}

/// Adds the files at and below `path` that `is_wanted` accepts. A missing path has none.
fn collect(
    path: &Path,
    is_wanted: &impl Fn(&Path) -> bool,
    files: &mut Vec<PathBuf>,
) -> io::Result<()> {
    let is_hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    if path.is_dir() && !is_hidden {
        for entry in std::fs::read_dir(path)? {
            collect(&entry?.path(), is_wanted, files)?;
        }
    } else if path.is_file() && !is_hidden && is_wanted(path) {
        files.push(path.to_owned());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_changes_with_code_and_cases_and_with_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let write = |path: &str, text: &str| {
            let path = root.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        let digest = || sources_digest(root.path()).unwrap();
        write("cases/stages/01_one/ball.toml", "a");
        assert_eq!(digest(), None, "no sources");
        write("reference/src/lib.rs", "a");
        let mut last = digest().unwrap();
        assert!(last.len() == 16 && last.bytes().all(|byte| byte.is_ascii_hexdigit()), "{last}");
        for (path, text) in [
            ("reference/src/lib.rs", "b"),
            ("reference/src/cost/mod.rs", ""),
            ("cases/src/lib.rs", "a"),
            ("Cargo.lock", "a"),
            ("cases/course.toml", "a"),
            ("cases/assets/ball.obj", "a"),
            ("cases/stages/01_one/ball.toml", "b"),
        ] {
            write(path, text);
            let next = digest().unwrap();
            assert_ne!(next, last, "{path}");
            last = next;
        }
        for path in [
            "cases/stages/fronts.json",
            "cases/stages/01_one/a.png",
            "docs/a.md",
            "reference/src/.a",
        ] {
            write(path, "a");
            assert_eq!(digest().as_ref(), Some(&last), "{path}");
        }
    }
}
