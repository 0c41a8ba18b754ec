//! Tests of the command line from outside: exit codes, streams, files.

use std::path::Path;
use std::process::{Command, Output};

fn grader(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_grader")).args(arguments).current_dir(folder).output().unwrap()
}

/// Runs the command in `folder`, and checks its exit code and a part of what it prints on either
/// stream.
fn check(arguments: &[&str], folder: &Path, code: i32, part: &str) {
    let output = grader(arguments, folder);
    let text = String::from_utf8_lossy(&output.stdout).into_owned()
        + &String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
    assert!(text.contains(part), "{arguments:?}: no {part:?} in\n{text}");
}

#[test]
fn what_cannot_be_read_is_code_2() {
    let home = tempfile::tempdir().unwrap();
    check(&["grade", "--cases", "nowhere"], home.path(), 2, "nowhere");
    check(&["lint", "nowhere"], home.path(), 2, "no such folder");
    check(&["images", "nowhere"], home.path(), 2, "no such folder");
    check(&["bake"], home.path(), 2, "unrecognized");
    check(&["grade", "--open"], home.path(), 2, "--html");
}

#[test]
fn lint_says_what_is_missing() {
    let home = tempfile::tempdir().unwrap();
    let stage = home.path().join("01_ray_casting");
    std::fs::create_dir(&stage).unwrap();
    let text = "title = 'Ray casting'\nabout = 'Rays.'\nallows = ['attenuation']\nneeds = []\n\
        unit_points = 9\n";
    std::fs::write(stage.join("stage.toml"), text).unwrap();
    std::fs::write(stage.join("gone.answer.exr"), "").unwrap();
    check(&["lint", "."], home.path(), 1, "0 image cases, at least 8 are wanted");
    check(&["lint", "."], home.path(), 1, "allows `attenuation`, but no case of it calls for that");
    check(&["lint", "."], home.path(), 1, "gone.answer.exr: belongs to no case");
    std::fs::write(stage.join("stage.toml"), text.replace("unit_points", "unit_pionts")).unwrap();
    check(&["lint", "."], home.path(), 1, "did you mean `unit_points`?");
}

#[test]
fn every_command_shows_examples() {
    let home = tempfile::tempdir().unwrap();
    for command in ["grade", "images", "compare", "explain", "lint", "schema", "completions", "man"]
    {
        check(&[command, "--help"], home.path(), 0, "Example");
    }
    check(&["--help"], home.path(), 0, "130  interrupted");
    check(&["completions", "bash"], home.path(), 0, "_grader");
    check(&["man", "./pages"], home.path(), 0, "");
    let page = std::fs::read_to_string(home.path().join("pages/grader-grade.1")).unwrap();
    assert!(page.contains("submission"), "{page}");
}

#[test]
fn doctor_looks_at_everything() {
    let home = tempfile::tempdir().unwrap();
    let output = grader(&["doctor", "--cases", "nowhere"], home.path());
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(3), "{text}");
    for name in
        ["compiler:", "linker:", "workspace:", "store:", "cores:", "protection:", "missing  cases:"]
    {
        assert!(text.contains(name), "no {name} in\n{text}");
    }
    for name in ["ok       temporary files:", "ok       limits:", "memory:"] {
        assert!(text.contains(name), "no {name} in\n{text}");
    }
}

#[test]
fn limits_that_are_lower_are_said() {
    let under = |limit: &str, command: &str| {
        let line = format!("ulimit {limit}; exec \"$0\" {command}");
        let output =
            Command::new("sh").args(["-c", &line, env!("CARGO_BIN_EXE_grader")]).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr)
    };
    let doctor = |limit: &str, part: &str| {
        let text = under(limit, "doctor");
        assert!(text.contains(part), "{limit}: no {part:?} in {text}");
    };
    doctor(
        "-n 200",
        "ok       limits: programs get 200 open files, not 256 (ulimit -n), which is enough",
    );
    doctor("-n 20", "missing  limits: programs get 20 open files, not 256 (ulimit -n): raise it");
    doctor("-v 3000000", "ok       limits: programs get 2929 MiB of address space, not 4096");
    let exam = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/exam");
    let text = under("-n 200", &format!("grade /nowhere --cases '{exam}' -v"));
    assert!(text.contains("programs get 200 open files, not 256 (ulimit -n)"), "{text}");
}
