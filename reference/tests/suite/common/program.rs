//! Runs the program on a small scene.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A scene of a sphere before a camera, under one light.
pub(crate) const SCENE: &str = r#"
[render]
size = [8, 6]
max_depth = 1
[scene.camera]
eye = [0, 0, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 40
[scene.materials]
m = { kd = [0.5, 0.5, 0.5] }
[[scene.lights]]
directional = { direction = [0, 0, -1], colour = [1, 1, 1] }
[[scene.objects]]
sphere = {}
material = "m"
"#;

/// Runs the program in `folder`, with `input` on its standard input.
pub(crate) fn run(folder: &Path, args: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_reference"))
        .current_dir(folder)
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that reads nothing may have ended.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// Returns a folder with `scene.toml`, and with a case and a check in `stages/01_one` and in
/// `cases/stages/01_one`.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write("scene.toml", SCENE);
    let case = format!(
        "title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n{}",
        SCENE.replace("sphere = {}", "square = {}")
    );
    for root in ["stages", "cases/stages"] {
        write(
            &format!("{root}/01_one/stage.toml"),
            "title = \"One\"\nabout = \"a\"\nallows = []\nneeds = []\nunit_points = 1\n",
        );
        write(&format!("{root}/01_one/card.toml"), &case);
        write(&format!("{root}/01_one/checks/sphere.toml"), &check("1.5"));
    }
    folder
}

/// Returns a unit check whose answer on paper is `t`.
pub(crate) fn check(t: &str) -> String {
    format!(
        "[[check]]\nname = \"ahead\"\nabout = \"a\"\nrules = [14]\n\
         ask = {{ fn = \"sphere\", ray = {{ origin = [0, 0, 2], direction = [0, 0, -1] }}, center \
         = [0, 0, 0], radius = 0.5 }}\n\
         paper = {{ hit = {{ t = {t}, normal = [0, 0, 1] }} }}\n"
    )
}

/// Checks that the program ended with the exit code `code`, and that its error stream contains
/// `said`.
#[track_caller]
pub(crate) fn expect(output: &Output, code: i32, said: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "stderr: {errors}");
    assert!(errors.contains(said), "stderr lacks {said:?}: {errors}");
}
