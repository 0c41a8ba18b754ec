//! Tests of `reference expect` from outside: a set of answers is written as a whole or not at all,
//! and belongs to its cases.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const STAGE: &str = "title = \"a\"\nabout = \"a\"\nallows = []\nunit_points = 1\n";

const CASE: &str = r#"
title = "A ball"
about = "Grey in the middle."
rules = [14]
points = 2
render = { size = [16, 12] }
[scene]
camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 20 }
materials = { chalk = { kd = [0.5, 0.5, 0.5], ks = [0.5, 0.5, 0.5], ns = 5 } }
lights = [{ directional = { direction = [0, 0.3, -1], colour = [1, 1, 1] } }]
objects = [{ sphere = {}, material = "chalk" }]
"#;

/// Returns a unit check with `t` on paper. The correct value is 1.5.
fn check(t: &str) -> String {
    format!(
        "[[check]]\nname = \"ahead\"\nabout = \"a\"\nrules = [14]\n\
         ask = {{ fn = \"sphere\", ray = {{ origin = [0, 0, 2], direction = [0, 0, -1] }}, center \
         = [0, 0, 0], radius = 0.5 }}\n\
         paper = {{ hit = {{ t = {t}, normal = [0, 0, 1] }} }}\n"
    )
}

/// Returns a folder with two stages below `cases/stages`, each with a case and a check.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for stage in ["01_one", "02_two"] {
        let stage = folder.path().join("cases/stages").join(stage);
        fs::create_dir_all(stage.join("checks")).unwrap();
        fs::write(stage.join("stage.toml"), STAGE).unwrap();
        fs::write(stage.join("ball.toml"), CASE).unwrap();
        fs::write(stage.join("checks/sphere.toml"), check("1.5")).unwrap();
    }
    folder
}

fn reference(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_reference")).args(args).current_dir(folder).output().unwrap()
}

#[track_caller]
fn expect(folder: &Path, args: &[&str], code: i32, said: &str) {
    let output = reference(folder, args);
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {text}");
    assert!(text.contains(said), "{args:?}: no {said:?} in\n{text}");
}

/// Returns the content of every file below the folder, by path.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => all.extend(content(&path)),
            false => drop(all.insert(path.display().to_string(), fs::read(&path).unwrap())),
        }
    }
    all
}

/// The first stage is correct, but an answer of the second one is not.
#[test]
fn one_wrong_answer_on_paper_keeps_every_file_as_it_was() {
    let folder = folder();
    fs::write(folder.path().join("cases/stages/02_two/checks/sphere.toml"), check("1.25")).unwrap();
    let before = content(folder.path());
    expect(folder.path(), &["expect"], 1, "02_two/sphere/ahead: on paper the answer is");
    expect(folder.path(), &["expect"], 1, "1 did not pass; nothing was written");
    assert_eq!(content(folder.path()), before);
}

/// The limit on a file is one kibibyte, and the answer to a case is longer. As on a full disk, the
/// file can be created but not filled.
#[test]
fn a_file_that_cannot_be_filled_keeps_every_other_as_it_was() {
    let folder = folder();
    let before = content(folder.path());
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" expect";
    let binary = env!("CARGO_BIN_EXE_reference");
    let output = Command::new("bash")
        .args(["-c", script, binary])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("nothing was changed"), "{text}");
    assert_eq!(content(folder.path()), before);
}

#[test]
fn one_command_sets_up_another_course() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    fs::create_dir(at("docs")).unwrap();
    fs::write(at("docs/course.md"), "old").unwrap();
    fs::write(at("cases/course.toml"), "highlight = \"blinn\"\n").unwrap();
    fs::write(at("phong.toml"), "highlight = \"phong\"\n").unwrap();
    expect(folder.path(), &["expect"], 0, "8 written");
    let lecture = content(folder.path());
    expect(
        folder.path(),
        &["expect", "01_one/ball", "--course", "phong.toml"],
        2,
        "sets up a whole folder of stages",
    );
    assert_eq!(content(folder.path()), lecture);
    expect(
        folder.path(),
        &["expect", "--check", "--course", "phong.toml"],
        1,
        "course.toml differs",
    );
    expect(folder.path(), &["expect", "--course", "phong.toml"], 0, "written");
    assert_eq!(fs::read_to_string(at("cases/course.toml")).unwrap(), "highlight = \"phong\"\n");
    assert!(fs::read_to_string(at("docs/course.md")).unwrap().contains("`\"phong\"`"));
    expect(folder.path(), &["expect", "--check"], 0, "8 files as stored, 0 written");
    let phong = content(folder.path());
    let png = at("cases/stages/01_one/ball.expected.png").display().to_string();
    assert_ne!(phong[&png], lecture[&png], "the highlight shows");
}

/// A hidden set is beside the public one, and both use one course.
#[test]
fn another_course_for_one_of_two_sets_changes_nothing_of_the_other() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    fs::create_dir(at("docs")).unwrap();
    fs::write(at("docs/course.md"), "old").unwrap();
    fs::write(at("cases/course.toml"), "highlight = \"blinn\"\n").unwrap();
    fs::write(at("phong.toml"), "highlight = \"phong\"\n").unwrap();
    fs::create_dir_all(at("cases/hidden/01_one")).unwrap();
    for file in ["stage.toml", "ball.toml"] {
        fs::copy(at("cases/stages/01_one").join(file), at("cases/hidden/01_one").join(file))
            .unwrap();
    }
    expect(folder.path(), &["expect"], 0, "written");
    let public = content(folder.path());
    for _ in 0..2 {
        expect(folder.path(), &["expect", "cases/hidden", "--course", "phong.toml"], 0, "written");
        assert_eq!(
            fs::read_to_string(at("cases/hidden/course.toml")).unwrap(),
            "highlight = \"phong\"\n"
        );
        let now = content(folder.path());
        assert!(
            public.iter().all(|(path, bytes)| now[path] == *bytes),
            "a file of the public set changed"
        );
    }
}

#[test]
fn a_stage_is_named_by_its_folder() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    expect(folder.path(), &["expect"], 0, "written");
    fs::rename(at("cases/stages/01_one"), at("cases/stages/01_one.v2")).unwrap();
    fs::remove_file(at("cases/stages/01_one.v2/ball.answer.exr")).unwrap();
    for name in ["cases/stages/01_one.v2", "01_one.v2", "01_one.v2/ball"] {
        expect(folder.path(), &["expect", name, "--check"], 1, "ball.answer.exr is missing");
    }
    let here = reference(&at("cases/stages/01_one.v2"), &["expect", ".", "--check"]);
    assert_eq!(here.status.code(), Some(1), "{}", String::from_utf8_lossy(&here.stderr));
}

/// A title or a description does not affect an answer. The numbers of the scene, the question and
/// the course do.
#[test]
fn an_answer_belongs_to_what_it_was_made_from() {
    let stale = |path: &str, from: &str, to: &str| {
        let folder = folder();
        let path = folder.path().join(path);
        expect(folder.path(), &["expect"], 0, "7 written");
        let text = fs::read_to_string(&path).unwrap_or_default();
        assert!(text.contains(from), "{from}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let output = reference(folder.path(), &["expect", "--check"]);
        String::from_utf8_lossy(&output.stderr).matches("differs from what the rules give").count()
    };
    for (path, from, to, n) in [
        ("cases/stages/01_one/ball.toml", "A ball", "A sphere", 0),
        ("cases/stages/01_one/ball.toml", "Grey in the middle", "Grey", 0),
        ("cases/stages/01_one/stage.toml", "about = \"a\"", "about = \"b\"", 0),
        ("cases/stages/01_one/checks/sphere.toml", "about = \"a\"", "about = \"b\"", 0),
        // The bytes of the picture do not change, only its inputs.
        ("cases/stages/01_one/ball.toml", "ns = 5", "ns = 5, index = 1.5", 1),
        (
            "cases/stages/01_one/checks/sphere.toml",
            "radius = 0.5",
            "radius = 0.5000000000000001",
            1,
        ),
        ("cases/stages/course.toml", "", "refract_by = \"geometric\"", 5),
    ] {
        assert_eq!(stale(path, from, to), n, "{path}: {from} to {to}");
    }
}
