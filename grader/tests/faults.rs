//! Checks that a shortage of the machine is never the student's fault, and that a broken program
//! costs little time.

mod class;
mod shared;

use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::Path;
use std::process::{Command, Stdio};

use grader::record::{CheckRecord, Record};

use class::{BLACK, CRASH, Class, wait_for};

/// Checks the exit code and a part of the output of a batch with one program, after a line of
/// shell.
///
/// If the machine failed, nothing is published, and the next run grades the program.
fn check(line: &str, script: &str, code: i32, part: &str) {
    check_class(&Class::new(&[("a", script)]), line, script, code, part);
}

/// Like [`check`], for a correct program that the script has to build first.
fn check_build(line: &str, script: &str, code: i32, part: &str) {
    let class = Class::new(&[("a", BLACK)]);
    let commands =
        "[build]\ncommand = [\"sh\", \"./build.sh\"]\n[run]\ncommand = [\"sh\", \"./tracer.sh\"]\n";
    fs::write(class.at("in/a/submission.toml"), commands).unwrap();
    fs::write(class.at("in/a/build.sh"), script).unwrap();
    check_class(&class, line, script, code, part);
}

fn check_class(class: &Class, line: &str, script: &str, code: i32, part: &str) {
    let (found, printed, said) = class.run_under(line, &["--jobs", "1"]);
    assert_eq!(found, code, "{line}, {script}: {printed}{said}");
    assert!((printed + &said).contains(part), "{line}, {script}: no {part:?} in {said}");
    assert_eq!(class.has_record("a"), code == 0, "{line}, {script}");
    assert_eq!(class.run("1").0, 0, "{line}, {script}: the next run");
    assert!(class.has_record("a"), "{line}, {script}: the next run");
}

/// Returns a script that draws if `test` holds, and else crashes.
fn where_holds(test: &str) -> String {
    format!("{test} || {{ echo 'it does not hold' >&2; exit 1; }}; {BLACK}")
}

#[test]
fn limits_of_the_grader_are_not_exceeded_and_not_the_students() {
    let files = where_holds("[ $(ulimit -n) -ge 64 ]");
    check("ulimit -n 200", &files, 0, "a: 2 of 2 points");
    check("ulimit -n 200", CRASH, 0, "a: 0 of 2 points");
    check("ulimit -n 20", &files, 3, "20 open files, not 256 (ulimit -n)");
    check("ulimit -v 3000000", BLACK, 0, "a: 2 of 2 points");
    check(
        "ulimit -v 3000000",
        "[ $(ulimit -v) = unlimited ] || [ $(ulimit -v) -gt 3000000 ] || { echo MemoryError >&2; \
            exit 1; }",
        3,
        "address space",
    );
    check("ulimit -t 15", BLACK, 0, "a: 2 of 2 points");
    check(
        "ulimit -t 1",
        "while [ $(ulimit -t) = 1 ]; do :; done",
        3,
        "1 s of CPU time, not 26 (ulimit -t)",
    );
    check("ulimit -f 1000", BLACK, 0, "a: 2 of 2 points");
    check(
        "ulimit -f 1000",
        &where_holds("head -c 2000000 /dev/zero > big"),
        3,
        "in a file, not 65536 (ulimit -f)",
    );
}

#[test]
fn results_that_cannot_be_written_are_not_half_written() {
    let class = Class::new(&[("a", BLACK)]);
    let (code, printed, said) = class.run_under("ulimit -f 20", &["--jobs", "1"]);
    assert_eq!(code, 3, "{printed}{said}");
    assert!(said.contains("cannot write the results to"), "{said}");
    assert_eq!(
        fs::read_dir(class.at("out/results")).unwrap().count(),
        0,
        "something was published"
    );
    assert!(!class.at("out/class.csv").exists());
    assert_eq!(class.run("1").0, 0);
    assert_eq!(class.table(), ["a a 2 2 worked 2"]);
}

#[test]
fn a_missing_folder_for_temporary_files_is_named() {
    check(
        "export TMPDIR=/nowhere/at/all",
        BLACK,
        3,
        "no temporary folder can be made in /nowhere/at/all",
    );
}

/// Returns whether this system lets its users mount file systems of their own. Containers and
/// hardened systems do not.
fn can_mount(folder: &Path) -> bool {
    let mount = format!("mount -t tmpfs none '{}'", folder.display());
    let tried =
        Command::new("unshare").args(["-rm", "sh", "-c", &mount]).stderr(Stdio::null()).status();
    tried.is_ok_and(|status| status.success())
}

#[test]
fn a_full_disk_is_not_the_students() {
    let scratch = tempfile::tempdir().unwrap();
    if !can_mount(scratch.path()) {
        eprintln!("file systems cannot be mounted here, so only made-up machines are tested");
        return;
    }
    let scratch = scratch.path().display();
    let with = |size: &str| {
        format!(
            "exec unshare -rm sh -c 'mount -t tmpfs -o {size} none {scratch}; TMPDIR={scratch} \
                exec \"$@\"' sh \"$@\""
        )
    };
    // The program's copy, the scene and the marks take about eight blocks of 4 KiB.
    let large = where_holds("head -c 100000 /dev/zero > \"$3\"");
    check(&with("size=96k"), &large, 3, "has no room for");
    check(&with("size=12k"), BLACK, 3, "No space left");
    check(
        &with("size=1m,nr_inodes=12"),
        &where_holds("for i in 1 2 3 4 5 6 7 8 9; do : > $i; done"),
        3,
        "has no room",
    );
    check_build(
        &with("size=1m"),
        "head -c 2000000 /dev/zero > tool || exit 1",
        3,
        "has no room for",
    );
    check(&with("size=1m"), &large, 0, "a: 2 of 2 points");
    check(&with("size=1m"), CRASH, 0, "a: 0 of 2 points");
    check(&with("size=1m"), "rm -rf \"$PWD\"; exit 1", 0, "a: 0 of 2 points");
}

/// A compiler that only prints its name, since another user may not reach the real one.
const COMPILER: &str =
    "#!/bin/sh\ncase $1 in --print) cd \"${0%/*}/..\" && pwd;; *) echo rustc 1.0;; esac\n";

/// Copies the files that make a folder a workspace of the assignment.
fn copy_workspace(to: &Path) {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut files = vec!["Cargo.lock".into(), "cases/Cargo.toml".into()];
    let template = grader::files::below(&from.join("student_template")).unwrap();
    files.extend(template.iter().map(|path| path.strip_prefix(from).unwrap().to_owned()));
    for file in files.iter().filter(|file| !file.starts_with("student_template/target")) {
        fs::create_dir_all(to.join(file).parent().unwrap()).unwrap();
        fs::copy(from.join(file), to.join(file)).unwrap();
    }
}

#[test]
fn exhausted_processes_are_not_the_students() {
    let class = Class::new(&[("a", BLACK)]);
    let place = class.at("");
    for folder in ["out", "tmp", "bin"] {
        fs::create_dir(class.at(folder)).unwrap();
    }
    copy_workspace(&place);
    fs::write(class.at("bin/rustc"), COMPILER).unwrap();
    fs::copy(env!("CARGO_BIN_EXE_grader"), class.at("bin/grader")).unwrap();
    for path in ["", "out", "tmp", "bin/rustc"] {
        fs::set_permissions(class.at(path), PermissionsExt::from_mode(0o777)).unwrap();
    }
    // The system does not count the processes of root, so root becomes another user, who has none.
    let is_root = fs::metadata("/proc/self").unwrap().uid() == 0;
    let become_other =
        if is_root { "setpriv --reuid=54321 --regid=54321 --clear-groups" } else { "env" };
    for n in [1, 2] {
        let line = format!(
            "shift; cd {place}; export TMPDIR={place}/tmp PATH={place}/bin:$PATH; \
             exec prlimit --nproc={n} {become_other} {place}/bin/grader \"$@\"",
            place = place.display()
        );
        let (code, printed, said) = class.run_under(&line, &["--jobs", "1"]);
        assert_eq!(code, 3, "{n} processes: {printed}{said}");
        let is_named =
            said.contains("more processes") || said.contains("Resource temporarily unavailable");
        assert!(is_named, "{n} processes: {printed}{said}");
        assert!(!class.has_record("a"));
    }
    assert_eq!(class.run("1").0, 0);
    assert_eq!(class.table(), ["a a 2 2 worked 2"]);
}

#[test]
fn what_a_killed_run_leaves_is_removed_by_the_next_and_live_runs_keep_theirs() {
    let place = tempfile::tempdir().unwrap();
    let line = format!("export TMPDIR={}", place.path().display());
    let folders = || {
        let entries = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap().path());
        let mut folders: Vec<_> = entries.collect();
        folders.sort();
        folders
    };
    let busy = "i=0; while [ $i -lt 100000000 ]; do i=$((i+1)); done";
    let (killed, live, next) =
        (Class::new(&[("a", busy)]), Class::new(&[("b", busy)]), Class::new(&[("c", BLACK)]));
    let start = |class: &Class| {
        class.command(&line, &["--jobs", "1", "--time-limit", "600"]).spawn().unwrap()
    };
    let mut first = start(&killed);
    wait_for(|| folders().len() == 1);
    wait_for(|| folders()[0].join("1/scene.json").exists());
    first.kill().unwrap();
    first.wait().unwrap();
    let left = folders();
    assert_eq!(left.len(), 1, "the killed run left something");
    assert!(fs::read_dir(killed.at("out")).unwrap().any(|entry| is_part(&entry.unwrap().path())));
    let mut second = start(&live);
    wait_for(|| folders().len() == 1 && folders() != left);
    wait_for(|| folders()[0].join("1/scene.json").exists());
    let held = folders();
    assert_eq!(next.run_under(&line, &["--jobs", "1"]).0, 0);
    assert_eq!(folders(), held, "only the live run has a folder");
    second.kill().unwrap();
    second.wait().unwrap();
    assert_eq!(next.run_under(&line, &["--jobs", "1"]).0, 0);
    killed.hand_in("a", BLACK);
    assert_eq!(killed.run_under(&line, &["--jobs", "1"]).0, 0);
    assert!(!fs::read_dir(killed.at("out")).unwrap().any(|entry| is_part(&entry.unwrap().path())));
    assert_eq!(folders().len(), 0);
}

fn is_part(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(".part-"))
}

/// Grades a program with an exam of `n` pictures. Returns how often the program was started, and
/// the points and message of each check.
fn on_pictures(n: usize, script: &str, jobs: &str) -> (usize, Vec<(u64, String)>) {
    let class = Class::new(&[]);
    (1..n).for_each(|n| class.add_case(&format!("dark{n:02}")));
    let log = class.at("log");
    class.hand_in("a", &format!("log='{}'; echo started >> \"$log\"; {script}", log.display()));
    let mut grade = Command::new(env!("CARGO_BIN_EXE_grader"));
    grade.arg("grade").arg(class.at("in/a")).arg("--cases").arg(class.at("stages"));
    // The program writes to a file of the test.
    grade.args(["--sandbox", "none", "--jobs", jobs, "--time-limit", "1", "--json", "-"]);
    let output = grade.output().unwrap();
    let record: Record = serde_json::from_slice(&output.stdout).unwrap();
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let message = |check: &CheckRecord| {
        check.finding.as_ref().map_or(String::new(), |finding| finding.message.clone())
    };
    let said = checks.map(|check| (check.earned, message(check))).collect();
    (fs::read_to_string(log).unwrap().lines().count(), said)
}

#[test]
fn a_program_that_fails_whatever_it_is_given_is_not_started_for_every_picture() {
    // The pictures for which the program is started. It is started once more, with an empty scene.
    let (loud, silent) = (&[0, 1, 11][..], &[0, 1, 3, 4, 6, 7, 9, 11][..]);
    for (script, kind, started) in [
        ("echo no configuration >&2; exit 1", "it ended with code 1: no configuration", loud),
        ("while :; do :; done", "it used more than 1 s of CPU time", loud),
        ("exit 1", "it ended with code 1", silent),
    ] {
        for jobs in ["1", "4"] {
            let (n_starts, said) = on_pictures(12, script, jobs);
            assert_eq!(
                (n_starts, said.len()),
                (started.len() + 1, 12),
                "{script}, {jobs} jobs: {said:?}"
            );
            let left_out = format!("so {} pictures were left out", 12 - started.len());
            for (n, (earned, message)) in said.iter().enumerate() {
                assert_eq!(*earned, 0);
                assert!(message.contains(kind), "{script}, {jobs} jobs, {n}: {message}");
                assert_eq!(
                    message.contains(&left_out),
                    !started.contains(&n),
                    "{script}, {n}: {message}"
                );
            }
        }
    }
}

/// The note at the end of a Rust panic says nothing about the cause, and neither does an end
/// without a message.
#[test]
fn a_program_that_fails_for_several_reasons_gets_the_points_of_what_it_can_do() {
    let note = "echo 'note: run with `RUST_BACKTRACE=1` environment variable to display a \
        backtrace' >&2; exit 101";
    let loud = format!(
        "n=$(wc -l < \"$log\"); [ $n -le 2 ] && {{ echo \"panicked at line $n\" >&2; {note}; }}; \
            {BLACK}"
    );
    let silent = format!(
        "grep -q sphere \"$2\" || exit 1; [ $(wc -l < \"$log\") -le 2 ] && exit 1; {BLACK}"
    );
    for script in [loud, silent] {
        let (_, said) = on_pictures(12, &script, "1");
        assert_eq!(said.iter().filter(|(earned, _)| *earned > 0).count(), 10, "{script}: {said:?}");
    }
}

#[test]
fn a_program_that_fails_at_what_is_in_the_scene_is_started_for_every_picture() {
    let picky = format!("grep -q sphere \"$2\" && {{ echo no spheres >&2; exit 1; }}; {BLACK}");
    let (n_starts, said) = on_pictures(6, &picky, "2");
    assert_eq!(n_starts, 7, "once with an empty scene: {said:?}");
    assert!(
        said.iter().all(|(_, message)| message == "it ended with code 1: no spheres"),
        "{said:?}"
    );
}

#[test]
fn a_program_that_sleeps_is_not_waited_for_without_end() {
    let (_, said) = on_pictures(24, &format!("sleep 0.9; {BLACK}"), "4");
    let n_right = said.iter().take_while(|(earned, _)| *earned > 0).count();
    assert!((12..20).contains(&n_right), "{n_right} pictures of 0.9 s fit into 12 s: {said:?}");
    let rest = &said[n_right..];
    let is_reported = |message: &str| {
        message == "not run, because the program was idle for 12 s in all before this"
    };
    assert!(rest.iter().all(|(earned, message)| *earned == 0 && is_reported(message)), "{rest:?}");
}
