//! A class of shell scripts, and an exam of black pictures.
#![allow(dead_code)] // Each test file uses a part of this.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::shared::add_dark_case;

/// A script that writes a black PFM picture of 4 × 3 pixels.
pub(crate) const BLACK: &str = "{ printf 'PF\\n4 3\\n-1.0\\n'; head -c 144 /dev/zero; } > \"$3\"";
pub(crate) const WHITE: &str = "{ printf 'PF\\n4 3\\n-1.0\\n'; for n in 1 2 3 4 5 6 7 8 9 10 11 \
    12; do printf '\\000\\000\\200\\077\\000\\000\\200\\077\\000\\000\\200\\077'; done; } > \"$3\"";
pub(crate) const CRASH: &str = "echo oh >&2; exit 7";
pub(crate) const SLOW: &str = "sleep 20";

/// Submissions, an exam, and results.
pub(crate) struct Class {
    place: tempfile::TempDir,
}

impl Class {
    /// Returns a class of submissions, each with its name and script, and an exam of one picture.
    pub(crate) fn new(submissions: &[(&str, &str)]) -> Self {
        let class = Self { place: tempfile::tempdir().unwrap() };
        class.add_case("dark");
        submissions.iter().for_each(|(name, script)| class.hand_in(name, script));
        class
    }

    /// Adds a black picture to the exam.
    pub(crate) fn add_case(&self, name: &str) {
        add_dark_case(&self.at("stages"), name);
    }

    pub(crate) fn at(&self, path: &str) -> PathBuf {
        self.place.path().join(path)
    }

    pub(crate) fn hand_in(&self, name: &str, script: &str) {
        let folder = self.at("in").join(name);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("submission.toml"), "[run]\ncommand = [\"sh\", \"./tracer.sh\"]\n")
            .unwrap();
        fs::write(folder.join("tracer.sh"), script).unwrap();
    }

    pub(crate) fn start(&self, jobs: &str) -> Child {
        self.command(":", &["--jobs", jobs]).spawn().unwrap()
    }

    /// Runs the batch. Returns the exit code, standard output and standard error.
    pub(crate) fn run(&self, jobs: &str) -> (i32, String, String) {
        self.run_under(":", &["--jobs", jobs])
    }

    /// Runs the batch after a line of shell that changes the environment of the grader. Returns the
    /// same as [`Class::run`].
    pub(crate) fn run_under(&self, line: &str, more: &[&str]) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.command(line, more).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (status.code().unwrap(), text(stdout), text(stderr))
    }

    /// Returns the command that grades the class, with `more` arguments, after a line of shell.
    pub(crate) fn command(&self, line: &str, more: &[&str]) -> Command {
        let mut command = Command::new("sh");
        command
            .arg("-c")
            .arg(format!("{line}; exec \"$@\""))
            .arg("sh")
            .arg(env!("CARGO_BIN_EXE_grader"));
        command
            .arg("batch")
            .arg(self.at("in"))
            .arg("-o")
            .arg(self.at("out"))
            .args(["--sandbox", "none", "--cases"])
            .arg(self.at("stages"))
            .env("XDG_STATE_HOME", self.at("state"));
        command.args(more).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn has_record(&self, id: &str) -> bool {
        self.at(&format!("out/records/{id}.json")).exists()
    }

    pub(crate) fn table(&self) -> Vec<String> {
        let text = fs::read_to_string(self.at("out/class.csv")).unwrap();
        text.lines()
            .skip(1)
            .map(|line| line.split(',').take(6).collect::<Vec<_>>().join(" "))
            .collect()
    }
}

/// Waits until `is_there` holds. A minute without that is a failure.
pub(crate) fn wait_for(is_there: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_there() {
        assert!(start.elapsed() < Duration::from_secs(60), "it did not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}
