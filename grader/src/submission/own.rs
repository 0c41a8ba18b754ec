//! A submission in any language, which says in `submission.toml` how it is built and run.
//!
//! ```toml
//! [build]                                   # may be left out
//! command = ["make", "tracer"]              # runs in a private copy of the folder
//! [run]
//! command = ["./tracer"]                    # `render SCENE.json OUT`, `probe` and so on come behind it
//! ```
//! A word that begins with `./` is a path in the submission: the program starts in another, empty folder. A first word
//! without a `/` is looked up in PATH.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::listing::{self, shown};
use super::{Kind, Submission, SubmissionError, refuse, rust};

/// The file that makes a folder a submission of this kind.
pub(super) const MANIFEST: &str = "submission.toml";
/// Bytes of one file, and of all.
const MAX_FILE: u64 = 16 << 20;
const MAX_ALL: u64 = 64 << 20;

/// How to build and run it.
#[derive(Debug)]
pub struct Own {
    /// Where it lies.
    pub folder: PathBuf,
    /// Its files, relative to the folder: what a private copy holds.
    pub files: Vec<PathBuf>,
    /// The build command, if there is one; not empty.
    pub build: Option<Vec<String>>,
    /// The run command; not empty.
    pub run: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    build: Option<Step>,
    run: Step,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Step {
    command: Vec<String>,
}

/// Reads the manifest and lists the files.
pub(super) fn read(folder: &Path) -> Result<Submission, SubmissionError> {
    let text = listing::read_text(&folder.join(MANIFEST), 1 << 16).map_err(|why| refuse(MANIFEST, &why))?;
    let manifest: Manifest = toml::from_str(&text).map_err(|why| refuse(MANIFEST, &narrow(&why.to_string())))?;
    let words = |step: Step, name: &str| match step.command.is_empty() {
        true => Err(refuse(MANIFEST, &format!("the command of [{name}] is empty"))),
        false => Ok(step.command),
    };
    let build = manifest.build.map(|step| words(step, "build")).transpose()?;
    let run = words(manifest.run, "run")?;
    let listing = listing::list(folder).ok_or_else(|| {
        SubmissionError::Refused("it holds more than 2000 files: leave out what can be made".to_owned())
    })?;
    let digest = digest(folder, &listing.files)?;
    let kind = Kind::Own(Own { folder: folder.to_owned(), files: listing.files, build, run });
    Ok(Submission { kind, digest, ignored: listing.ignored, _unpacked: None })
}

/// A message that quotes the manifest, its lines cut.
fn narrow(message: &str) -> String {
    let lines: Vec<String> = message.lines().map(|line| line.chars().take(120).collect()).collect();
    lines.join("\n")
}

fn digest(folder: &Path, files: &[PathBuf]) -> Result<String, SubmissionError> {
    let mut room = MAX_ALL;
    let mut all = vec![];
    for file in files {
        let limit = room.min(MAX_FILE);
        let bytes = listing::read_bytes(&folder.join(file), limit).map_err(|why| refuse(&shown(file), &why))?;
        room -= bytes.len() as u64;
        all.push((shown(file), bytes));
    }
    Ok(rust::digest(all.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()))))
}
