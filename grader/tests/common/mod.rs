//! Shared by the tests of the command line: a folder with submissions, and calls of the program.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Returns the exam of three flat colours, which small programs can get right.
pub(crate) fn exam() -> PathBuf {
    repository().join("tests/exam")
}

/// Returns the root of the repository.
pub(crate) fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns a call of the program in `folder`, without input and with both output streams captured.
pub(crate) fn grader(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.current_dir(folder).args(args).env_remove("CLICOLOR_FORCE").env("NO_COLOR", "1");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Returns everything that a call printed, standard output first.
pub(crate) fn printed(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Puts a submission into `folder/name` that is built by `build`, if that is not empty, and run by
/// `run`, both by the shell.
pub(crate) fn hand_in(folder: &Path, name: &str, build: &str, run: &str) {
    let home = folder.join(name);
    fs::create_dir_all(&home).unwrap();
    let mut manifest = "[run]\ncommand = [\"sh\", \"./run.sh\"]\n".to_owned();
    if !build.is_empty() {
        manifest += "[build]\ncommand = [\"sh\", \"./build.sh\"]\n";
    }
    fs::write(home.join("submission.toml"), manifest).unwrap();
    fs::write(home.join("build.sh"), build).unwrap();
    fs::write(home.join("run.sh"), run).unwrap();
}
