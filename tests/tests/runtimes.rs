//! Honest programs of several languages, each with several threads or processes, earn all points
//! under all layers of protection, while the same user runs a hundred other processes.
//!
//! They are the folders of `tests/runtimes`, for the exam of flat colours, `tests/exam`. A language
//! that this machine lacks cannot be tested; `REQUIRE_RUNTIMES=1` makes this a failure.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};

use grader::grade::{Bench, Options, Silent, grade};
use grader::sandbox::{Layers, available};
use pages::say;
use tests::workspace;

/// Processes that wait until the test is over.
struct Others(Vec<Child>);

impl Others {
    fn new(n: usize) -> Self {
        let sleep = |_| Command::new("sleep").arg("600").spawn().expect("a process");
        Self((0..n).map(sleep).collect())
    }
}

impl Drop for Others {
    fn drop(&mut self) {
        for child in &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn runtimes() -> Vec<PathBuf> {
    let entries = fs::read_dir(workspace().join("tests/runtimes")).expect("the folder of runtimes");
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    folders.sort();
    folders
}

/// Returns the first program of the submission that is not in PATH, or `None` if all are.
fn missing(folder: &Path) -> Option<String> {
    let text = fs::read_to_string(folder.join("submission.toml")).expect("submission.toml");
    let manifest: toml::Table = text.parse().expect("TOML");
    let first = |step: &str| manifest.get(step)?.get("command")?.get(0)?.as_str();
    let search = std::env::var_os("PATH").unwrap_or_default();
    let is_there = |name: &str| std::env::split_paths(&search).any(|path| path.join(name).exists());
    let programs = ["build", "run"].into_iter().filter_map(first);
    programs.filter(|name| !name.contains('/') && !is_there(name)).map(str::to_owned).next()
}

/// Returns what is wrong with the grade of a submission, if anything is.
fn fault(bench: &Bench, folder: &Path) -> Option<String> {
    let record = match grade(bench, &Options::new(folder), &Silent) {
        Ok(graded) => graded.record,
        Err(why) => return Some(say::chain(&why)),
    };
    let findings = record.stages.iter().flat_map(|stage| &stage.checks);
    let findings: Vec<String> = findings
        .filter_map(|check| check.finding.as_ref())
        .chain(&record.build.finding)
        .map(|finding| format!("{}\n{:?}", finding.message, finding.stderr))
        .collect();
    let is_right = record.score.earned == record.score.possible && record.score.earned > 0;
    let name = folder.display();
    (!is_right || !findings.is_empty()).then(|| format!("{name}: {}", findings.join("\n")))
}

#[test]
fn honest_programs_of_every_language_earn_all_points_under_all_layers() {
    let mut bench = Bench::open(&workspace().join("tests/exam"))
        .unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    bench.workshop.layers = available().layers;
    if std::env::var_os("REQUIRE_LAYERS").is_some() {
        assert_eq!(bench.workshop.layers, Layers::ALL);
    }
    let _others = Others::new(100);
    let is_required = std::env::var_os("REQUIRE_RUNTIMES").is_some();
    let mut faults = vec![];
    for folder in runtimes() {
        match missing(&folder) {
            Some(program) if is_required => faults.push(format!("there is no {program}")),
            Some(_) => {}
            None => faults.extend(fault(&bench, &folder)),
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
