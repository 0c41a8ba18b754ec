//! What building needs: the workspace, the template, the compiler and the compiled crates.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::error::Fault;
use super::sdk::{Sdk, SdkError};
use super::toolchain::Toolchain;
use crate::submission::Template;

/// What building needs, found once and shared by all submissions.
#[derive(Debug)]
pub struct Workshop {
    /// The workspace of the assignment.
    pub root: PathBuf,
    /// The assignment as it is handed out.
    pub template: Template,
    toolchain: OnceLock<Result<Toolchain, String>>,
    sdk: OnceLock<Result<Sdk, SdkError>>,
}

impl Workshop {
    /// Finds the workspace from a folder of cases, from the running binary, or from the current
    /// folder.
    ///
    /// # Errors
    /// Says what is missing.
    pub fn open(stages: &Path) -> Result<Self, String> {
        let here = std::env::current_dir().unwrap_or_default();
        let binary = std::env::current_exe().unwrap_or_default();
        let stages = stages.canonicalize().unwrap_or_default();
        let root = [stages.as_path(), &binary, &here].into_iter().find_map(root_above).ok_or(
            "the workspace of the assignment (with `student_template` and `cases`) is not above \
                the \
             cases, the grader's binary, or the current folder: run from within it",
        )?;
        Ok(Self {
            root,
            template: Template::carried(),
            toolchain: OnceLock::new(),
            sdk: OnceLock::new(),
        })
    }

    /// Returns the folder where prepared things are stored between runs.
    pub fn store(&self) -> PathBuf {
        self.root.join("target/grader")
    }

    /// Returns the compiler.
    ///
    /// # Errors
    /// Says how to get one.
    pub fn toolchain(&self) -> Result<&Toolchain, Fault> {
        let found = self.toolchain.get_or_init(|| Toolchain::find(&self.root));
        found.as_ref().map_err(|why| Fault::Other(why.clone()))
    }

    /// Returns the compiled crates that student code is linked with. The first call makes them,
    /// which takes a while.
    ///
    /// # Errors
    /// What cargo says, and a store that cannot be used. The error stays the same while this
    /// process runs.
    pub fn sdk(&self, tell: &dyn Fn(&str)) -> Result<&Sdk, Fault> {
        let prepare = || {
            let toolchain = self.toolchain().map_err(|why| SdkError::Toolchain(why.to_string()))?;
            Sdk::prepare(toolchain, &self.root, &self.store(), &self.template.dependencies, tell)
        };
        self.sdk.get_or_init(prepare).as_ref().map_err(|why| Fault::Other(why.to_string()))
    }
}

/// Returns the nearest folder above `path` that holds the template and the cases.
fn root_above(path: &Path) -> Option<PathBuf> {
    let is_root = |folder: &&Path| {
        ["Cargo.lock", "cases/Cargo.toml", "student_template/Cargo.toml"]
            .iter()
            .all(|name| folder.join(name).is_file())
    };
    path.ancestors().find(is_root).map(Path::to_owned)
}
