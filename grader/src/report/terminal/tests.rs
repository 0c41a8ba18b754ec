//! Tests of the report: it names each error, its place and its cause in few lines.

use super::*;
use crate::functions;
use crate::record::*;
use crate::report::sample;
use crate::submission::Language;

fn text(record: &Record, is_verbose: bool) -> String {
    let look = Look { is_verbose, columns: 100 };
    anstream::adapter::strip_str(&render(record, look)).to_string()
}

fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
}

#[test]
fn says_what_is_wrong_and_how_many_points_that_makes() {
    let shown = text(&sample::record("somebody"), false);
    let parts = [
        "left aside",
        "1 warning (-v",
        "[rule 3] [rule 14]",
        "- expected ",
        "+ yours    ",
        " points",
    ];
    has(&shown, &parts);
    has(&shown, &["  0.75 of 2 points, wrong: ", "look at this: ", "\n6.75 of 16 points\n"]);
    assert!(!shown.contains("protection"), "{shown}");
    has(&text(&sample::record("somebody"), true), &["(protection: timeouts+rlimits)"]);
}

#[test]
fn names_the_mistakes_that_explain_what_is_wrong() {
    let shown = text(&sample::record("somebody"), false);
    let end = "\nMost likely  the one is <wrong> [rule 3]\n    look at sphere.rs, function \
        intersect_sphere; see docs/shading-model.md#rule-3-direct-light\n\
        or  the other is <wrong> [rule 14]\n    look at sphere.rs, function intersect_sphere; see \
        docs/shading-model.md#rule-14-the-sphere\n    It explains 1 of 3 failed pictures and 1 of \
        1 failed unit check.\nCounted as right  0.25 points for what `one` explains in 1 picture \
        of other stages\nUnexplained  No known mistake explains all of 1 of 3 failed \
        pictures.";
    assert!(shown.contains(end), "{shown}");
    assert!(shown.ends_with("among 120 wrong pixels side by side.\n"), "{shown}");
    // The two checks that the mistake explains are one group, with the unit check as its example.
    assert_eq!(shown.matches("    most likely the one is <wrong>\n").count(), 1, "{shown}");
    has(&shown, &["    the same explains most of shifted\n"]);
}

/// Returns a record of one stage with these checks.
fn record_of(checks: Vec<CheckRecord>) -> Record {
    let mut record = sample::record("somebody");
    record.build.warnings.clear();
    record.build.ignored.clear();
    record.diagnoses.clear();
    record.unexplained = None;
    record.stages[0].checks = checks;
    record
}

/// Returns a check of the sample under another name.
fn check(sample: &str, name: &str) -> CheckRecord {
    let checks = sample::record("somebody").stages.remove(0).checks;
    let mut check =
        checks.into_iter().find(|check| check.id.ends_with(sample)).expect("a check of the sample");
    check.id = format!("01_ray_casting/{name}");
    if let Some(finding) = &mut check.finding {
        finding.diagnosis = None;
        finding.stderr = None;
        finding.actual =
            finding.actual.as_ref().map(|_| "hit\n  t       -0.5\n  normal  0 0 1\n".to_owned());
    }
    check
}

#[test]
fn one_wrong_function_does_not_fill_the_screen() {
    let record =
        record_of((0..9).map(|n| check("sphere/inside", &format!("sphere/{n}"))).collect());
    let shown = text(&record, false);
    has(&shown, &["    wrong as well: sphere/1, sphere/2, sphere/3 and 5 more (-v)\n"]);
    assert_eq!((shown.matches("- expected").count(), shown.lines().count()), (1, 7), "{shown}");
    assert_eq!(text(&record, true).matches("- expected").count(), 9);
}

#[test]
fn pictures_and_functions_that_call_others_stand_behind_a_wrong_function() {
    let of = |key: &str, name: &str| {
        let mut wrong = check("sphere/inside", name);
        wrong.finding.as_mut().expect("it is wrong").asked = Some(serde_json::json!({ "fn": key }));
        wrong
    };
    let picture = || check("shifted", "boxes");
    let record = record_of(vec![
        picture(),
        of("trace", "trace/a"),
        of("trace", "trace/b"),
        of("sphere", "sphere/a"),
    ]);
    let shown = text(&record, false);
    has(
        &shown,
        &[
            "01_ray_casting  1 wrong picture: boxes\n",
            "01_ray_casting  2 wrong answers of `trace`, which calls others: trace/a, trace/b\n",
            "01_ray_casting/sphere/a  wrong: The hit lies behind the ray's origin.",
        ],
    );
    assert_eq!(shown.matches("- expected").count(), 1, "{shown}");
    let shown = text(&record_of(vec![picture(), of("trace", "trace/a")]), false);
    has(
        &shown,
        &["01_ray_casting/boxes  wrong: ", "01_ray_casting/trace/a  wrong: ", "- expected"],
    );
}

#[test]
fn every_function_wrong_in_many_ways_takes_a_few_lines_each() {
    let wrong = |function: usize, n: usize| {
        let mut wrong = check("sphere/inside", &format!("f{function}/{n}"));
        let finding = wrong.finding.as_mut().expect("it is wrong");
        finding.asked = Some(serde_json::json!({ "fn": format!("f{function}") }));
        finding.expected = Some((0..40).map(|n| format!("x{n} 0\n")).collect());
        finding.actual = Some((0..40).map(|n| format!("x{n} 1\n")).collect());
        finding.message = "m".repeat(5000);
        wrong
    };
    let record =
        record_of((0..26).flat_map(|function| (0..20).map(move |n| wrong(function, n))).collect());
    let shown = text(&record, false);
    assert!(shown.lines().count() < 150, "{} lines of 520 wrong answers", shown.lines().count());
    assert!(shown.lines().all(|line| line.chars().count() <= 100), "{shown}");
    has(&shown, &["(72 more lines (-v shows all))"]);
}

#[test]
fn what_is_still_to_be_written_is_named_by_function_and_file() {
    let todo = |key: &str, name: &str| {
        let mut check = check("shade/dark", name);
        let finding = check.finding.as_mut().expect("it waits");
        finding.asked = Some(serde_json::json!({ "fn": key }));
        finding.message = functions::still_to_be_written(key, Some(Language::Rust));
        check
    };
    let mut picture = check("ball", "boxes");
    picture.verdict = Verdict::NotRun;
    picture.finding = Some(Finding::new(
        FindingKind::Todo,
        "still to be written: eye_ray [rule 1]: src/camera.rs",
    ));
    let record = record_of(vec![
        picture,
        check("sphere/tangent", "reflect/a"),
        todo("sphere", "sphere/a"),
        todo("sphere", "sphere/b"),
        todo("trace", "trace/a"),
    ]);
    let shown = text(&record, false);
    has(
        &shown,
        &[
            "still to be written (each function, or one that it calls)\n",
            "    `intersect_sphere` in src/sphere.rs: 2 unit checks of 01_ray_casting\n",
            "    a function that `trace` in src/trace.rs calls: 1 unit check of 01_ray_casting\n",
            "not run  1 picture of 01_ray_casting: still to be written: eye_ray [rule 1]: \
                src/camera.rs\n",
            "\nNext  write `intersect_sphere` in src/sphere.rs\n",
        ],
    );
}

#[test]
fn what_ends_alike_is_said_once() {
    let crash = |name: &str| {
        let mut crash = check("crashed", name);
        crash.finding = Some(Finding::new(FindingKind::Crash, "it ended with code 1"));
        crash
    };
    let shown = text(&record_of((0..30).map(|n| crash(&format!("picture_{n}"))).collect()), false);
    assert_eq!(shown.matches("it ended with code 1").count(), 1, "{shown}");
    has(&shown, &["    the same applies to picture_1, picture_2, picture_3 and 26 more (-v)\n"]);
}

#[test]
fn success_is_followed_by_a_next_step_and_failure_by_none() {
    let right = record_of(vec![check("ball", "ball"), check("sphere/tangent", "sphere/a")]);
    has(&text(&right, false), &["\nNext  everything that was run passes."]);
    let wrong = record_of(vec![check("ball", "ball"), check("sphere/inside", "sphere/a")]);
    assert!(!text(&wrong, false).contains("Next"));
    assert!(!text(&record_of(vec![]), false).contains("Next"));
}

#[test]
fn a_stage_without_pictures_has_no_column_for_them() {
    let shown = text(&record_of(vec![check("sphere/tangent", "sphere/a")]), false);
    has(&shown, &["01_ray_casting  1/1 unit checks  "]);
    assert!(!shown.contains("pictures  "), "{shown}");
}

#[test]
fn an_interrupt_is_said_before_the_points() {
    let mut record = record_of(vec![check("ball", "ball")]);
    record.interrupted = true;
    let shown = text(&record, false);
    has(
        &shown,
        &["Interrupted: not everything was run, so the points are not final.\n01_ray_casting"],
    );
    assert!(!shown.contains("Next"));
}

#[test]
fn errors_of_the_compiler_are_cut() {
    let mut record = record_of(vec![]);
    record.build.verdict = Verdict::Fail;
    record.build.finding = Some(Finding::new(FindingKind::Build, "error\n".repeat(300)));
    has(&text(&record, false), &["(240 more lines (-v shows all))"]);
    assert!(text(&record, true).lines().count() > 300);
}

#[test]
fn nothing_of_the_submission_reaches_the_terminal_raw() {
    let rendered = render(&sample::record("somebody"), Look { is_verbose: true, columns: 100 });
    let own = anstream::adapter::strip_str(&rendered).to_string();
    assert!(!own.contains('\u{1b}'), "{own:?}");
    assert!(own.chars().all(|c| c == '\n' || !crate::plain::is_hidden(c)), "{own:?}");
}
