//! Finds everything that building needs: the workspace, the template, the compiler and the compiled
//! crates.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::error::Fault;
use super::sdk::{Sdk, SdkError};
use super::toolchain::Toolchain;
use crate::submission::Template;

/// Everything that building needs, found once and shared by all submissions.
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
    /// Fails if there is no workspace. The text says what is missing.
    pub fn open(stages: &Path) -> Result<Self, String> {
        let here = std::env::current_dir().unwrap_or_default();
        let binary = std::env::current_exe().unwrap_or_default();
        let stages = stages.canonicalize().unwrap_or_default();
        let root = [stages.as_path(), &binary, &here].into_iter().find_map(root_above).ok_or(
            "the workspace of the assignment (with `student_template` and `cases`) is not above \
             the cases, the grader's binary, or the current folder: run from within it",
        )?;
        Ok(Self {
            root,
            template: Template::carried(),
            toolchain: OnceLock::new(),
            sdk: OnceLock::new(),
        })
    }

    /// Returns the folder in which compiled libraries and programs are kept between runs.
    pub fn store(&self) -> PathBuf {
        self.root.join("target/grader")
    }

    /// Returns the compiler.
    ///
    /// # Errors
    /// Fails if there is no compiler that runs. The text says how to get one.
    pub fn toolchain(&self) -> Result<&Toolchain, Fault> {
        let found = self.toolchain.get_or_init(|| Toolchain::find(&self.root));
        found.as_ref().map_err(|why| Fault::Other(why.clone()))
    }

    /// Returns the compiled crates that student code is linked with. The first call makes them,
    /// which takes a while.
    ///
    /// # Errors
    /// Fails if the crates do not build, or if the store cannot be used. Later calls return the
    /// same error.
    pub fn sdk(&self, progress: &dyn Fn(&str)) -> Result<&Sdk, Fault> {
        let prepare = || {
            let toolchain = self.toolchain().map_err(|why| SdkError::Toolchain(why.to_string()))?;
            Sdk::prepare(
                toolchain,
                &self.root,
                &self.store(),
                &self.template.dependencies,
                progress,
            )
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
