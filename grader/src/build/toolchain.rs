//! The Rust compiler itself, behind the proxy that rustup puts in its place.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A compiler and what it calls itself.
#[derive(Clone, Debug)]
pub struct Toolchain {
    /// Folder of `bin` and `lib`.
    pub sysroot: PathBuf,
    /// What `rustc -vV` prints.
    pub version: String,
}

const HELP: &str = "install Rust from https://rustup.rs, or put it into PATH";

impl Toolchain {
    /// Finds the one that the workspace `root` asks for.
    ///
    /// # Errors
    /// Says how to get one.
    pub fn find(root: &Path) -> Result<Self, String> {
        let sysroot = PathBuf::from(ask(Command::new("rustc")
            .args(["--print", "sysroot"])
            .current_dir(root))?);
        let version = ask(Command::new(sysroot.join("bin/rustc")).arg("-vV").current_dir(root))?;
        Ok(Self { sysroot, version })
    }

    /// The compiler proper.
    pub fn rustc(&self) -> PathBuf {
        self.sysroot.join("bin/rustc")
    }

    /// Its cargo; where the toolchain has none, the one in PATH.
    pub fn cargo(&self) -> PathBuf {
        let own = self.sysroot.join("bin/cargo");
        if own.is_file() { own } else { "cargo".into() }
    }

    /// The first line of its version.
    pub fn name(&self) -> &str {
        self.version.lines().next().unwrap_or_default()
    }
}

fn ask(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|why| match why.kind() {
        ErrorKind::NotFound | ErrorKind::PermissionDenied => {
            format!("the Rust compiler cannot be run ({why}): {HELP}")
        }
        _ => format!("the machine cannot start the Rust compiler: {why}"),
    })?;
    if !output.status.success() {
        return Err(format!(
            "the Rust compiler fails: {}: {HELP}",
            String::from_utf8_lossy(&output.stderr).trim()
        ));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
