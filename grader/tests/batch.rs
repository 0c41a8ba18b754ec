//! `grader batch` over small programs and an exam of one black picture: killed, interrupted, and started again.

mod shared;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use cases::answer::image_answer_path;
use shared::dark_exam;

/// Programs in the shell that write a PFM picture of 4 × 3 pixels.
const BLACK: &str = "{ printf 'PF\\n4 3\\n-1.0\\n'; head -c 144 /dev/zero; } > \"$3\"";
const WHITE: &str = "{ printf 'PF\\n4 3\\n-1.0\\n'; for n in 1 2 3 4 5 6 7 8 9 10 11 12; do \
    printf '\\000\\000\\200\\077\\000\\000\\200\\077\\000\\000\\200\\077'; done; } > \"$3\"";
const CRASH: &str = "echo oh >&2; exit 7";
const SLOW: &str = "sleep 20";

struct Class {
    place: tempfile::TempDir,
}

impl Class {
    fn new(submissions: &[(&str, &str)]) -> Self {
        let class = Self { place: tempfile::tempdir().unwrap() };
        dark_exam(&class.at("stages"));
        submissions.iter().for_each(|(name, script)| class.hand_in(name, script));
        class
    }

    fn at(&self, path: &str) -> PathBuf {
        self.place.path().join(path)
    }

    fn hand_in(&self, name: &str, script: &str) {
        let folder = self.at("in").join(name);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("submission.toml"), "[run]\ncommand = [\"sh\", \"./tracer.sh\"]\n").unwrap();
        fs::write(folder.join("tracer.sh"), script).unwrap();
    }

    fn start(&self, jobs: &str) -> Child {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.arg("batch").arg(self.at("in")).arg("-o").arg(self.at("out")).arg("--cases").arg(self.at("stages"));
        command.args(["--jobs", jobs]).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    /// Exit code, what was printed, and the lines of progress.
    fn run(&self, jobs: &str) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.start(jobs).wait_with_output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (status.code().unwrap(), text(stdout), text(stderr))
    }

    fn has_record(&self, id: &str) -> bool {
        self.at(&format!("out/records/{id}.json")).exists()
    }

    fn table(&self) -> Vec<String> {
        let text = fs::read_to_string(self.at("out/class.csv")).unwrap();
        text.lines().skip(1).map(|line| line.split(',').take(6).collect::<Vec<_>>().join(" ")).collect()
    }
}

/// Waits for what must come; a minute without it is a failure.
fn wait_for(is_there: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_there() {
        assert!(start.elapsed() < Duration::from_secs(60), "it did not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}

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

    let tables = |class: &Class| ["out/class.csv", "out/class.html"].map(|path| fs::read(class.at(path)).unwrap());
    let before = tables(&class);
    class.hand_in("white", BLACK);
    let (_, printed, lines) = class.run("1");
    assert!(lines.contains("black: 2 of 2 points (unchanged)"), "{lines}");
    assert!(printed.contains("3 of them graded"), "the changed one, and the two that cannot be read: {printed}");
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

fn interrupt(child: &Child) {
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn a_fault_of_ours_costs_nothing_and_is_reported() {
    let class = Class::new(&[("a", BLACK)]);
    let answer = image_answer_path(&class.at("stages"), "01_ray_casting/dark");
    let whole = fs::read(&answer).unwrap();
    fs::write(&answer, "no answer").unwrap();
    let (code, printed, _) = class.run("1");
    assert_eq!(code, 3, "{printed}");
    assert!(printed.contains("1 could not be graded") && printed.contains("  a: 01_ray_casting/dark: "), "{printed}");
    assert!(!class.has_record("a"));
    fs::write(&answer, whole).unwrap();
    assert_eq!(class.run("1").0, 0);
    assert!(class.has_record("a"));
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
