//! Tests of the points of the untouched template and of the solution, and of the points that each
//! stage's files add.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use grader::grade::{Bench, Options, Silent};
use grader::record::{CheckKind, FindingKind, Record, Verdict};
use grader::report::terminal::{self, Look};
use tempfile::TempDir;
use tests::{grade_all, public_stages, workspace};

/// Returns the student's files of the template, by stage.
fn files_by_stage() -> BTreeMap<String, Vec<String>> {
    let text = fs::read_to_string(workspace().join("student_template/template.toml"))
        .expect("the list of files");
    let lists: toml::Table = text.parse().expect("TOML");
    let stages = lists["stages"].as_table().expect("a table of stages");
    let paths = |list: &toml::Value| list.as_array().expect("a list").iter().map(text_of).collect();
    stages.iter().map(|(stage, list)| (stage.clone(), paths(list))).collect()
}

fn text_of(value: &toml::Value) -> String {
    value.as_str().expect("a path").to_owned()
}

/// Returns a submission: the template, with the files of the stages in `done` taken from the
/// solution.
fn submission(done: &[String]) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::create_dir(folder.path().join("src")).expect("an empty folder");
    for (stage, paths) in files_by_stage() {
        let from = if done.contains(&stage) { "tests/solution" } else { "student_template" };
        for path in paths {
            fs::copy(workspace().join(from).join(&path), folder.path().join(&path))
                .expect("a listed file");
        }
    }
    folder
}

fn grade(folder: &Path) -> Record {
    grade_all(folder).record
}

/// Returns the earned thousandths of a point by stage.
fn earned(record: &Record) -> BTreeMap<String, u64> {
    record.stages.iter().map(|stage| (stage.id.clone(), stage.earned)).collect()
}

#[test]
fn the_untouched_template_builds_scores_nothing_and_crashes_nowhere() {
    let record = grade(&workspace().join("student_template"));
    assert_eq!(record.build.verdict, Verdict::Pass, "{:?}", record.build);
    assert_eq!(record.build.warnings, Vec::<String>::new());
    assert_eq!(record.score.earned, 0);
    for check in record.stages.iter().flat_map(|stage| &stage.checks) {
        let kind = check.finding.as_ref().map(|finding| finding.kind);
        assert_eq!(kind, Some(FindingKind::Todo), "{}: {:?}", check.id, check.finding);
    }
}

/// Each step adds files in the order of the handout, and gives the number of correct pictures among
/// the 14 of the first stage.
#[test]
fn the_first_files_give_as_many_pictures_as_the_handout_says() {
    let first = ["camera", "sphere", "nearest", "shade"];
    let steps: [(&[&str], usize); 5] = [
        (&[], 0),
        (&["light"], 1),
        (&["light", "plane"], 7),
        (&["light", "plane", "cuboid"], 10),
        (&["light", "plane", "cuboid", "triangle"], 14),
    ];
    let bench = Bench::open(&public_stages()).expect("the public exam");
    for (more, n_right) in steps {
        let folder = submission(&[]);
        for name in first.iter().chain(more) {
            let file = format!("src/{name}.rs");
            fs::copy(workspace().join("tests/solution").join(&file), folder.path().join(&file))
                .expect("a file");
        }
        let options = Options { stages: vec!["01".to_owned()], ..Options::new(folder.path()) };
        let record = grader::grade::grade(&bench, &options, &Silent).expect("a record").record;
        let pictures =
            record.stages[0].checks.iter().filter(|check| check.kind == CheckKind::Image);
        let n = pictures.filter(|check| check.verdict == Verdict::Pass).count();
        assert_eq!(n, n_right, "{first:?} and {more:?}");
    }
}

/// A separate bug in each of five functions: the file, the correct code, and the wrong code.
const FIVE_BUGS: [(&str, &str, &str); 5] = [
    ("shade", "material.kd * n_dot_l", "material.kd * n_dot_l * n_dot_l"),
    ("shadow", "share *= kt;", "share = kt;"),
    ("reflection", "depth < max_depth", "depth <= max_depth"),
    ("transform", "matrix3.transpose()", "matrix3.inverse()"),
    ("smooth", "weights.z * c).normalize()", "weights.z * c)"),
];

#[test]
fn five_bugs_take_a_few_lines_that_name_the_functions() {
    let stages: Vec<String> = files_by_stage().into_keys().collect();
    let folder = submission(&stages);
    for (name, right, wrong) in FIVE_BUGS {
        let path = folder.path().join(format!("src/{name}.rs"));
        let text = fs::read_to_string(&path).expect("a file of the solution");
        assert!(text.contains(right), "{name}.rs");
        fs::write(&path, text.replace(right, wrong)).expect("a file that can be written");
    }
    let report = terminal::render(&grade(folder.path()), Look { is_verbose: false, columns: 100 });
    let report = anstream::adapter::strip_str(&report).to_string();
    assert!(report.lines().count() < 80, "{} lines:\n{report}", report.lines().count());
    assert!(report.lines().all(|line| line.chars().count() <= 100), "{report}");
    for place in [
        "shade.rs, function light_term",
        "shadow.rs, function shadow_attenuation",
        "reflection.rs, function goes_on",
        "transform.rs, function normal_to_world",
        "smooth.rs, function interpolate_normal",
    ] {
        assert!(report.contains(place), "no {place} in\n{report}");
    }
}

#[test]
fn the_solution_earns_everything() {
    let record = grade(&workspace().join("tests/solution"));
    let lost: Vec<_> = record
        .stages
        .iter()
        .flat_map(|stage| &stage.checks)
        .filter(|check| check.earned != check.possible)
        .map(|check| {
            format!("{}: {:?}", check.id, check.finding.as_ref().map(|finding| &finding.message))
        })
        .collect();
    assert!(lost.is_empty(), "{}", lost.join("\n"));
    assert_eq!(record.score.earned, record.score.possible);
    assert_eq!(record.stages.len(), 6);
}

#[test]
fn each_stage_lifts_exactly_its_own_points() {
    let stages: Vec<String> = files_by_stage().into_keys().collect();
    let mut before = earned(&grade(submission(&[]).path()));
    for n_done in 1..=stages.len() {
        let record = grade(submission(&stages[..n_done]).path());
        let lifted = &stages[n_done - 1];
        for stage in &record.stages {
            let was = before[&stage.id];
            if stage.id == *lifted {
                assert_eq!(stage.earned, stage.possible, "{lifted} is complete, and yet");
                assert!(was < stage.earned, "{lifted} had all its points before it was written");
            } else {
                assert_eq!(stage.earned, was, "{lifted} changed the points of {}", stage.id);
            }
        }
        before = earned(&record);
    }
}

#[test]
fn a_stage_written_without_the_others_lifts_no_other() {
    for stage in files_by_stage().into_keys() {
        let record = grade(submission(std::slice::from_ref(&stage)).path());
        for other in record.stages.iter().filter(|other| other.id != stage) {
            assert_eq!(other.earned, 0, "{stage} alone earns points in {}", other.id);
        }
        let crashes = record.stages.iter().flat_map(|s| &s.checks).filter(|check| {
            check.finding.as_ref().is_some_and(|finding| finding.kind == FindingKind::Crash)
        });
        assert_eq!(crashes.count(), 0, "{stage} alone crashes");
    }
}
