//! Tests that any legal course can be set up. Its answers can be made, and a program that follows
//! the course earns everything.
//!
//! The program is the reference behind a script that passes the course. Most courses are tested on
//! small pictures, because making the answers at full size takes a minute of processor time for
//! each course.

use std::fs;
use std::path::{Path, PathBuf};

use cases::course::{self, Course};
use cases::stage;
use grader::grade::{Bench, Options, Silent, grade};
use grader::record::Verdict;
use grader::sandbox::Layers;
use pages::say;
use rayon::prelude::*;
use reference::expect::{self, Expected, Progress, Set};
use tempfile::TempDir;
use tests::workspace;

/// The public stages.
const PUBLIC: &str = "cases/stages";

/// A progress receiver that ignores reports and never stops the work.
struct Unwatched;

impl Progress for Unwatched {
    fn step(&self) {}

    fn is_stopped(&self) -> bool {
        false
    }
}

/// The stages of a course with answers, in pictures with a `part`-th of the width and height.
struct Exam {
    folder: TempDir,
}

impl Exam {
    /// Copies the stages in the folder `from` of the workspace, without answers, and sets the
    /// course.
    fn new(from: &str, course: &str, part: u32) -> Self {
        let exam = Self { folder: tempfile::tempdir().expect("a temporary folder") };
        copy(&workspace().join("cases/assets"), &exam.at("assets"), &|text| text);
        copy(&workspace().join(from), &exam.stages(), &|text| smaller(&text, part));
        fs::write(exam.stages().join(course::FILE), course).expect("a file in a temporary folder");
        exam
    }

    fn at(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    fn stages(&self) -> PathBuf {
        self.at("stages")
    }

    /// Makes the answers. Returns a sentence for each that cannot be made.
    fn expect(&self, course: &Course) -> Result<(), String> {
        let stages =
            stage::load_all(&self.stages(), course).map_err(|problems| problems.to_string())?;
        let set = Set::new(stages, course);
        let answers = expect::of_set(&self.stages(), &set, |_| true, &Unwatched)
            .map_err(|why| say::chain(&why))?;
        cases::files::write_all(answers.files().map(Expected::as_output))
            .map(drop)
            .map_err(|why| say::chain(&why))
    }

    /// Grades a program that follows the course. Returns a line for each check that does not earn
    /// everything.
    fn lost(&self) -> Result<Vec<String>, String> {
        let submission = self.at("follower");
        fs::create_dir(&submission).map_err(|why| why.to_string())?;
        let course = self.stages().join(course::FILE);
        let script = format!(
            "exec {} \"$@\" --course {}\n",
            env!("CARGO_BIN_EXE_follower"),
            course.display()
        );
        fs::write(submission.join("follow.sh"), script).map_err(|why| why.to_string())?;
        fs::write(submission.join("submission.toml"), "run.command = [\"sh\", \"./follow.sh\"]\n")
            .map_err(|why| why.to_string())?;
        let mut bench = Bench::open(&self.stages()).map_err(|why| say::chain(&why))?;
        // The program starts the follower, which lies outside its folder.
        bench.workshop.layers = Layers::default();
        let options = Options { jobs: 1, ..Options::new(&submission) };
        let record = grade(&bench, &options, &Silent).map_err(|why| say::chain(&why))?.record;
        let checks = record.stages.iter().flat_map(|stage| &stage.checks);
        let n_checks: usize =
            bench.exam.stages.iter().map(|it| it.stage.cases.len() + it.stage.checks.len()).sum();
        assert_eq!(checks.clone().count(), n_checks, "the whole exam is graded");
        let lost =
            checks.filter(|check| check.verdict != Verdict::Pass || check.earned != check.possible);
        Ok(lost
            .map(|check| {
                format!("{}: {:?}", check.id, check.finding.as_ref().map(|it| &it.message))
            })
            .collect())
    }
}

/// Copies the files of cases and meshes below `from`, without answers. `change` is applied to the
/// text of cases.
fn copy(from: &Path, to: &Path, change: &dyn Fn(String) -> String) {
    fs::create_dir_all(to).expect("a folder in a temporary folder");
    for entry in fs::read_dir(from).expect("a folder of the workspace") {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        match path.extension().and_then(|ending| ending.to_str()) {
            _ if path.is_dir() => copy(&path, &target, change),
            Some("toml") => {
                let text = change(fs::read_to_string(&path).expect("a case"));
                fs::write(target, text).expect("a file in a temporary folder");
            }
            Some("exr" | "png" | "json") => {}
            _ => drop(fs::copy(&path, target).expect("a file in a temporary folder")),
        }
    }
}

/// Returns the text of a case with a picture of a `part`-th of the columns and rows.
fn smaller(text: &str, part: u32) -> String {
    let line = |line: &str| {
        let sides = line.strip_prefix("size = [").and_then(|rest| rest.split_once(']'));
        match sides {
            Some((sides, behind)) => {
                let sides =
                    sides.split(',').map(|side| side.trim().parse::<u32>().expect("a side") / part);
                let sides: Vec<String> = sides.map(|side| side.max(1).to_string()).collect();
                format!("size = [{}]{behind}\n", sides.join(", "))
            }
            None => format!("{line}\n"),
        }
    };
    text.lines().map(line).collect()
}

fn check(from: &str, line: &str, part: u32) -> Result<(), String> {
    let course = course::parse("course", line).map_err(|problems| problems.to_string())?;
    let exam = Exam::new(from, line, part);
    exam.expect(&course)?;
    match exam.lost()? {
        lost if lost.is_empty() => Ok(()),
        lost => Err(lost.join("\n")),
    }
    .map_err(|why| format!("{from}, {line}:\n{why}"))
}

#[test]
fn in_every_course_that_differs_in_one_key_a_program_that_follows_it_earns_everything() {
    let deviations = course::deviations();
    assert!(deviations.len() > 20, "{}", deviations.len());
    let check = |line: &str| {
        let public = check(PUBLIC, line, 4).err();
        [public, check("tests/exam", line, 1).err()].into_iter().flatten().collect::<Vec<_>>()
    };
    let wrong: Vec<String> = deviations.par_iter().flat_map(|one| check(&one.line)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_course_of_three_differences_is_set_up_at_full_size() {
    check(PUBLIC, "highlight = \"phong\"\npixel = \"corner\"\nindex_of_air = 1.0", 1)
        .unwrap_or_else(|why| panic!("{why}"));
}

/// Answers of one course are refused in another one, whatever the program.
#[test]
fn the_answers_of_another_course_are_refused() {
    let exam = Exam::new(PUBLIC, "highlight = \"phong\"", 8);
    let phong = course::course_of(&exam.stages()).unwrap_or_else(|problems| panic!("{problems}"));
    exam.expect(&phong).unwrap_or_else(|why| panic!("{why}"));
    fs::write(exam.stages().join(course::FILE), "highlight = \"blinn\"")
        .expect("a file in a temporary folder");
    let refused = exam.lost().expect_err("its answers are those of another course");
    assert!(refused.contains("do not belong to the cases, the course or the rules"), "{refused}");
    assert!(
        refused.contains("01_ray_casting: boxes, ") && refused.contains("reference expect"),
        "{refused}"
    );
}
