//! Tests of programs that misbehave, `tests/submissions/NAME`, each with its expected record in
//! `record.json`.
//!
//! The exam is `tests/exam`. It has flat colours, so that any program can be correct and one
//! deviation at a time can be seen. A folder with a `main.py` gets a copy of `honest.py`, the
//! correct program in parts. A folder with a `src` gets the files of the solution that it lacks.
//! `BLESS=1 cargo test -p tests --test submissions` writes the records; review the changes before
//! committing them.

use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use grader::exercise::Allowance;
use grader::grade::{Bench, Options, Silent, grade};
use grader::record::{Record, Verdict};
use pages::say;
use tempfile::TempDir;
use tests::workspace;

const RECORD: &str = "record.json";

fn submissions() -> Vec<PathBuf> {
    let entries =
        fs::read_dir(workspace().join("tests/submissions")).expect("the folder of submissions");
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    folders.retain(|path| path.is_dir() && !path.ends_with("__pycache__"));
    folders.sort();
    folders
}

/// Returns a copy as a student would hand it in, without the record.
fn copy(folder: &Path) -> TempDir {
    let copy = tempfile::tempdir().expect("a temporary folder");
    copy_into(folder, copy.path());
    if folder.join("main.py").exists() {
        fs::copy(workspace().join("tests/submissions/honest.py"), copy.path().join("honest.py"))
            .expect("honest.py");
    }
    if folder.join("src").exists() {
        for path in tests::files("tests/solution/src", "rs") {
            let target = copy.path().join("src").join(path.file_name().expect("a name"));
            if !target.exists() {
                fs::copy(&path, target).expect("a file of the solution");
            }
        }
    }
    if folder.ends_with("rust_non_utf8_names") {
        let name = std::ffi::OsStr::from_bytes(b"caf\xe9.rs");
        fs::write(copy.path().join("src").join(name), "")
            .expect("a file system that takes any bytes");
    }
    copy
}

fn copy_into(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).expect("a folder") {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            fs::create_dir(&target).expect("a folder");
            copy_into(&path, &target);
        } else if !path.ends_with(RECORD) {
            fs::copy(&path, &target).expect("a file");
        }
    }
}

/// Returns the record without the fields that differ between runs and machines.
fn settled(mut record: Record) -> Record {
    record.epoch.clear();
    record.grader.clear();
    record.submission.digest.clear();
    record.sandbox.clear();
    record.build.time_s = 0.0;
    let checks = record.stages.iter_mut().flat_map(|stage| &mut stage.checks);
    for check in checks {
        check.time_s = 0.0;
        check.cpu_s = None;
        check.peak_bytes = 0;
        if let Some(finding) = &mut check.finding {
            finding.stderr = None;
        }
    }
    record
}

/// Checks a submission. Returns the difference between the record and the stored one as an error.
fn check(bench: &Bench, folder: &Path) -> Result<(), String> {
    let name = folder.file_name().expect("a name").to_string_lossy().into_owned();
    let copy = copy(folder);
    let options = Options { name: name.clone(), jobs: 1, ..Options::new(copy.path()) };
    let graded =
        grade(bench, &options, &Silent).map_err(|why| format!("{name}: {}", say::chain(&why)))?;
    let found = serde_json::to_string_pretty(&settled(graded.record)).expect("a record") + "\n";
    let stored = folder.join(RECORD);
    if std::env::var_os("BLESS").is_some() {
        fs::write(&stored, &found).map_err(|why| why.to_string())?;
    }
    let expected =
        fs::read_to_string(&stored).map_err(|why| format!("{name} has no {RECORD}: {why}"))?;
    if expected == found {
        return Ok(());
    }
    let diff = similar::TextDiff::from_lines(&expected, &found);
    Err(format!("{name}:\n{}", diff.unified_diff().context_radius(2).header("stored", "found")))
}

#[test]
fn every_submission_gets_the_record_it_deserves() {
    let allowance = Allowance::new(Duration::from_secs(2), 256 << 20);
    let bench = Bench::open(&workspace().join("tests/exam"))
        .unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    let bench = Bench { allowance, ..bench };
    let folders = submissions();
    let next = AtomicUsize::new(0);
    // Most of the slow ones sleep until their time is up, so more threads than cores do not slow
    // the others down.
    let faults: Vec<String> = std::thread::scope(|scope| {
        let worker = || {
            let mine = std::iter::from_fn(|| folders.get(next.fetch_add(1, Ordering::Relaxed)));
            mine.filter_map(|folder| check(&bench, folder).err()).collect::<Vec<String>>()
        };
        let workers: Vec<_> = (0..4).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a worker")).collect()
    });
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Returns whether the submission builds, but ends before it does anything.
fn is_never_run(folder: &Path) -> bool {
    ["panics_at_start", "no_interpreter", "no_such_command"]
        .iter()
        .any(|name| folder.ends_with(name))
}

#[test]
fn a_misbehaving_case_costs_only_itself() {
    for folder in submissions() {
        let text = fs::read_to_string(folder.join(RECORD)).expect("a record");
        let record: Record = serde_json::from_str(&text).expect("a record");
        let checks = || record.stages.iter().flat_map(|stage| &stage.checks);
        assert!(
            checks().all(|check| check.verdict != Verdict::Ours),
            "{}: our fault",
            folder.display()
        );
        assert_eq!(checks().count(), 7, "{}: a check is missing from the record", folder.display());
        let is_lost = record.build.verdict == Verdict::Fail || is_never_run(&folder);
        let all_wrong = folder.ends_with("grey_png");
        assert_eq!(record.score.earned == 0, is_lost, "{}: {:?}", folder.display(), record.score);
        let n_passed = checks().filter(|check| check.verdict == Verdict::Pass).count();
        assert!(
            is_lost || all_wrong || n_passed >= 3,
            "{}: only {n_passed} checks pass",
            folder.display()
        );
        let unexplained = checks()
            .filter(|check| check.verdict != Verdict::Pass && check.finding.is_none())
            .count();
        assert_eq!(unexplained, 0, "{}: a check fails without a reason", folder.display());
    }
}
