//! Tests of changes to files that are not the student's own. The verdict is the same in place, as a
//! copy and in an archive.
//!
//! "In place" means within the student's own workspace, in which the template was edited. The
//! grader that runs there must not take anything from that template. The exam is `tests/exam`,
//! where the untouched `light.rs` costs four of ten points.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use grader::batch::{self, OnBench, Shown};
use grader::grade::{Bench, Options, Silent, grade};
use grader::record::{Record, Verdict};
use grader::submission::limits::{LIMITS, NESTED, size};
use pages::say;
use tempfile::TempDir;
use tests::workspace;

/// A student's change: files with their new text, or `None` for a deleted file.
type Edits<'a> = &'a [(&'a str, Option<String>)];

/// The official grader, outside of any student's workspace, with its crates compiled.
static FINAL: LazyLock<Bench> = LazyLock::new(|| {
    let bench = open(workspace().join("tests/exam"));
    bench.workshop.sdk(&|_| ()).unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    bench
});

fn open(exam: PathBuf) -> Bench {
    Bench::open(&exam).unwrap_or_else(|why| panic!("{}", say::chain(&why)))
}

/// Returns the text of a file of the workspace.
fn text(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

/// Returns the text of a file of the template with one part of it replaced.
fn replaced(path: &str, from: &str, to: &str) -> Option<String> {
    let text = text(&format!("student_template/{path}"));
    assert_eq!(text.matches(from).count(), 1, "{path}: {from}");
    Some(text.replace(from, to))
}

/// Returns a student's workspace. All files of the template except `light.rs` are filled in, and
/// then the edits are made.
fn students(edits: Edits) -> TempDir {
    let root = TempDir::new().unwrap();
    for name in ["Cargo.toml", "Cargo.lock", "cases/Cargo.toml"] {
        copy(&workspace().join(name), &root.path().join(name));
    }
    for (from, to) in [
        ("cases/src", "cases/src"),
        ("tests/exam", "exam"),
        ("student_template", "student_template"),
    ] {
        copy_folder(&workspace().join(from), &root.path().join(to));
    }
    copy_folder(&workspace().join("tests/solution/src"), &root.path().join("student_template/src"));
    copy(
        &workspace().join("student_template/src/light.rs"),
        &root.path().join("student_template/src/light.rs"),
    );
    // The store of compiled files is shared, because compiling takes minutes. Its names are hashes
    // of the inputs.
    fs::create_dir(root.path().join("target")).unwrap();
    std::os::unix::fs::symlink(FINAL.workshop.store(), root.path().join("target/grader")).unwrap();
    for (name, text) in edits {
        let path = root.path().join("student_template").join(name);
        match text {
            Some(text) => fs::write(path, text).unwrap(),
            None => fs::remove_file(path).unwrap(),
        }
    }
    root
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to.parent().unwrap()).unwrap();
    fs::copy(from, to).unwrap();
}

fn copy_folder(from: &Path, to: &Path) {
    for file in grader::files::below(from).unwrap() {
        copy(&file, &to.join(file.strip_prefix(from).unwrap()));
    }
}

/// Grades with the grader of a workspace, and clears the fields that differ between runs.
fn graded(bench: &Bench, submission: &Path) -> Record {
    let options = Options { name: "student".to_owned(), jobs: 1, ..Options::new(submission) };
    let mut record =
        grade(bench, &options, &Silent).unwrap_or_else(|why| panic!("{}", say::chain(&why))).record;
    record.build.time_s = 0.0;
    for check in record.stages.iter_mut().flat_map(|stage| &mut stage.checks) {
        check.time_s = 0.0;
        check.cpu_s = None;
        check.peak_bytes = 0;
    }
    record
}

fn packed(command: &mut Command) {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Grades the change in all ways, checks that the records are equal, and returns the record.
fn everywhere(edits: Edits) -> Record {
    let root = students(edits);
    let in_place = root.path().join("student_template");
    let own = open(root.path().join("exam"));
    assert_eq!(
        own.workshop.root,
        root.path().canonicalize().unwrap(),
        "the grader in place is the student's own"
    );
    let record = graded(&own, &in_place);
    let away = TempDir::new().unwrap();
    copy_folder(&in_place, &away.path().join("copy"));
    let at = |name: &str| away.path().join(name);
    packed(Command::new("tar").arg("-czf").arg(at("a.tar.gz")).arg("-C").arg(&in_place).arg("."));
    let names = fs::read_dir(&in_place).unwrap().map(|entry| entry.unwrap().file_name());
    packed(
        Command::new("python3")
            .args(["-m", "zipfile", "-c"])
            .arg(at("a.zip"))
            .args(names)
            .current_dir(&in_place),
    );
    for way in ["copy", "a.tar.gz", "a.zip"] {
        let found = graded(&FINAL, &at(way));
        assert_eq!(found, record, "{way} against in place");
    }
    record
}

/// Checks that the change builds, earns `points`, and gets remarks with these words.
fn check(edits: Edits, points: u64, words: &[&str]) {
    let record = everywhere(edits);
    assert_eq!(record.build.verdict, Verdict::Pass, "{:?}", record.build);
    assert_eq!(record.score.earned, points * 1000, "{:?}", record.build);
    let said = record.build.ignored.join("\n");
    assert!(words.iter().all(|words| said.contains(words)), "{said}");
}

/// Checks that the change does not build, and that the message names the files that are not used.
fn check_broken(edits: Edits, words: &[&str]) {
    let record = everywhere(edits);
    assert_eq!(record.build.verdict, Verdict::Fail, "{:?}", record.build);
    let said = record.build.finding.unwrap().message;
    assert!(said.contains("These files of yours are not used, which may be the reason"), "{said}");
    assert!(words.iter().all(|words| said.contains(words)), "{said}");
}

fn light(attenuation: &str) -> Option<String> {
    replaced("src/light.rs", "todo!(\"distance_attenuation [rule 4]: src/light.rs\")", attenuation)
}

#[test]
fn a_students_own_file_counts() {
    check(&[], 6, &[]);
    check(&[("src/light.rs", Some(text("tests/solution/src/light.rs")))], 10, &[]);
}

#[test]
fn a_given_file_counts_for_nothing() {
    let replaced_by_ours =
        |file: &str| format!("{file}: differs from the given file, which is used instead");
    let black = replaced("src/trace.rs", "None => scene.background,", "None => DVec3::ZERO,");
    check(
        &[("src/trace.rs", black)],
        6,
        &[&replaced_by_ours("src/trace.rs"), "all but the files that you write"],
    );
    let answer = "Answer::Value(match light { cases::Light::Point { attenuation: c, .. } => \
        (1.0 / (c.quadratic * r * r + c.linear * r + c.constant)).min(1.0), _ => 1.0 })";
    let better =
        replaced("src/probe.rs", "Answer::Value(light::distance_attenuation(light, *r))", answer);
    check(&[("src/probe.rs", better)], 6, &[&replaced_by_ours("src/probe.rs")]);
    check(&[("src/trace.rs", None)], 6, &[]);
    let mine = replaced("template.toml", "student = [", "student = [\n  \"src/main.rs\",");
    check(&[("template.toml", mine)], 6, &[&replaced_by_ours("template.toml")]);
}

#[test]
fn a_file_that_is_deleted_comes_from_the_grader() {
    check(
        &[("src/light.rs", None)],
        6,
        &["src/light.rs: missing, so the template's untouched one is taken"],
    );
}

#[test]
fn a_module_more_is_not_used() {
    let helper = Some("pub fn one() -> f64 { 1.0 }\n".to_owned());
    check(
        &[("src/helper.rs", helper.clone())],
        6,
        &["src/helper.rs: not a file of the template, so it is not used"],
    );
    let main = replaced("src/main.rs", "mod trace;", "mod trace;\nmod helper;");
    let uses = light("crate::helper::one()");
    check_broken(
        &[("src/helper.rs", helper), ("src/main.rs", main), ("src/light.rs", uses)],
        &[
            "E0433",
            "src/helper.rs: not a file of the template",
            "src/main.rs: differs from the given file",
        ],
    );
}

#[test]
fn a_dependency_more_is_not_there() {
    let manifest =
        replaced("Cargo.toml", "glam.workspace = true", "glam.workspace = true\nrand = \"0.10\"");
    check(&[("Cargo.toml", manifest.clone())], 6, &["Cargo.toml: differs from the given file"]);
    let uses = light("rand::random()");
    let words = &["E0433", "Cargo.toml: differs from the given file, which is used instead"];
    check_broken(&[("Cargo.toml", manifest), ("src/light.rs", uses)], words);
    check(
        &[("Cargo.toml", Some("no manifest".to_owned()))],
        6,
        &["Cargo.toml: differs from the given file"],
    );
}

#[test]
fn a_build_script_is_not_run() {
    let script = Some("fn main() { println!(\"cargo:rustc-env=ONE=1\"); }\n".to_owned());
    let says = "build.rs: not a file of the template, so it is not used";
    check(&[("build.rs", script.clone())], 6, &[says]);
    check_broken(
        &[("build.rs", script), ("src/light.rs", light("env!(\"ONE\").len() as f64"))],
        &["ONE", says],
    );
}

#[test]
fn every_hand_in_of_a_class_has_a_row() {
    let class = TempDir::new().unwrap();
    let at = |path: &str| class.path().join(path);
    let solution = workspace().join("tests/solution/src");
    copy_folder(&solution, &at("in/plain/src"));
    copy_folder(&solution, &at("in/flat"));
    copy_folder(&solution, &at("in/nested/a/b/c/src"));
    fs::write(at("in/nested/report.pdf"), "%PDF-1.7").unwrap();
    let nested = || fs::read_dir(at("in/nested")).unwrap().map(|entry| entry.unwrap().file_name());
    packed(
        Command::new("python3")
            .args(["-m", "zipfile", "-c", "../zip.zip"])
            .args(nested())
            .current_dir(at("in/nested")),
    );
    packed(Command::new("tar").args(["-cf", "../tar.tar", "."]).current_dir(at("in/nested")));
    fs::create_dir(at("in/platform")).unwrap();
    fs::copy(at("in/zip.zip"), at("in/platform/hw.zip")).unwrap();
    copy_folder(&solution, &at("in/several/a/src"));
    copy_folder(&solution, &at("in/several/b/src"));
    fs::create_dir(at("in/empty")).unwrap();
    for (name, text) in [
        ("seven.7z", "7z\u{bc}"),
        ("rar.zip", "Rar!\u{1a}\u{7}\0"),
        ("main.rs", ""),
        ("report.pdf", "%PDF"),
    ] {
        fs::write(at("in").join(name), text).unwrap();
    }
    let key = batch::Key::open(&at("key")).expect("a key");
    let options = batch::Options { folder: at("in"), out: at("out"), jobs: 2, key, collect: None };
    let grader = OnBench::new(&FINAL, &[]).unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    let summary = batch::run(&grader, &options, &Shown::new(true)).unwrap();
    assert_eq!((summary.n_done, summary.failed), (12, vec![]));
    let table = fs::read_to_string(at("out/class.csv")).unwrap();
    let rows: Vec<String> = table
        .lines()
        .skip(1)
        .map(|row| row.split(',').take(5).collect::<Vec<_>>().join(" "))
        .collect();
    assert_eq!(
        rows,
        [
            "empty empty 0 10 failed",
            "flat flat 10 10 worked",
            "main.rs main.rs 0 10 failed",
            "nested nested 10 10 worked",
            "plain plain 10 10 worked",
            "platform platform 10 10 worked",
            "rar rar 0 10 failed",
            "report.pdf report.pdf 0 10 failed",
            "seven seven 0 10 failed",
            "several several 0 10 failed",
            "tar tar 10 10 worked",
            "zip zip 10 10 worked",
        ]
    );
    let says = |id: &str| {
        fs::read_to_string(at("out/records").join(id).with_added_extension("json")).unwrap()
    };
    for (id, words) in [
        ("seven", "it is a .7z archive, which cannot be read: hand in .zip or .tar.gz"),
        ("rar", "it is a .rar archive, though its name ends in .zip, which cannot be read"),
        ("several", "`a`, `b`; hand in one of them"),
        ("flat", "the missing folder `src`: the .rs files at the top are taken as its files"),
        ("tar", "everything outside of the folder `a/b/c`: the submission is taken from there"),
    ] {
        assert!(says(id).contains(words), "{id}: no {words:?} in {}", says(id));
    }
}

#[test]
fn the_documents_state_the_limits() {
    let limits = [
        format!("{} an archive", size(LIMITS.archive_bytes)),
        format!("{} a file", size(LIMITS.file_bytes)),
        format!("{} in all", size(LIMITS.all_bytes)),
        format!("{} files and folders", LIMITS.entries),
        format!("{} names deep", LIMITS.depth),
        format!("up to {NESTED} folders deep"),
    ];
    for path in ["student_template/README.md", "docs/grading.md"] {
        let words = text(path).split_whitespace().collect::<Vec<_>>().join(" ");
        for limit in &limits {
            assert!(words.contains(limit), "{path} does not say: {limit}");
        }
    }
}
