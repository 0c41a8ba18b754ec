//! Tests of `reference vary` from outside: its files, its refusals, and its exit codes.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const STAGE: &str = "title = \"One\"\nabout = \"a\"\nallows = []\nneeds = []\nunit_points = 1\n";

const CHECK: &str = r#"
[[check]]
name = "ahead"
about = "a"
rules = [14]
ask = { fn = "sphere", ray = { origin = [0, 0, 2], direction = [0, 0, -1] }, center = [0, 0, 0], radius = 0.5 }
"#;

const MESH: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

/// Returns a case of a triangle from a file, with the bounds `vary`.
fn case(vary: &str) -> String {
    format!(
        r#"title = "A card" # of paper
about = "a"
rules = [16]
points = 2

[render]
size = [16, 12]
{vary}
[scene.camera]
eye = [0.125, 0, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 40

[scene.materials]
paper = {{ kd = [0.5, 0, 1] }}

[[scene.lights]]
directional = {{ direction = [0, 0, -1], colour = [1, 1, 1] }}

[[scene.objects]]
name = "card"
mesh = {{ file = "../../meshes/card.obj" }}
material = "paper"
"#
    )
}

/// Returns a folder with the stage `cases/stages/01_one`, which has a case with the bounds `vary`
/// and a check, and with the mesh of the case.
fn folder(vary: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let stage = "cases/stages/01_one";
    for (name, text) in [
        (format!("{stage}/stage.toml"), STAGE),
        (format!("{stage}/card.toml"), &case(vary)),
        (format!("{stage}/checks/sphere.toml"), CHECK),
        ("cases/meshes/card.obj".to_owned(), MESH),
    ] {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// Runs the program in `folder`. Returns the exit code, the error stream and the output stream.
fn run(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let program =
        Command::new(env!("CARGO_BIN_EXE_reference")).current_dir(folder).args(args).output();
    let Output { status, stdout, stderr } = program.unwrap();
    (status.code(), String::from_utf8(stderr).unwrap(), String::from_utf8(stdout).unwrap())
}

const NARROW: &str = "\n[vary]\neye = 0.1\ncolours = 0.05\n";

/// Returns all files below `folder` with their bytes, by path.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(files(&path)),
            false => found.push((path.display().to_string(), fs::read(&path).unwrap())),
        }
    }
    found.sort();
    found
}

/// The originals have no course, but there is one beside the place of the set.
#[test]
fn a_course_beside_the_set_decides_nothing() {
    let folder = folder(NARROW);
    fs::create_dir(folder.path().join("b")).unwrap();
    fs::write(folder.path().join("b/course.toml"), "highlight = \"phong\"\n").unwrap();
    let (code, errors, _) = run(folder.path(), &["vary", "--seed", "3", "--out", "b/hidden"]);
    assert_eq!(code, Some(0), "{errors}");
    let (code, errors, _) = run(folder.path(), &["expect", "--check", "b/hidden"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        fs::read_to_string(folder.path().join("b/hidden/course.toml"))
            .unwrap()
            .starts_with("# The choices")
    );
}

#[test]
fn writes_a_whole_set_with_its_answers() {
    let folder = folder(NARROW);
    let (code, errors, _) = run(folder.path(), &["vary", "--seed", "3"]);
    assert_eq!(code, Some(0), "{errors}");
    let set = folder.path().join("varied-3");
    let names: Vec<String> = files(&set)
        .into_iter()
        .map(|(path, _)| path[set.display().to_string().len() + 1..].to_owned())
        .collect();
    let answers = [
        "01_one/card.answer.exr",
        "01_one/card.expected.png",
        "01_one/checks.answers.json",
        "mistakes.answers.json",
    ];
    let (made, varied): (Vec<&str>, Vec<&str>) =
        names.iter().map(String::as_str).partition(|name| answers.contains(name));
    assert_eq!(made, answers);
    let varied: Vec<&str> =
        varied.into_iter().map(|name| name.trim_start_matches("01_one/")).collect();
    assert_eq!(
        varied,
        ["card.toml", "checks/sphere.toml", "stage.toml", "up/up/meshes/card.obj", "course.toml"]
    );
    let text = fs::read_to_string(set.join("01_one/card.toml")).unwrap();
    assert!(text.contains("title = \"A card\" # of paper"), "comments stay: {text}");
    assert!(
        text.contains("look_at = [0, 0, 0]") && text.contains("file = \"up/up/meshes/card.obj\""),
        "{text}"
    );
    assert!(!text.contains("[vary]") && !text.contains("[0.125, 0, 4]"), "{text}");
    let (code, errors, _) = run(folder.path(), &["expect", "--check", "varied-3"]);
    assert_eq!(code, Some(0), "{errors}");
}

#[test]
fn a_seed_gives_the_same_bytes_and_another_one_others() {
    let folder = folder(NARROW);
    let set = |seed: &str, out: &str| {
        let (code, errors, _) = run(folder.path(), &["vary", "--seed", seed, "--out", out]);
        assert_eq!(code, Some(0), "{errors}");
        files(&folder.path().join(out)).into_iter().map(|(_, bytes)| bytes).collect::<Vec<_>>()
    };
    let one = set("1", "one");
    assert_eq!(one, set("1", "one_again"));
    assert_ne!(one, set("2", "two"));
}

#[test]
fn says_how_well_the_bounds_hold() {
    let folder = folder(NARROW);
    let (code, errors, table) = run(folder.path(), &["vary", "--check", "--seeds", "5"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(table.contains("01_one/card") && table.contains("100.0 %"), "{table}");
    assert!(!folder.path().join("varied-1").exists());
}

/// Each row has the bounds, the arguments, the exit code and a part of the error.
#[test]
fn what_cannot_be_varied_is_an_error_that_says_why() {
    let table = [
        (
            "",
            &["vary", "--seed", "1"][..],
            2,
            "no case in cases/stages has a `[vary]`, so that nothing would change",
        ),
        (
            "\n[vary]\neye = 0.1\nindices = 0.1\n",
            &["vary", "--seed", "1"],
            2,
            "`indices` moves nothing",
        ),
        ("\n[vary]\nkeep = [\"card\"]\n", &["vary", "--seed", "1"], 2, "no key moves anything"),
        (
            "\n[vary]\nlook_at = [1000, 0, 0]\n",
            &["vary", "--seed", "1"],
            1,
            "none of 50 draws will do; make its `[vary]` narrower",
        ),
        (
            "\n[vary]\nlook_at = [1000, 0, 0]\n",
            &["vary", "--check", "--seeds", "2"],
            1,
            "with seed 2 none of 50 draws",
        ),
        (NARROW, &["vary", "--seed", "1", "--out", "cases"], 2, "`cases` is there already"),
        (
            NARROW,
            &["vary", "--seed", "1", "--out", "/proc/none/set"],
            2,
            "cannot write /proc/none/set",
        ),
        (NARROW, &["vary"], 2, "--seed"),
        (NARROW, &["vary", "--seed", "1", "nowhere"], 2, "nowhere"),
    ];
    for (vary, args, code, said) in table {
        let folder = folder(vary);
        let (ended, errors, _) = run(folder.path(), args);
        assert_eq!(ended, Some(code), "{args:?} {vary}: {errors}");
        assert!(errors.contains(said), "{args:?} {vary}: {errors}");
        assert!(!folder.path().join("varied-1").exists(), "{args:?} {vary}: something was written");
    }
}

/// A varied set is complete: it has its answers, and unchanged copies of the cases without bounds.
#[test]
fn a_case_without_bounds_is_copied_as_it_is_with_a_warning() {
    let folder = folder(NARROW);
    let at = |path: &str| folder.path().join(path);
    fs::write(at("cases/stages/01_one/constant.toml"), case("")).unwrap();
    let (code, errors, _) = run(folder.path(), &["vary", "--seed", "1"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains("warning: 01_one/constant has no `[vary]`"), "{errors}");
    assert!(errors.contains("wrote 2 cases with their answers to varied-1"), "{errors}");
    let copied = fs::read_to_string(at("varied-1/01_one/constant.toml")).unwrap();
    assert_eq!(
        copied,
        case("").replace("../../meshes", "up/up/meshes"),
        "only the path of the mesh changes"
    );
    let (code, errors, _) = run(folder.path(), &["expect", "--check", "varied-1"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        errors.contains("6 files as stored"),
        "two answers, two pictures, unit checks, mistakes: {errors}"
    );
}

#[test]
fn a_set_follows_the_course_of_its_originals() {
    let folder = folder(NARROW);
    fs::write(folder.path().join("cases/course.toml"), "row_0 = \"bottom\"\n").unwrap();
    let (code, errors, _) = run(folder.path(), &["vary", "--seed", "1"]);
    assert_eq!(code, Some(0), "{errors}");
    assert_eq!(
        fs::read_to_string(folder.path().join("varied-1/course.toml")).unwrap(),
        "row_0 = \"bottom\"\n"
    );
}
