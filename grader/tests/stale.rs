//! Checks that every command that judges refuses answers that do not belong to their cases, and
//! names the command that renews them.

mod shared;

use std::fs;
use std::path::Path;
use std::process::Command;

use cases::answer::{image_answer_path, mistakes_path};

use shared::{CASE, STAGE, dark_exam};

/// Runs `grader` in `home`, and returns the exit code and everything that it prints.
fn run(home: &Path, words: &[&str]) -> (Option<i32>, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_grader")).args(words).current_dir(home).output().unwrap();
    (
        output.status.code(),
        String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned(),
    )
}

/// The commands that judge.
const JUDGES: [&[&str]; 4] = [
    &["grade", "mine", "--cases", "stages"],
    &["images", "pictures", "--cases", "stages"],
    &["batch", "in", "-o", "out", "--sandbox", "basic", "--cases", "stages"],
    &[
        "compare",
        "pictures/01_ray_casting/dark.png",
        "--answer",
        "stages/01_ray_casting/dark.answer.exr",
    ],
];

/// Returns a folder with an exam, a submission, a class of one and a picture, all of them correct.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    dark_exam(&home.path().join("stages"));
    let black = [&b"PF\n4 3\n-1.0\n"[..], &[0; 144]].concat();
    fs::create_dir_all(home.path().join("pictures/01_ray_casting")).unwrap();
    fs::write(home.path().join("pictures/01_ray_casting/dark.png"), &black).unwrap();
    for folder in ["mine", "in/a"] {
        let folder = home.path().join(folder);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("submission.toml"), "[run]\ncommand = [\"sh\", \"./tracer.sh\"]\n")
            .unwrap();
        fs::write(folder.join("tracer.sh"), "cp \"${0%/*}/black.pfm\" \"$3\"").unwrap();
        fs::write(folder.join("black.pfm"), &black).unwrap();
    }
    home
}

/// Checks that after `change` the commands `judges` refuse to run and `lint` fails, and that all of
/// them name `what`.
fn check(judges: &[&[&str]], what: &str, change: impl FnOnce(&Path)) {
    let home = home();
    change(&home.path().join("stages"));
    for words in judges {
        let (code, said) = run(home.path(), words);
        assert_eq!(code, Some(2), "{words:?}: {said}");
        assert!(said.contains(what) && said.contains("`reference expect "), "{words:?}: {said}");
    }
    let (code, said) = run(home.path(), &["lint", "stages"]);
    assert_eq!(code, Some(1), "lint: {said}");
    assert!(said.contains(what) && said.contains("`reference expect "), "lint: {said}");
    assert!(!home.path().join("out/class.csv").exists());
}

fn rewrite(stages: &Path, from: &str, to: &str) {
    fs::write(stages.join("01_ray_casting/dark.toml"), CASE.replace(from, to)).unwrap();
}

/// The id of the case.
const ID: &str = "01_ray_casting/dark";
/// The name of the case in messages.
const DARK: &str = "dark";

#[test]
fn answers_that_belong_to_their_cases_are_used() {
    let home = home();
    for words in JUDGES {
        let (code, said) = run(home.path(), words);
        assert_eq!(code, Some(0), "{words:?}: {said}");
    }
}

#[test]
fn an_answer_to_another_scene_is_refused() {
    check(&JUDGES, DARK, |stages| rewrite(stages, "fov_y_deg = 40", "fov_y_deg = 40.5"));
    check(&JUDGES, DARK, |stages| rewrite(stages, "max_depth = 0", "max_depth = 1"));
    check(&JUDGES, DARK, |stages| rewrite(stages, "kd = [1, 1, 1]", "kd = [1, 1, 0.5]"));
}

#[test]
fn an_answer_of_another_course_is_refused() {
    for line in ["highlight = \"phong\"", "index_of_air = 1.0", "always_simulated = [\"shadows\"]"]
    {
        check(&JUDGES, DARK, |stages| fs::write(stages.join("course.toml"), line).unwrap());
    }
}

#[test]
fn an_answer_that_is_missing_or_broken_is_refused() {
    check(&JUDGES, DARK, |stages| fs::remove_file(image_answer_path(stages, ID)).unwrap());
    check(&JUDGES, DARK, |stages| fs::write(image_answer_path(stages, ID), "no answer").unwrap());
    check(&JUDGES[..3], "the list of known mistakes", |stages| {
        fs::remove_file(mistakes_path(stages)).unwrap()
    });
}

#[test]
fn words_for_people_make_no_answer_stale() {
    let home = home();
    rewrite(&home.path().join("stages"), "Nothing is there", "It is dark");
    let about = STAGE.replace("title = \"Dark\"", "title = \"Night\"");
    fs::write(home.path().join("stages/01_ray_casting/stage.toml"), about).unwrap();
    for words in JUDGES {
        let (code, said) = run(home.path(), words);
        assert_eq!(code, Some(0), "{words:?}: {said}");
    }
}

/// With a pipe that nobody writes to, and with no file handles left, no command waits, and none
/// blames the cases.
#[test]
fn an_answer_that_cannot_be_read_holds_up_nothing() {
    for special in ["mkfifo", "mkdir", "ln -s /dev/zero"] {
        check(&JUDGES[..3], DARK, |stages| {
            let answer = image_answer_path(stages, ID);
            fs::remove_file(&answer).unwrap();
            let line = format!("{special} '{}'", answer.display());
            assert!(Command::new("sh").args(["-c", &line]).status().unwrap().success());
        });
    }
    let home = home();
    let grader = env!("CARGO_BIN_EXE_grader");
    for words in ["grade mine --cases stages", "images pictures --cases stages"] {
        let line = format!("ulimit -n 4; exec '{grader}' {words}");
        let output =
            Command::new("sh").args(["-c", &line]).current_dir(home.path()).output().unwrap();
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert_eq!(output.status.code(), Some(3), "{words}: {said}");
    }
}
