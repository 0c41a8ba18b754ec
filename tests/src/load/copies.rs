//! Copies of submissions, and the commands that are run on them.

use std::path::Path;
use std::process::{Command, Stdio};

/// Runs a command to its end, with its output thrown away.
///
/// # Errors
/// Fails if it cannot be run, or ends with another code than 0.
pub(super) fn run(command: &mut Command) -> Result<(), String> {
    let output = command.stdin(Stdio::null()).output();
    let output = output.map_err(|why| format!("{command:?}: {why}"))?;
    match output.status.success() {
        true => Ok(()),
        false => Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}

/// Copies the files of a folder and of all folders in it.
pub(super) fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
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
pub(super) fn edited_solution(n: usize, to: &Path) -> std::io::Result<()> {
    copy(&crate::workspace().join("tests/solution/src"), &to.join("src"))?;
    for entry in std::fs::read_dir(to.join("src"))? {
        let path = entry?.path();
        let text = std::fs::read_to_string(&path)?;
        std::fs::write(&path, format!("{text}\n// Copy {n}.\n"))?;
    }
    Ok(())
}
