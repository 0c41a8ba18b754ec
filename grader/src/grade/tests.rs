//! Small programs on an exam of flat colours, which is made here.

use std::os::unix::fs::PermissionsExt;
use std::time::Duration;

use cases::answer::ImageAnswer;
use cases::film::Image;
use cases::glam::DVec3;

use super::*;
use crate::exercise::Candidate;
use crate::sandbox::{Layers, Limits};

const STAGE: &str =
    "title = \"Flat\"\nabout = \"Flat.\"\nallows = []\nneeds = []\nunit_points = 0\n";

/// Returns the text of case `n`, in which all pixels have the light n / 10.
fn case(n: usize) -> String {
    format!(
        "title = \"Flat\"\nabout = \"Flat.\"\nrules = [1]\npoints = 2\n[render]\nsize = [4, 3]\n\
            max_depth = 0\n\
         [scene]\nbackground = [0.{n}, 0.{n}, 0.{n}]\n\
         [scene.camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n"
    )
}

fn flat(width: u32, n: usize) -> Image {
    Image::from_fn(width, 3, |_, _| DVec3::splat(n as f64 / 10.0))
}

/// Returns an exam of the cases 1 to `n`, and a folder with their correct pictures, such as
/// `1.png`.
fn exam(n: usize) -> (Exam, tempfile::TempDir) {
    let home = tempfile::tempdir().unwrap();
    let stages = home.path().join("stages");
    let stage = stages.join("01_flat");
    std::fs::create_dir_all(&stage).unwrap();
    std::fs::write(stage.join("stage.toml"), STAGE).unwrap();
    for n in 1..=n {
        std::fs::write(stage.join(format!("c{n}.toml")), case(n)).unwrap();
        cases::film::write(&home.path().join(format!("{n}.png")), &flat(4, n)).unwrap();
    }
    let mut exam = Exam::load(&stages).unwrap_or_else(|why| panic!("{why}"));
    let answers =
        (1..=n).map(|n| (format!("01_flat/c{n}"), ImageAnswer::exact(flat(4, n), 2.0, 0)));
    exam.stages[0].images = answers.collect();
    (exam, home)
}

/// Runs a script on the exam and returns the verdict and the message of each check. The script
/// finds the number of the case in $n and the path of the correct picture in $right. Its last
/// command copies that picture to $out.
fn on(
    exam: &(Exam, tempfile::TempDir),
    script: &str,
    limits: Limits,
    jobs: usize,
) -> Vec<(Verdict, String)> {
    let allowance = Allowance { picture: limits, questions: limits, whole: Allowance::WHOLE };
    within(exam, script, allowance, jobs)
}

/// Runs a script like [`on`], within `allowance`.
fn within(
    exam: &(Exam, tempfile::TempDir),
    script: &str,
    allowance: Allowance,
    jobs: usize,
) -> Vec<(Verdict, String)> {
    let home = exam.1.path();
    let path = home.join(format!("program{jobs}"));
    let text = format!(
        "#!/bin/sh\nout=$3; n=$(tr -d ' \\n' < \"$2\" | sed \
            's/.*\"background\":.0.\\([0-9]\\).*/\\1/'); right={}/$n.png\n\
         {script}\ncp $right $out",
        home.display()
    );
    std::fs::write(&path, text).unwrap();
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
    let program =
        crate::build::Program::new("/bin/sh", vec![path.into_os_string()], "/usr/bin:/bin");
    let plan = plan::Plan::new(&exam.0, &[], &[]).unwrap();
    let candidate = Candidate { program: &program, allowance, layers: Layers::default() };
    let answers = perform::exercise(&plan, &candidate, jobs, &Silent);
    let (stages, _) = write_up::stages(&plan, answers, &exam.0);
    let checks = stages.into_iter().flat_map(|stage| stage.checks);
    let said = |finding: Option<Finding>| finding.map_or(String::new(), |finding| finding.message);
    checks.map(|check| (check.verdict, said(check.finding))).collect()
}

fn verdicts(results: &[(Verdict, String)]) -> Vec<Verdict> {
    results.iter().map(|(verdict, _)| *verdict).collect()
}

#[test]
fn a_panic_of_the_judge_costs_one_check() {
    use Verdict::{Ours, Pass};
    let mut exam = exam(4);
    // The judge relies on pictures of one size. The check of the size comes before it.
    let other_size = ImageAnswer::exact(flat(1, 9), 2.0, 0);
    exam.0.stages[0].images.insert("01_flat/c2".to_owned(), other_size);
    for jobs in [1, 3] {
        let results = on(&exam, "", Allowance::default().picture, jobs);
        assert_eq!(verdicts(&results), [Pass, Ours, Pass, Pass], "{results:?}");
        assert!(results[1].1.contains("the grader panicked"), "{results:?}");
    }
}

#[test]
fn the_number_of_jobs_changes_no_verdict_after_time_outs() {
    use Verdict::{Fail, Pass};
    let exam = exam(5);
    let seconds = Duration::from_secs;
    let limits =
        Limits { idle: Duration::from_millis(300), ..Allowance::new(seconds(6), 1 << 30).picture };
    // After two time-outs the other pictures of the stage get 1.2 s each. The fourth needs more.
    let script = "case $n in 2|3) sleep 100;; 4) while read -r line < /proc/$$/stat; do set -- \
        ${line##*) }; \
                  [ $((${12} + ${13})) -ge 160 ] && break; done;; esac";
    for jobs in [1, 5] {
        let results = on(&exam, script, limits, jobs);
        assert_eq!(verdicts(&results), [Pass, Fail, Fail, Fail, Pass], "{jobs} jobs: {results:?}");
        assert!(
            results[1].1.starts_with("it was idle for more than 0.3 s"),
            "{jobs} jobs: {results:?}"
        );
        assert_eq!(results[3].1, "it used more than 1.2 s of CPU time", "{jobs} jobs: {results:?}");
    }
}

#[test]
fn checks_after_the_time_of_the_submission_are_not_run() {
    use Verdict::{NotRun, Pass};
    let exam = exam(3);
    let whole = Duration::from_millis(500);
    for jobs in [1, 3] {
        let allowance = Allowance { whole, ..Allowance::default() };
        let results = within(&exam, "sleep 1", allowance, jobs);
        assert_eq!(verdicts(&results), [Pass, NotRun, NotRun], "{jobs} jobs: {results:?}");
        assert!(results[2].1.starts_with("not run: out of time"), "{results:?}");
    }
}

#[test]
fn two_runs_that_differ_are_reported_and_the_worse_one_counts() {
    use Verdict::{Fail, Pass};
    let exam = exam(4);
    let home = exam.1.path().display().to_string();
    // The first run of these cases is right. The second one gives another picture, or fails.
    let script = format!(
        "case $n in 2|3) if [ -e {home}/seen$n ]; then case $n in 2) right={home}/1.png;; \
         3) exit 7;; esac; fi; : > {home}/seen$n;; esac"
    );
    let results = on(&exam, &script, Allowance::default().picture, 1);
    assert_eq!(verdicts(&results), [Pass, Fail, Fail, Pass], "{results:?}");
    let expected = "two runs of the program gave pictures that differ in 12 pixels; the worse one";
    assert!(results[1].1.starts_with(expected), "{results:?}");
    assert!(results[2].1.contains("none in the other"), "{results:?}");
    assert!(results[2].1.ends_with("it ended with code 7"), "{results:?}");
}
