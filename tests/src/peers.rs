//! Runs other judges of pictures through the real tools: `tests/peers`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cases::answer::expected_png_path;
use serde::{Deserialize, Serialize};

use crate::lab::Trial;
use crate::{public_stages, workspace};

/// A tool, and its verdicts on the variants.
#[derive(Clone, Debug, Deserialize)]
pub struct Tool {
    /// The name with the version.
    pub name: String,
    /// The condition under which a picture passes.
    pub says: String,
    /// The first case that fails, by the name of the variant.
    pub fails: BTreeMap<String, String>,
}

/// The pictures of a variant that differ in some byte from the expected ones, in the order of the
/// cases.
#[derive(Serialize)]
struct Sequence<'a> {
    name: &'a str,
    pairs: Vec<Pair<'a>>,
}

#[derive(Serialize)]
struct Pair<'a> {
    case: &'a str,
    expected: PathBuf,
    /// The picture of the variant; `None` if the program gave none.
    actual: Option<&'a Path>,
}

/// Installs the tools in `folder`, and lets them judge the pictures of `trials`.
///
/// # Errors
/// Returns an error if a tool cannot be installed or fails.
pub fn run_tools(folder: &Path, trials: &[Trial]) -> Result<Vec<Tool>, String> {
    fs::create_dir_all(folder).map_err(|why| format!("{}: {why}", folder.display()))?;
    let ours = workspace().join("tests/peers");
    run(Command::new("bash").arg(ours.join("install.sh")).arg(folder))?;
    let sequences: Vec<Sequence> = trials.iter().map(sequence).collect();
    let (input, output) = (folder.join("sequences.json"), folder.join("verdicts.json"));
    let text = serde_json::to_vec(&sequences).map_err(|why| why.to_string())?;
    fs::write(&input, text).map_err(|why| format!("{}: {why}", input.display()))?;
    run(Command::new(folder.join("venv/bin/python"))
        .arg(ours.join("judge.py"))
        .args([folder, &input, &output]))?;
    let text = fs::read(&output).map_err(|why| format!("{}: {why}", output.display()))?;
    serde_json::from_slice(&text).map_err(|why| format!("{}: {why}", output.display()))
}

fn sequence(trial: &Trial) -> Sequence<'_> {
    let stages = public_stages();
    let differ = trial.shown.iter().filter(|shown| shown.file.is_some() || !shown.is_there);
    let pair = |shown: &'_ crate::lab::Shown| expected_png_path(&stages, &shown.case);
    let pairs = differ
        .map(|shown| Pair {
            case: &shown.case,
            expected: pair(shown),
            actual: shown.file.as_deref(),
        })
        .collect();
    Sequence { name: &trial.variant.name, pairs }
}

fn run(command: &mut Command) -> Result<(), String> {
    let shown = format!("{command:?}");
    let status = command.status().map_err(|why| format!("{shown}: {why}"))?;
    if status.success() { Ok(()) } else { Err(format!("{shown} ends with {status}")) }
}
