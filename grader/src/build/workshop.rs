//! Finds everything that building needs: the workspace, the template, the compiler and the compiled
//! crates.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use super::error::Fault;
use super::sdk::{Sdk, SdkError};
use super::toolchain::{Toolchain, ToolchainError};
use crate::sandbox::{self, Layers};
use crate::submission::Template;

/// Everything that building needs, found once and shared by all submissions.
#[derive(Debug)]
pub struct Workshop {
    /// The workspace of the assignment.
    pub root: PathBuf,
    /// The assignment as it is handed out.
    pub template: Template,
    /// The layers of protection around compilers and programs: at first those that this machine
    /// has.
    pub layers: Layers,
    toolchain: OnceLock<Result<Toolchain, Arc<ToolchainError>>>,
    sdk: OnceLock<Result<Sdk, Arc<SdkError>>>,
}

/// The workspace of the assignment was not found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the workspace of the assignment (with `student_template` and `cases`) is not above the cases, \
     the grader's binary, or the current folder: run from within it"
)]
pub struct NoWorkspace;

impl Workshop {
    /// Finds the workspace from a folder of cases, from the running binary, or from the current
    /// folder.
    ///
    /// # Errors
    /// Fails if there is no workspace in any of these places.
    pub fn open(stages: &Path) -> Result<Self, NoWorkspace> {
        let here = std::env::current_dir().unwrap_or_default();
        let binary = std::env::current_exe().unwrap_or_default();
        let stages = stages.canonicalize().unwrap_or_default();
        let places = [stages.as_path(), &binary, &here];
        let root = places.into_iter().find_map(root_above).ok_or(NoWorkspace)?;
        Ok(Self {
            root,
            template: Template::carried(),
            layers: sandbox::available().layers,
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
    /// Fails if there is no compiler that runs. Later calls return the same error.
    pub fn toolchain(&self) -> Result<&Toolchain, Fault> {
        Ok(self.found()?)
    }

    fn found(&self) -> Result<&Toolchain, Arc<ToolchainError>> {
        let find = || Toolchain::find(&self.root).map_err(Arc::new);
        self.toolchain.get_or_init(find).as_ref().map_err(Arc::clone)
    }

    /// Returns the compiled crates that student code is linked with. The first call makes them,
    /// which takes a while.
    ///
    /// # Errors
    /// Fails if the crates do not build, or if the store cannot be used. Later calls return the
    /// same error.
    pub fn sdk(&self, progress: &dyn Fn(&str)) -> Result<&Sdk, Fault> {
        let prepare = || {
            let (store, dependencies) = (self.store(), &self.template.dependencies);
            Sdk::prepare(self.found()?, &self.root, &store, dependencies, progress)
        };
        let prepared = self.sdk.get_or_init(|| prepare().map_err(Arc::new));
        prepared.as_ref().map_err(|why| Fault::Sdk(Arc::clone(why)))
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
