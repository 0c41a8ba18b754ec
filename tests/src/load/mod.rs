//! Measures what grading costs a machine: processor time per submission, beside the scripts that
//! courses use, and the memory of a large batch.

pub mod batch;
pub mod page;
pub mod script;
pub mod usage;

use std::path::Path;
use std::process::{Command, Stdio};

/// What was measured, for the page.
#[derive(Clone, Debug)]
pub struct Load {
    /// The processor and the number of its cores.
    pub machine: String,
    /// Number of submissions whose processor time was measured.
    pub n_graded: usize,
    /// Number of image cases.
    pub n_cases: usize,
    /// A batch of edited copies of the solution.
    pub graded: batch::Cost,
    /// A fresh clone, a build, all pictures and a comparison for each submission.
    pub fresh: script::Cost,
    /// The same with a target folder that is shared and warm.
    pub warm: script::Cost,
    /// The peak memory of the grader by the size of the class.
    pub memory: Vec<(usize, u64)>,
}

/// Runs a command to its end, with its output thrown away.
///
/// # Errors
/// Fails if it cannot be run, or ends with another code than 0.
fn run(command: &mut Command) -> Result<(), String> {
    let output = command.stdin(Stdio::null()).output();
    let output = output.map_err(|why| format!("{command:?}: {why}"))?;
    match output.status.success() {
        true => Ok(()),
        false => Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}

/// Copies the files of a folder and of all folders in it.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let (path, name) = entry.map(|entry| (entry.path(), entry.file_name()))?;
        match path.is_dir() {
            true => copy(&path, &to.join(name))?,
            false => std::fs::copy(&path, to.join(name)).map(drop)?,
        }
    }
    Ok(())
}

/// Writes the solution with another comment in each of its files, so that it has to be compiled.
///
/// # Errors
/// Fails if a file cannot be read or written.
fn edited_solution(n: usize, to: &Path) -> std::io::Result<()> {
    copy(&crate::workspace().join("tests/solution/src"), &to.join("src"))?;
    for entry in std::fs::read_dir(to.join("src"))? {
        let path = entry?.path();
        let text = std::fs::read_to_string(&path)?;
        std::fs::write(&path, format!("{text}\n// Copy {n}.\n"))?;
    }
    Ok(())
}
