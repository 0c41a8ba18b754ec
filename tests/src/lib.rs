//! The shared parts of the tests across crates: the paths of the workspace, its source files, and
//! the grading of variants of the solution.

pub mod bars;
pub mod diagnosis;
pub mod dice;
pub mod fuzz;
pub mod instructions;
pub mod lab;
pub mod load;
pub mod page;
pub mod peers;
pub mod performance;
pub mod rules;
pub mod variants;

use std::path::{Path, PathBuf};
use std::process::Command;

use grader::grade::{Bench, Graded, Options, Silent, grade};
use pages::say;

/// Returns the root of the workspace.
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate lies in the workspace")
}

/// Returns all files below `folder` of the workspace with names that end in `.ending`, ordered,
/// without build output.
///
/// # Panics
/// Panics if a folder cannot be listed.
pub fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    collect(&workspace().join(folder), ending, &mut found);
    found.sort();
    found
}

fn collect(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    let entries =
        std::fs::read_dir(folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    for entry in entries {
        let path = entry.expect("a folder entry").path();
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.is_dir() && !path.ends_with("target") && !hidden {
            collect(&path, ending, found);
        } else if path.extension().is_some_and(|extension| extension == ending) {
            found.push(path);
        }
    }
}

/// Returns the paths of the files that git tracks, relative to the workspace.
///
/// # Panics
/// Panics if git cannot list them.
pub fn tracked() -> Vec<String> {
    let listed = Command::new("git")
        .args(["ls-files", "-z"])
        .current_dir(workspace())
        .output()
        .expect("git");
    assert!(listed.status.success(), "git cannot list the files");
    String::from_utf8_lossy(&listed.stdout)
        .split('\0')
        .filter(|path| !path.is_empty())
        .map(str::to_owned)
        .collect()
}

/// Returns `path` relative to the workspace, with forward slashes.
pub fn name(path: &Path) -> String {
    path.strip_prefix(workspace()).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

/// Returns the lines of a Rust source file that are code, without comments and tests.
///
/// A test module in the file ends the code. Other lines after `#[cfg(test)]` are left out.
///
/// # Panics
/// Panics if the file cannot be read.
pub fn code_lines(path: &Path) -> Vec<(usize, String)> {
    let text =
        std::fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let lines: Vec<&str> = text.lines().collect();
    let is_test = |at: usize| lines.get(at).is_some_and(|line| line.trim() == "#[cfg(test)]");
    let is_module = |at: usize| {
        lines.get(at).is_some_and(|line| line.starts_with("mod ") && line.trim().ends_with('{'))
    };
    let n_lines =
        (0..lines.len()).find(|at| is_test(*at) && is_module(at + 1)).unwrap_or(lines.len());
    lines[..n_lines]
        .iter()
        .enumerate()
        .filter(|(at, _)| !(is_test(*at) || *at > 0 && is_test(at - 1)))
        .map(|(i, line)| (i + 1, line.split("//").next().unwrap_or_default().to_owned()))
        .filter(|(_, line)| !line.trim().is_empty())
        .collect()
}

/// Grades the submission in `folder` on the whole public exam.
///
/// # Panics
/// Panics if the grader itself fails.
pub fn grade_all(folder: &Path) -> Graded {
    let bench = Bench::open(&public_stages()).unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    grade(&bench, &Options::new(folder), &Silent)
        .unwrap_or_else(|why| panic!("{}", say::chain(&why)))
}

/// Returns the folder of the public stages.
pub fn public_stages() -> PathBuf {
    workspace().join("cases/stages")
}
