//! Finds the Rust compiler itself, behind the proxy of rustup.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A compiler and its version.
#[derive(Clone, Debug)]
pub struct Toolchain {
    /// The folder of `bin` and `lib`.
    pub sysroot: PathBuf,
    /// The output of `rustc -vV`.
    pub version: String,
}

/// The reason why there is no compiler.
#[derive(Debug, thiserror::Error)]
pub enum ToolchainError {
    /// There is no compiler that this user may run.
    #[error(
        "the Rust compiler cannot be run (install it from https://rustup.rs, or put it into PATH)"
    )]
    Missing(#[source] io::Error),
    /// The machine cannot start the compiler.
    #[error("the machine cannot start the Rust compiler")]
    NotStarted(#[source] io::Error),
    /// The compiler ended with an error. The text is its own.
    #[error(
        "the Rust compiler fails (install it from https://rustup.rs, or put it into PATH): {0}"
    )]
    Failed(String),
}

impl Toolchain {
    /// Finds the toolchain that the workspace at `root` selects.
    ///
    /// # Errors
    /// Fails if there is no compiler that runs.
    pub fn find(root: &Path) -> Result<Self, ToolchainError> {
        let sysroot = PathBuf::from(run(Command::new("rustc")
            .args(["--print", "sysroot"])
            .current_dir(root))?);
        let version = run(Command::new(sysroot.join("bin/rustc")).arg("-vV").current_dir(root))?;
        Ok(Self { sysroot, version })
    }

    /// Returns the path of the compiler.
    pub fn rustc(&self) -> PathBuf {
        self.sysroot.join("bin/rustc")
    }

    /// Returns the path of the toolchain's cargo, or `cargo` from PATH if it has none.
    pub fn cargo(&self) -> PathBuf {
        let own = self.sysroot.join("bin/cargo");
        if own.is_file() { own } else { "cargo".into() }
    }

    /// Returns the first line of the version.
    pub fn name(&self) -> &str {
        self.version.lines().next().unwrap_or_default()
    }
}

fn run(command: &mut Command) -> Result<String, ToolchainError> {
    let output = command.output().map_err(|why| match why.kind() {
        ErrorKind::NotFound | ErrorKind::PermissionDenied => ToolchainError::Missing(why),
        _ => ToolchainError::NotStarted(why),
    })?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
        return Err(ToolchainError::Failed(said));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
