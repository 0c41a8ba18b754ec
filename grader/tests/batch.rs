//! Tests of `grader batch` with small programs and an exam of one black picture: runs that are
//! killed, interrupted, and started again.

mod class;
mod shared;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output};

use cases::answer::image_answer_path;

use class::{BLACK, CRASH, Class, SLOW, WHITE, wait_for};
use shared::{CASE, STAGE, expect};

#[test]
fn a_class_is_graded_and_tabulated() {
    let class = Class::new(&[("black", BLACK), ("white", WHITE), ("crash", CRASH)]);
    fs::create_dir(class.at("in/empty")).unwrap();
    fs::write(class.at("in/broken.zip"), "no zip").unwrap();
    let (code, printed, lines) = class.run("2");
    assert_eq!(code, 0, "{printed}{lines}");
    assert_eq!(
        class.table(),
        [
            "black black 2 2 worked 2",
            "broken broken 0 2 failed 0",
            "crash crash 0 2 worked 0",
            "empty empty 0 2 failed 0",
            "white white 0 2 worked 0"
        ]
    );
    assert!(lines.contains("black: 2 of 2 points"), "{lines}");
    assert!(printed.contains("5 submissions have a record, 5 of them graded"), "{printed}");
    let report = fs::read_to_string(class.at("out/reports/white.html")).unwrap();
    assert!(report.contains("12 pixels out of tolerance"));

    let tables = |class: &Class| {
        ["out/class.csv", "out/class.html"].map(|path| fs::read(class.at(path)).unwrap())
    };
    let before = tables(&class);
    class.hand_in("white", BLACK);
    let (_, printed, lines) = class.run("1");
    assert!(lines.contains("black: 2 of 2 points (unchanged)"), "{lines}");
    assert!(
        printed.contains("3 of them graded"),
        "the changed one, and the two that cannot be read: {printed}"
    );
    assert!(class.table().contains(&"white white 2 2 worked 2".to_owned()));
    class.hand_in("white", WHITE);
    class.run("1");
    assert_eq!(tables(&class), before, "the same class gives the same tables");
}

#[test]
fn a_killed_run_goes_on_where_it_was() {
    let class = Class::new(&[("a", BLACK), ("b", SLOW), ("c", BLACK)]);
    let mut child = class.start("1");
    wait_for(|| class.has_record("a"));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!class.has_record("b") && !class.at("out/class.csv").exists());
    class.hand_in("b", WHITE);
    let (code, printed, lines) = class.run("1");
    assert_eq!(code, 0);
    assert!(lines.contains("a: 2 of 2 points (unchanged)"), "{lines}");
    assert!(printed.contains("3 submissions have a record, 2 of them graded"), "{printed}");
}

#[test]
fn an_interrupt_keeps_what_is_done() {
    let class = Class::new(&[("a", BLACK), ("b", SLOW), ("c", BLACK)]);
    let child = class.start("1");
    wait_for(|| class.has_record("a"));
    interrupt(&child);
    let Output { status, stdout, .. } = child.wait_with_output().unwrap();
    assert_eq!(status.code(), Some(130));
    assert!(class.has_record("a") && !class.has_record("b") && !class.at("out/class.csv").exists());
    let printed = String::from_utf8(stdout).unwrap();
    assert!(printed.contains("2 are left"), "{printed}");
}

/// A run that one submission kills keeps the number of deaths of the other one. Without layers, a
/// program finds the grader as the parent of the launcher, which is the parent of its own parent.
#[test]
fn two_submissions_that_kill_the_grader_hold_up_nobody_for_ever() {
    let kill = "p=$PPID; for n in 1 2; do p=$(cut -d ' ' -f 4 /proc/$p/stat); done; kill -9 $p; \
        sleep 5";
    let class = Class::new(&[("a", kill), ("b", kill), ("c", BLACK), ("d", BLACK)]);
    let run = || class.start("1").wait_with_output().unwrap().status.code();
    let codes: Vec<_> = std::iter::repeat_with(run).take(8).take_while(Option::is_none).collect();
    assert_eq!(codes.len(), 4, "each of them kills two runs");
    assert!(class.has_record("c") && class.has_record("d"));
    assert_eq!(run(), None, "a later run tries them again");
}

#[test]
fn a_submission_that_kills_its_parent_is_graded_to_the_end() {
    let class = Class::new(&[("a", "kill -9 $PPID; sleep 5"), ("b", BLACK)]);
    let (code, printed, lines) = class.run("1");
    assert_eq!(code, 0, "{printed}{lines}");
    assert!(class.has_record("a") && class.has_record("b"));
    assert!(lines.contains("a: 0 of 2 points"), "{lines}");
}

fn interrupt(child: &Child) {
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn answers_that_cannot_be_trusted_grade_nobody() {
    let class = Class::new(&[("a", BLACK)]);
    let case = class.at("stages/01_ray_casting/dark.toml");
    let answer = image_answer_path(&class.at("stages"), "01_ray_casting/dark");
    let narrower = || fs::write(&case, CASE.replace("fov_y_deg = 40", "fov_y_deg = 40.5")).unwrap();
    let check = |said: &str| {
        let (code, printed, lines) = class.run("1");
        assert_eq!(code, 2, "{printed}{lines}");
        assert!(lines.contains(said) && lines.contains(": dark"), "no {said:?} in\n{lines}");
        assert!(lines.contains("01_ray_casting/dark.toml` renews them"), "{lines}");
        assert!(!class.at("out").exists());
    };
    fs::remove_file(&answer).unwrap();
    check("there are no stored answers to");
    fs::write(&answer, "no answer").unwrap();
    check("the stored answers cannot be read");
    expect(&class.at("stages"), "dark");
    narrower();
    check("the stored answers do not belong to the cases");
    fs::write(&case, CASE).unwrap();
    fs::write(class.at("stages/course.toml"), "highlight = \"phong\"").unwrap();
    let (code, _, lines) = class.run("1");
    assert_eq!(code, 2);
    assert!(lines.contains("dark; the list of known mistakes"), "{lines}");
    fs::remove_file(class.at("stages/course.toml")).unwrap();
    assert_eq!(class.run("1").0, 0);
    narrower();
    expect(&class.at("stages"), "dark");
    let (code, printed, _) = class.run("1");
    assert_eq!(code, 0);
    assert!(printed.contains("1 of them graded"), "a changed case regrades: {printed}");
}

#[test]
fn a_changed_description_regrades_nobody() {
    let class = Class::new(&[("a", BLACK)]);
    class.run("1");
    let about = CASE
        .replace("so nothing is seen", "so one sees nothing")
        .replace("title = \"Dark\"", "title = \"Black\"");
    assert_ne!(about, CASE);
    fs::write(class.at("stages/01_ray_casting/dark.toml"), about).unwrap();
    fs::write(
        class.at("stages/01_ray_casting/stage.toml"),
        STAGE.replace("Nothing is there", "It is dark"),
    )
    .unwrap();
    fs::write(class.at("stages/notes.txt"), "a file that no score depends on").unwrap();
    let (code, printed, lines) = class.run("1");
    assert_eq!(code, 0, "{lines}");
    assert!(printed.contains("1 submission has a record, 0 of them graded"), "{printed}");
}

#[test]
fn a_folder_without_submissions_is_an_error_of_use() {
    let class = Class::new(&[]);
    fs::create_dir(class.at("in")).unwrap();
    let (code, _, said) = class.run("1");
    assert_eq!(code, 2);
    assert!(said.contains("there is no submission in"), "{said}");
    assert!(!Path::new(&class.at("out")).exists());
}
