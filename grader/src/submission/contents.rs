//! The content of a hand-in: the submission, with everything that a build of its kind needs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::language::Language;
use super::limits::SOURCE_BYTES;
use super::reading::read_text;
use crate::sandbox::Folder;

/// A submission whose files have been read or listed.
#[derive(Debug)]
pub struct Submission {
    /// The kind, which says how it is to be built.
    pub kind: Kind,
    /// The blake3 hash of the names and contents of the files that count.
    pub digest: String,
    /// Remarks on what was left aside, and on where the submission lies, if not at the top.
    pub ignored: Vec<String>,
    /// Folders into which archives were unpacked. They are removed with the submission.
    pub(super) _unpacked: Vec<Folder>,
}

/// The endings of files that hold sources, among them those of other languages than Rust.
const SOURCES: [&str; 22] = [
    "c", "cc", "cpp", "cs", "cxx", "f90", "go", "h", "hh", "hpp", "hs", "hxx", "java", "jl", "js",
    "kt", "ml", "py", "rs", "scala", "swift", "ts",
];

impl Submission {
    /// Returns the texts of the sources, which are compared with those of other submissions. A file
    /// that is no text, or is too large for a source, is left out.
    pub fn sources(&self) -> Vec<String> {
        match &self.kind {
            Kind::Rust(rust) => rust.sources.values().cloned().collect(),
            Kind::Own(own) => {
                let is_source = |path: &&String| {
                    let ending = Path::new(path).extension().and_then(|ending| ending.to_str());
                    ending.is_some_and(|ending| SOURCES.contains(&ending))
                };
                let text = |path: &String| read_text(&own.folder.join(path), SOURCE_BYTES).ok();
                own.files.iter().filter(is_source).filter_map(text).collect()
            }
        }
    }
}

/// The two kinds of submission.
#[derive(Debug)]
pub enum Kind {
    /// The template, filled in.
    Rust(Rust),
    /// Anything else, with a `submission.toml`.
    Own(Own),
}

/// Sources that are ready to be compiled.
#[derive(Debug)]
pub struct Rust {
    /// Text by path, such as `src/sphere.rs`; `src/main.rs` is among them.
    pub sources: BTreeMap<String, String>,
    /// Sources and manifests of the submission that are not used, each with the reason. They may be
    /// the cause of a compiler error.
    pub unused: Vec<String>,
}

/// A folder with the commands that build and run it.
#[derive(Debug)]
pub struct Own {
    /// The folder of the submission.
    pub folder: PathBuf,
    /// The files below the folder, relative to it. A private copy holds all of them.
    pub files: Vec<String>,
    /// The build command, if there is one; not empty.
    pub build: Option<Vec<String>>,
    /// The run command; not empty.
    pub run: Vec<String>,
    /// The language of the template that the submission is made from, if it states one.
    pub template: Option<Language>,
}
