//! A class of made-up submissions: what is graded when, and that nothing but the submissions
//! decides the tables.

mod sealed;

use std::collections::BTreeMap;
use std::fs;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::grade::GradeError;
use crate::graded::Graded;
use crate::record::{Finding, FindingKind, Record, Verdict};
use crate::report::sample;

/// A grader that reads the score of a folder from its file `points`. It records the names, and may
/// stop or fail on the way.
struct Fake {
    epoch: &'static str,
    /// Number of submissions after which it stops.
    most: usize,
    n_begun: AtomicUsize,
    graded: Mutex<Vec<String>>,
}

impl Fake {
    fn new(epoch: &'static str, most: usize) -> Self {
        Self { epoch, most, n_begun: AtomicUsize::new(0), graded: Mutex::default() }
    }

    /// Returns the names of the submissions that it has graded to the end, sorted.
    fn graded(&self) -> Vec<String> {
        let mut graded = self.graded.lock().unwrap().clone();
        graded.sort();
        graded
    }
}

impl Grader for Fake {
    fn epoch(&self) -> &str {
        self.epoch
    }

    fn read(&self, submission: &Path) -> Option<Read> {
        let text = fs::read(submission.join("points")).ok()?;
        let digest = blake3::hash(&text).to_hex().to_string();
        let source = fs::read_to_string(submission.join("source")).unwrap_or_default();
        Some(Read { digest, sketch: Sketch::new([&*source], &Sketch::default()) })
    }

    fn grade(&self, submission: &Submission) -> Result<Graded, GradeError> {
        self.n_begun.fetch_add(1, Ordering::Relaxed);
        let text = fs::read_to_string(submission.path.join("points")).unwrap_or_default();
        let mut graded = sample::graded(&submission.name);
        let record = &mut graded.record;
        record.epoch = self.epoch.to_owned();
        record.submission.digest = self.read(&submission.path).unwrap_or_default().digest;
        if let Ok(title) = fs::read_to_string(submission.path.join("title")) {
            record.stages[0].title = format!("title: {title}");
        }
        let ours = |message: &str| Finding {
            message: message.to_owned(),
            ..sample::finding(FindingKind::Internal)
        };
        match text.as_str() {
            "machine" => return Err(GradeError::Output(std::io::Error::other("the disk is full"))),
            "panic" => panic!("a fault in the grader"),
            "ours" => record.stages[0].checks[0].verdict = Verdict::Ours,
            "internal" => {
                record.stages[0].checks[0].finding = Some(ours("no memory for the judge"))
            }
            points => record.score.earned = points.parse().unwrap_or(0),
        }
        self.graded.lock().unwrap().push(submission.name.clone());
        Ok(graded)
    }

    fn is_stopped(&self) -> bool {
        self.n_begun.load(Ordering::Relaxed) > self.most
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

/// A folder of submissions, each with its `points`.
struct Class {
    place: tempfile::TempDir,
}

impl Class {
    fn new(submissions: &[(&str, &str)]) -> Self {
        let class = Self { place: tempfile::tempdir().unwrap() };
        submissions.iter().for_each(|(name, points)| class.hand_in(name, points));
        class
    }

    fn hand_in(&self, name: &str, points: &str) {
        let folder = self.place.path().join("in").join(name);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("points"), points).unwrap();
    }

    fn out(&self, path: &str) -> PathBuf {
        self.place.path().join("out").join(path)
    }

    fn run(&self, grader: &Fake, jobs: usize) -> Summary {
        let key = Key::open(&self.place.path().join("key")).unwrap();
        let options = Options {
            folder: self.place.path().join("in"),
            out: self.out(""),
            jobs,
            key,
            collect: None,
        };
        run(grader, &options, &Silent).unwrap()
    }

    /// Returns all files for people, by path.
    fn shown(&self) -> BTreeMap<String, Vec<u8>> {
        let mut paths = vec![self.out("alike.csv"), self.out("class.csv"), self.out("class.html")];
        paths.extend(
            ["records", "reports"]
                .iter()
                .flat_map(|folder| files::below(&self.out(folder)).unwrap()),
        );
        let name = |path: &PathBuf| path.strip_prefix(self.out("")).unwrap().display().to_string();
        paths.iter().map(|path| (name(path), fs::read(path).unwrap())).collect()
    }
}

const THREE: [(&str, &str); 3] = [("alice", "1000"), ("bob", "2000"), ("carol", "14000")];
const ALL: usize = usize::MAX;

#[test]
fn each_submission_gets_a_record_a_report_and_a_row() {
    let class = Class::new(&THREE);
    let summary = class.run(&Fake::new("1", ALL), 2);
    assert_eq!((summary.n_done, summary.n_graded, summary.exit_code()), (3, 3, 0));
    let names: Vec<String> = class.shown().into_keys().collect();
    let files = ["alice", "bob", "carol"];
    let expected = files.map(|id| format!("records/{id}.json")).into_iter();
    let expected = expected.chain(files.map(|id| format!("reports/{id}.html")));
    assert_eq!(
        names,
        ["alike.csv", "class.csv", "class.html"]
            .map(str::to_owned)
            .into_iter()
            .chain(expected)
            .collect::<Vec<_>>()
    );
    let record: Record =
        serde_json::from_slice(&fs::read(class.out("records/bob.json")).unwrap()).unwrap();
    assert_eq!((record.submission.path.as_str(), record.score.earned), ("bob", 2000));
}

#[test]
fn what_is_unchanged_is_not_graded_twice() {
    let class = Class::new(&THREE);
    class.run(&Fake::new("1", ALL), 2);
    let before = class.shown();
    let again = Fake::new("1", ALL);
    let summary = class.run(&again, 2);
    assert_eq!(again.graded(), [""; 0]);
    assert_eq!((summary.n_done, summary.n_graded), (3, 0));
    assert_eq!(class.shown(), before);
}

#[test]
fn a_changed_submission_is_graded_again() {
    let class = Class::new(&THREE);
    class.run(&Fake::new("1", ALL), 1);
    class.hand_in("bob", "3000");
    class.hand_in("dave", "1");
    let again = Fake::new("1", ALL);
    class.run(&again, 1);
    assert_eq!(again.graded(), ["bob", "dave"]);
    assert!(fs::read_to_string(class.out("class.csv")).unwrap().contains("bob,bob,3,"));
}

#[test]
fn what_cannot_be_read_is_looked_at_every_time() {
    let class = Class::new(&[]);
    let folder = class.place.path().join("in/alice");
    fs::create_dir_all(&folder).unwrap();
    for title in ["one", "two"] {
        fs::write(folder.join("title"), title).unwrap();
        let grader = Fake::new("1", ALL);
        class.run(&grader, 1);
        assert_eq!(grader.graded(), ["alice"]);
        for path in ["records/alice.json", "reports/alice.html"] {
            let text = fs::read_to_string(class.out(path)).unwrap();
            assert!(text.contains(&format!("title: {title}")), "{path} is of an earlier run");
        }
    }
}

#[test]
fn another_epoch_grades_all_again() {
    let class = Class::new(&THREE);
    class.run(&Fake::new("1", ALL), 1);
    let again = Fake::new("2", ALL);
    class.run(&again, 1);
    assert_eq!(again.graded().len(), 3);
    let back = Fake::new("1", ALL);
    class.run(&back, 1);
    assert_eq!(back.graded(), [""; 0], "results of an earlier epoch are kept");
}

#[test]
fn a_run_that_was_stopped_goes_on_where_it_was() {
    let class = Class::new(&[("a", "1"), ("b", "2"), ("c", "3"), ("d", "4"), ("e", "5")]);
    let first = Fake::new("1", 2);
    let summary = class.run(&first, 1);
    assert_eq!((summary.n_done, summary.n_left, summary.exit_code()), (2, 3, 130));
    assert!(!class.out("class.csv").exists(), "no table without all rows");
    let second = Fake::new("1", ALL);
    let summary = class.run(&second, 1);
    assert_eq!((summary.n_done, summary.n_graded, summary.exit_code()), (5, 3, 0));
    assert_eq!(second.graded(), ["c", "d", "e"]);
}

#[test]
fn what_a_kill_leaves_behind_does_no_harm() {
    let class = Class::new(&THREE);
    class.run(&Fake::new("1", ALL), 1);
    let before = class.shown();
    // The run was killed between the two files of a folder, in the middle of a file, and before the
    // names for people were given.
    let results: Vec<PathBuf> = files::below(&class.out("results")).unwrap();
    fs::remove_file(results.iter().find(|path| path.ends_with("report.html")).unwrap()).unwrap();
    let broken = results.iter().rfind(|path| path.ends_with("record.json")).unwrap();
    fs::write(broken, &fs::read(broken).unwrap()[..100]).unwrap();
    fs::create_dir(class.out("results/.part-x")).unwrap();
    fs::write(class.out("results/.part-x/record.json"), "{").unwrap();
    fs::remove_dir_all(class.out("reports")).unwrap();
    let again = Fake::new("1", ALL);
    class.run(&again, 1);
    assert_eq!(again.graded().len(), 2, "the two that were broken");
    assert_eq!(class.shown(), before);
}

#[test]
fn what_killed_the_grader_comes_last_and_not_for_ever() {
    let class = Class::new(&THREE);
    // A run died while it graded alice and bob, and another one while it graded bob alone.
    let die = |files: &[(&str, &str)]| {
        let part = class.out(&format!(".part-{}", files.len()));
        fs::create_dir_all(&part).unwrap();
        files.iter().for_each(|(name, n)| fs::write(part.join(name), n).unwrap());
    };
    let order = |grader: &Fake| grader.graded.lock().unwrap().clone();
    die(&[("alice.doing", ""), ("bob.doing", "")]);
    let grader = Fake::new("1", ALL);
    assert_eq!(class.run(&grader, 1).exit_code(), 0);
    assert_eq!(order(&grader), ["carol", "alice", "bob"]);
    die(&[("bob.doing", "")]);
    let grader = Fake::new("2", ALL);
    assert_eq!(class.run(&grader, 1).exit_code(), 0);
    assert_eq!(order(&grader), ["alice", "carol", "bob"]);
    die(&[("bob.doing", ""), ("bob.suspect", "1")]);
    let grader = Fake::new("3", ALL);
    let summary = class.run(&grader, 1);
    assert_eq!((summary.exit_code(), summary.failed.len()), (3, 1));
    assert!(summary.failed[0].1.contains("died 2 times"), "{:?}", summary.failed);
    assert_eq!(order(&grader), ["alice", "carol"]);
    let grader = Fake::new("3", ALL);
    assert_eq!(class.run(&grader, 1).exit_code(), 0);
    assert_eq!(order(&grader), ["bob"], "the next run tries again");
}

#[test]
fn what_is_our_fault_is_reported_and_never_published() {
    let class = Class::new(&[
        ("a", "machine"),
        ("b", "ours"),
        ("c", "internal"),
        ("d", "panic"),
        ("e", "5000"),
    ]);
    let summary = class.run(&Fake::new("1", ALL), 2);
    assert_eq!((summary.n_done, summary.failed.len(), summary.exit_code()), (1, 4, 3));
    assert!(summary.failed[0].1.contains("the disk is full"), "{:?}", summary.failed);
    assert!(summary.failed[2].1.contains("no memory for the judge"), "{:?}", summary.failed);
    assert_eq!(fs::read_dir(class.out("results")).unwrap().count(), 1);
    assert_eq!(fs::read_dir(class.out("records")).unwrap().count(), 1);
    let table = fs::read_to_string(class.out("class.csv")).unwrap();
    assert!(table.contains("a,a,,,not graded"), "{table}");
    class.hand_in("a", "1000");
    let again = Fake::new("1", ALL);
    assert_eq!(class.run(&again, 1).failed.len(), 3);
    assert_eq!(again.graded(), ["a", "b", "c"], "all that failed are tried again");
}

#[test]
fn the_number_of_jobs_changes_no_byte() {
    let names: Vec<String> = (0..8).map(|n| format!("student {n}")).collect();
    let submissions: Vec<(&str, &str)> = names.iter().map(|name| (&**name, "1000")).collect();
    let (one, many) = (Class::new(&submissions), Class::new(&submissions));
    one.run(&Fake::new("1", ALL), 1);
    many.run(&Fake::new("1", ALL), 7);
    assert_eq!(one.shown(), many.shown());
}

#[test]
fn names_become_ids_that_are_safe_and_differ() {
    let odd = ["a b", "ALICE", "alice", "<script>", "..", "-rf", "zoë", "é".repeat(100).leak()];
    let class = Class::new(&odd.map(|name| (if name == ".." { "dots.." } else { name }, "1")));
    fs::write(class.place.path().join("in/dave.zip"), "").unwrap();
    class.hand_in("dave", "1");
    let (found, _) =
        submissions::list(&class.place.path().join("in"), Path::new("/nowhere")).unwrap();
    assert_eq!(found.len(), 10);
    let mut ids: Vec<String> = found.iter().map(|one| one.id.to_lowercase()).collect();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), 10, "{ids:?}");
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "._-~".contains(c);
    for id in &ids {
        assert!(id.chars().all(is_safe) && !id.starts_with(['.', '-']) && id.len() < 100, "{id}");
    }
    assert_eq!(found.iter().filter(|one| one.name == "dave").count(), 2);
    assert_eq!(class.run(&Fake::new("1", ALL), 2).n_done, 10);
}

#[test]
fn what_is_no_submission_is_left_aside_and_named() {
    let class = Class::new(&[("alice", "1")]);
    let folder = class.place.path().join("in");
    fs::write(folder.join("grades.txt"), "").unwrap();
    fs::write(folder.join("grades.csv"), "").unwrap();
    fs::write(folder.join("notes"), "PK is a pair of letters").unwrap();
    fs::write(folder.join(".DS_Store"), "").unwrap();
    std::os::unix::fs::symlink("/etc", folder.join("eve")).unwrap();
    fs::create_dir(folder.join("out")).unwrap();
    let (found, left) = submissions::list(&folder, &folder.join("out")).unwrap();
    assert_eq!(found.iter().map(|one| &*one.id).collect::<Vec<_>>(), ["alice"]);
    assert_eq!(
        left.iter().map(|one| &*one.name).collect::<Vec<_>>(),
        [".DS_Store", "eve", "grades.csv", "grades.txt", "notes"]
    );
}

#[test]
fn what_somebody_handed_in_has_a_row_whatever_it_is() {
    let class = Class::new(&[("alice", "1")]);
    let folder = class.place.path().join("in");
    for name in ["bob.7z", "carol.rar", "dave.tar", "erin.tar.xz", "frank.pdf", "main.rs"] {
        fs::write(folder.join(name), "").unwrap();
    }
    fs::write(folder.join("grace"), "PK\x03\x04").unwrap();
    let (found, left) = submissions::list(&folder, Path::new("/nowhere")).unwrap();
    let names: Vec<&str> = found.iter().map(|one| &*one.name).collect();
    assert_eq!(names, ["alice", "bob", "carol", "dave", "erin", "frank.pdf", "grace", "main.rs"]);
    assert_eq!(left, []);
}

#[test]
fn an_empty_or_missing_folder_is_an_error() {
    let place = tempfile::tempdir().unwrap();
    let at = |folder: &str| Options {
        folder: place.path().join(folder),
        out: place.path().join("out"),
        jobs: 1,
        key: Key::open(&place.path().join("key")).unwrap(),
        collect: None,
    };
    fs::create_dir(place.path().join("in")).unwrap();
    assert!(matches!(run(&Fake::new("1", ALL), &at("in"), &Silent), Err(BatchError::Empty(_))));
    assert!(matches!(
        run(&Fake::new("1", ALL), &at("missing"), &Silent),
        Err(BatchError::Folder { .. })
    ));
}
