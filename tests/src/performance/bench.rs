//! Where a benchmark works, how often, and whom it tells.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{child, renderers, scenes};
use crate::workspace;

/// What all measurements share.
#[derive(Clone, Debug)]
pub struct Bench {
    /// Where the scenes are.
    pub scenes: PathBuf,
    /// Where the peers are installed.
    pub peers: PathBuf,
    /// How often each is measured.
    pub n_rounds: usize,
}

impl Bench {
    /// Builds our own programs, installs the peers, writes the scenes.
    ///
    /// # Errors
    /// What cannot be built, installed or written.
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

    /// A folder of its own for a scene and a program.
    pub fn folder(&self, scene: &str, program: &str) -> PathBuf {
        let tame: String = program.chars().filter(char::is_ascii_alphanumeric).collect();
        self.peers.join("work").join(scene).join(tame)
    }

    /// A program of ours, as the workspace builds it.
    pub fn program(&self, name: &str) -> PathBuf {
        workspace().join("target/release").join(name)
    }

    /// Tells whoever waits what is being done.
    pub fn say(&self, what: &str) {
        eprintln!("{what}");
    }
}

/// `path` made where it is missing.
///
/// # Errors
/// What the file system says.
pub fn made(path: &Path) -> Result<&Path, String> {
    fs::create_dir_all(path).map(|()| path).map_err(|why| format!("{}: {why}", path.display()))
}
