//! A class with a roster: which hand-ins are graded, and what is written beside the table.

use std::fs;
use std::sync::Mutex;

use super::*;
use crate::alike::Sketch;
use crate::batch::{Grader, Key, Listener, Options, ROLL, Read, Summary, run};
use crate::collect::roll::Standing;
use crate::grade::GradeError;
use crate::graded::Graded;
use crate::record::Record;
use crate::report::sample;

/// A grader that gives as many thousandths of a point as the file or folder `points` says.
#[derive(Default)]
struct Points(Mutex<Vec<String>>);

fn points(path: &Path) -> String {
    let path = if path.is_dir() { path.join("points") } else { path.to_owned() };
    fs::read_to_string(path).unwrap_or_default()
}

impl Grader for Points {
    fn epoch(&self) -> &str {
        "1"
    }

    fn read(&self, submission: &Path) -> Option<Read> {
        let digest = blake3::hash(points(submission).as_bytes()).to_hex().to_string();
        Some(Read { digest, sketch: Sketch::new([""; 0], &Sketch::default()) })
    }

    fn grade(&self, submission: &Submission) -> Result<Graded, GradeError> {
        let mut graded = sample::graded(&submission.name);
        graded.record.submission.digest = self.read(&submission.path).unwrap_or_default().digest;
        graded.record.score.earned = points(&submission.path).trim().parse().unwrap_or(0);
        self.0.lock().unwrap().push(submission.name.clone());
        Ok(graded)
    }

    fn is_stopped(&self) -> bool {
        false
    }
}

struct Silent;

impl Listener for Silent {
    fn begin(&self, _: usize) {}
    fn taken(&self, _: &Submission, _: &Record) {}
    fn refused(&self, _: &Submission) {}
    fn graded(&self, _: &Submission, _: &Record) {}
    fn failed(&self, _: &Submission, _: &str) {}
    fn end(&self) {}
}

const ROSTER: &str = "id,name,section\n1,=Ann Lee,A\n2,Bo Day,B\n3,Cy Fox,B\n";
const POLICY: &str = "deadline = 2026-10-05T23:59:00+02:00\ndeduct = \"10 %\"\nper = \"day\"\n";
const METADATA: &str = "---\nsubmission_1:\n  :submitters:\n  - :name: Ann\n    :sid: '1'\n  \
    :created_at: 2026-10-06 20:00:00 Z\nsubmission_2:\n  :submitters:\n  - :name: Eve\n    :sid: \
    '9'\n  :created_at: 2026-10-05 20:00:00 Z\n";

struct Place(tempfile::TempDir);

impl Place {
    fn new(files: &[(&str, &str)]) -> Self {
        let place = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = place.path().join("in").join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        Self(place)
    }

    fn out(&self, name: &str) -> PathBuf {
        self.0.path().join("out").join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.out(name)).unwrap()
    }

    /// Runs a batch. Returns the names that were graded as well.
    fn run(&self, collect: Option<Collect>) -> Result<(Summary, Vec<String>), BatchError> {
        let grader = Points::default();
        let options = Options {
            folder: self.0.path().join("in"),
            out: self.out(""),
            jobs: 1,
            key: Key::open(&self.0.path().join("key")).unwrap(),
            collect,
        };
        let summary = run(&grader, &options, &Silent)?;
        Ok((summary, grader.0.into_inner().unwrap()))
    }
}

fn collect(policy: Option<&str>, export: Export) -> Option<Collect> {
    let roster = Roster::parse("roster.csv", ROSTER.as_bytes()).unwrap();
    let policy = policy.map(|text| Policy::parse("late.toml", text.as_bytes()).unwrap());
    Some(Collect { roster, policy, export, count: Count::Latest })
}

#[test]
fn an_export_of_gradescope_becomes_a_table_of_students() {
    let place = Place::new(&[
        ("assignment_7_export/submission_metadata.yml", METADATA),
        ("assignment_7_export/submission_1/points", "10000"),
        ("assignment_7_export/submission_2/points", "5"),
        ("notes.txt", ""),
    ]);
    let (summary, graded) = place.run(collect(Some(POLICY), Export::Auto)).unwrap();
    assert_eq!(
        (summary.n_decisions, &graded[..]),
        (1, &["submission_1", "submission_2"].map(String::from)[..])
    );
    assert_eq!(summary.left_aside.iter().map(|one| &*one.name).collect::<Vec<_>>(), ["notes.txt"]);
    let table = place.text("class.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 5, "{table}");
    let head = "id,name,points,possible,build,student,section,group,handed in,late,deduction,total,\
        standing,";
    assert!(rows[0].starts_with(head), "{table}");
    let ann = "submission_1,'=Ann Lee,10,16,worked,1,A,,2026-10-06 22:00:00 +02:00,22 h 1 \
        min,1,9,graded,";
    assert!(rows[1].starts_with(ann), "{table}");
    assert!(rows[2].starts_with(",Bo Day,,,,2,B,,,,,,nothing handed in,"), "{table}");
    assert!(rows[4].starts_with("submission_2,submission_2,0.005,16,worked,,,,,,,,,"), "{table}");
    let page = place.text("class.html");
    for part in ["To be decided: 1", "Eve, 9: no student has this id", "nothing handed in"] {
        assert!(page.contains(part), "no {part:?} in {page}");
    }
    assert!(place.text("decisions.csv").contains("to be decided,submission_2,,\"Eve, 9: no"));
    let roll: Roll = serde_json::from_str(&place.text(ROLL)).unwrap();
    assert_eq!((roll.members.len(), roll.members[0].total), (3, Some(9_000)));
    let (_, graded) = place.run(collect(Some(POLICY), Export::Gradescope)).unwrap();
    assert_eq!(graded, [""; 0], "nothing changed");
}

#[test]
fn a_folder_that_is_missing_is_noticed() {
    let place = Place::new(&[("submission_metadata.yml", METADATA), ("submission_2/points", "5")]);
    let (summary, _) = place.run(collect(None, Export::Auto)).unwrap();
    assert_eq!(summary.n_decisions, 2);
    let decisions = place.text("decisions.csv");
    assert!(decisions.contains("to be decided,submission_1,1,\"the export names"), "{decisions}");
}

#[test]
fn an_attempt_that_does_not_count_is_not_graded() {
    let place = Place::new(&[
        ("dayb_11_1_hw.zip", "1"),
        ("daybo_12_2_hw.zip", "2"),
        ("daybo_12_3_hw-1.zip", "3"),
        ("daybo_12_4_report.pdf", ""),
    ]);
    let (summary, graded) = place.run(collect(None, Export::Auto)).unwrap();
    assert_eq!(graded, ["dayb_11_1_hw", "daybo_12_3_hw-1"]);
    assert_eq!((summary.n_decisions, summary.exit_code()), (1, 0));
    let roll: Roll = serde_json::from_str(&place.text(ROLL)).unwrap();
    assert_eq!((roll.members[1].standing, roll.members[1].total), (Standing::Graded, Some(3)));
    let decisions = place.text("decisions.csv");
    assert!(decisions.contains("not counted,daybo_12_2_hw.zip,2,a later hand-in"), "{decisions}");
    place.run(None).unwrap();
    assert!(!place.out(ROLL).exists(), "a batch without a roster leaves no roll of an earlier one");
    assert_eq!(place.text("class.csv").lines().count(), 5);
}

#[test]
fn broken_metadata_and_several_exports_are_errors() {
    let broken = Place::new(&[("submission_metadata.yml", "a\n"), ("submission_1/points", "1")]);
    let why = broken.run(collect(None, Export::Auto)).unwrap_err();
    assert!(why.is_usage() && why.to_string().contains("submission_metadata.yml:1:1"), "{why}");
    let several = Place::new(&[
        ("a/submission_metadata.yml", METADATA),
        ("b/submission_metadata.yml", METADATA),
    ]);
    let why = several.run(collect(None, Export::Auto)).unwrap_err();
    assert!(matches!(why, BatchError::Folder { .. }), "{why}");
    let missing = Place::new(&[("submission_1/points", "1")]);
    assert!(missing.run(collect(None, Export::Gradescope)).is_err());
}
