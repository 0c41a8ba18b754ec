//! Reads a submission in any language, which says in `submission.toml` how it is built and run.
//!
//! ```toml
//! template = "cpp"                          # or "python"; left out if it is made from no template
//! [build]                                   # may be left out
//! command = ["make", "tracer"]              # runs in a private copy of the folder
//! [run]
//! command = ["./tracer"]   # followed by `render SCENE.json OUT`, `probe` and so on
//! ```
//! A word that begins with `./` is a path in the submission: the program starts in another, empty
//! folder. A first word without a `/` is looked up in PATH.

use std::path::Path;

use serde::Deserialize;

use super::aside::{Aside, Why, abridged};
use super::contents::{Kind, Own, Submission};
use super::error::{SubmissionError, refuse};
use super::language::Language;
use super::limits::{LIMITS, MANIFEST_BYTES, size};
use super::listing::Listing;
use super::locate::MANIFEST;
use super::reading::{read_bytes, read_text};
use super::rust;
use crate::plain;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    template: Option<Language>,
    build: Option<Step>,
    run: Step,
}

/// The template, the build command and the run command of a manifest.
type Stated = (Option<Language>, Option<Vec<String>>, Vec<String>);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Step {
    command: Vec<String>,
}

/// Reads the manifest in `folder` of the hand-in at `top`, and all files below.
///
/// # Errors
/// Fails if the manifest cannot be used, a file cannot be read or is too large, or the machine
/// fails.
pub(super) fn read(
    top: &Path,
    folder: &str,
    listing: Listing,
) -> Result<Submission, SubmissionError> {
    let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
    let manifest = format!("{prefix}{MANIFEST}");
    let Listing { files, mut aside } = listing;
    let is_needed = |aside: &Aside| {
        let counts = matches!(aside.why, Why::TooLarge(_) | Why::Twice | Why::Unreadable(_));
        aside.path == manifest || (counts && aside.path.starts_with(&prefix))
    };
    if let Some(at) = aside.iter().position(is_needed) {
        return Err(SubmissionError::of_aside(top, aside.swap_remove(at)));
    }
    let path = top.join(&manifest);
    let text = read_text(&path, MANIFEST_BYTES)
        .map_err(|why| SubmissionError::of_file(&path, MANIFEST, why))?;
    let (template, build, run) = parse(&text).map_err(|why| refuse(MANIFEST, &why))?;
    let within = |path: &String| path.strip_prefix(&prefix).map(str::to_owned);
    let (files, folder) =
        (files.iter().filter_map(within).collect::<Vec<String>>(), top.join(folder));
    let digest = digest(&folder, &files)?;
    let ignored = abridged(aside.iter().map(Aside::to_string).collect());
    Ok(Submission {
        kind: Kind::Own(Own { folder, files, build, run, template }),
        digest,
        ignored,
        _unpacked: vec![],
    })
}

/// Returns the language of the template, if it is stated, the build command, if there is one, and
/// the run command.
///
/// # Errors
/// Returns what is wrong with the manifest.
fn parse(text: &str) -> Result<Stated, String> {
    let manifest: Manifest = toml::from_str(text).map_err(|why| narrow(&why.to_string()))?;
    let words = |step: Step, name: &str| match step.command.first() {
        None => Err(format!("the command of [{name}] is empty")),
        Some(first) if first.is_empty() => {
            Err(format!("the command of [{name}] begins with an empty word"))
        }
        Some(_) if step.command.iter().any(|word| word.contains('\0')) => {
            Err(format!("a word of the command of [{name}] has a NUL in it"))
        }
        Some(_) => Ok(step.command),
    };
    let build = manifest.build.map(|step| words(step, "build")).transpose()?;
    Ok((manifest.template, build, words(manifest.run, "run")?))
}

/// Returns a message that quotes the manifest, guarded and with its lines cut.
fn narrow(message: &str) -> String {
    let lines: Vec<String> = message.lines().map(|line| line.chars().take(120).collect()).collect();
    plain::shown(&lines.join("\n"))
}

fn digest(folder: &Path, files: &[String]) -> Result<String, SubmissionError> {
    let mut room = LIMITS.all_bytes;
    let mut all = vec![];
    for file in files {
        let path = folder.join(file);
        let bytes = read_bytes(&path, LIMITS.file_bytes)
            .map_err(|why| SubmissionError::of_file(&path, file, why))?;
        room = room.checked_sub(bytes.len() as u64).ok_or_else(|| {
            let most = size(LIMITS.all_bytes);
            SubmissionError::Refused(format!(
                "its files have more than {most}; at most {most} are read"
            ))
        })?;
        all.push((file, bytes));
    }
    Ok(rust::digest(all.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()))))
}
