//! The setting of a benchmark: its folders, its rounds, and its progress messages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{child, renderers, scenes};
use crate::workspace;

/// The parts that all measurements share.
#[derive(Clone, Debug)]
pub struct Bench {
    /// The folder of the scenes.
    pub scenes: PathBuf,
    /// The folder in which the peers are installed.
    pub peers: PathBuf,
    /// The number of rounds in which everything is measured.
    pub n_rounds: usize,
}

impl Bench {
    /// Builds our own programs, installs the peers, and writes the scenes.
    ///
    /// # Errors
    /// Returns an error if something cannot be built, installed or written.
    pub fn open(n_rounds: usize) -> Result<Self, String> {
        let peers = renderers::peers();
        fs::create_dir_all(&peers).map_err(|why| format!("{}: {why}", peers.display()))?;
        let bench = Self { scenes: peers.join("scenes"), peers, n_rounds };
        bench.say("our own programs");
        let mut build = Command::new("cargo");
        build.args([
            "build",
            "--release",
            "--locked",
            "--quiet",
            "-p",
            "reference",
            "-p",
            "grader",
        ]);
        child::run(build.current_dir(workspace()), &bench.peers)?;
        bench.say("the peers");
        let install = workspace().join("tests/peers/renderers/install.sh");
        child::run(Command::new("bash").arg(install).arg(&bench.peers), &bench.peers)?;
        bench.say("the scenes");
        scenes::write(&bench.scenes)?;
        Ok(bench)
    }

    /// Returns the path of a folder for the pair of a scene and a program. The folder may not
    /// exist.
    pub fn folder(&self, scene: &str, program: &str) -> PathBuf {
        let tame: String = program.chars().filter(char::is_ascii_alphanumeric).collect();
        self.peers.join("work").join(scene).join(tame)
    }

    /// Returns the path of one of our programs in the workspace's release build.
    pub fn program(&self, name: &str) -> PathBuf {
        workspace().join("target/release").join(name)
    }

    /// Prints the current step on the error stream.
    pub fn say(&self, what: &str) {
        eprintln!("{what}");
    }
}

/// Creates the folder `path` if it is missing, and returns it.
///
/// # Errors
/// Returns the error of the file system, with the path.
pub fn made(path: &Path) -> Result<&Path, String> {
    fs::create_dir_all(path).map(|()| path).map_err(|why| format!("{}: {why}", path.display()))
}
