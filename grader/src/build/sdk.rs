//! The crates that student code is linked with, compiled once for one compiler, one lock file and
//! one state of `cases`.
//!
//! An entry `sdk-KEY` of the store holds the libraries, and says which of them the student's code
//! may name. With these, a submission is built by one call of rustc: no cargo, no lock, and no way
//! for a `build.rs` or a manifest to take part.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

use serde::Deserialize;

use super::entry::{self, Entry, StoreError};
use super::toolchain::{Toolchain, ToolchainError};
use crate::files;
use crate::leftovers::Held;

/// The compiled crates, which were as they were stored when this process took them.
#[derive(Clone, Debug)]
pub struct Sdk {
    /// The libraries, and the file names of those that student code may name, by crate.
    entry: Entry<BTreeMap<String, String>>,
    /// A hash of everything that went into the crates.
    pub key: String,
}

/// The reason why there are no compiled crates. The grader or the machine is to blame.
#[derive(Debug, thiserror::Error)]
pub enum SdkError {
    /// There is no compiler.
    #[error(transparent)]
    Toolchain(#[from] Arc<ToolchainError>),
    /// The sources of the crates cannot be read.
    #[error("the sources of `cases` cannot be used")]
    Sources(#[source] io::Error),
    /// The folder of the build cannot be made.
    #[error("the build of `cases` cannot be prepared")]
    Folder(#[source] io::Error),
    /// Cargo cannot be started.
    #[error("cargo cannot be run")]
    Cargo(#[source] io::Error),
    /// The crates do not build. The text is the compiler's.
    #[error("`cases` does not build:\n{0}")]
    Compiler(String),
    /// The template has a dependency that is not among the compiled crates.
    #[error("the template depends on `{0}`, which is neither `cases` nor one of its dependencies")]
    Dependency(String),
    /// The entry is not in the store after it was published.
    #[error("{} is not there after it was stored", .0.display())]
    Lost(PathBuf),
    /// The entry of the store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// The arguments of cargo for the build, which are part of the key.
const ARGS: [&str; 5] =
    ["build", "--release", "-p", "sdk", "--message-format=json-render-diagnostics"];

/// The manifest of a package that re-exports `cases`. Its other dependencies are those of `cases`,
/// with the features that they have in the grader's build.
///
/// Cargo uses a crate that it compiled for the grader again only if the features are the same, and
/// there other crates enable more of them. Without these dependencies, two thirds of the crates are
/// compiled a second time, which doubles the time of this build. A feature that is missing here
/// costs only time.
const MANIFEST: &str = r#"
[package]
name = "sdk"
edition = "2024"

[dependencies]
cases.workspace = true
bitflags = { version = "*", features = ["std"] }
flate2 = { version = "*", features = ["zlib-rs"] }
memchr = "*"
miniz_oxide = "*"
serde_core = "*"

[build-dependencies]
syn = { version = "3", features = ["full"] }
"#;

impl Sdk {
    /// Takes the crates from `store`, or compiles them from the workspace at `root`. Student code
    /// may name the crates `dependencies`.
    pub(super) fn prepare(
        toolchain: &Toolchain,
        root: &Path,
        store: &Path,
        dependencies: &[String],
        progress: &dyn Fn(&str),
    ) -> Result<Self, SdkError> {
        let key = key(toolchain, root, dependencies).map_err(SdkError::Sources)?;
        let folder = store.join(format!("sdk-{key}"));
        // Leftovers of a killed run do no harm, so a store that cannot be cleared is no reason to
        // stop.
        let _ = files::clear_parts(store);
        if let Some(entry) = Entry::take(&folder)? {
            return Ok(Self { entry, key });
        }
        progress("compiling the crates that submissions use (once, a minute or so)");
        let alone = alone(root, store).map_err(SdkError::Folder)?;
        let artifacts = compile(toolchain, root, alone.path())?;
        publish(&artifacts, dependencies, &folder)?;
        Ok(Self { entry: Entry::take(&folder)?.ok_or(SdkError::Lost(folder))?, key })
    }

    #[cfg(test)]
    pub(super) fn of_entry(entry: Entry<BTreeMap<String, String>>) -> Self {
        Self { entry, key: String::new() }
    }

    /// Returns the folder of the libraries.
    pub(super) fn folder(&self) -> &Path {
        &self.entry.folder
    }

    /// Returns the libraries that student code may name, by crate.
    pub(super) fn externs(&self) -> impl Iterator<Item = (&String, PathBuf)> {
        self.entry.about.iter().map(|(name, file)| (name, self.entry.folder.join(file)))
    }

    /// Compares the libraries with what was stored.
    ///
    /// # Errors
    /// Fails if a library was changed, and then removes all of them, or if the machine cannot read
    /// one.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        self.entry.check()
    }
}

fn key(toolchain: &Toolchain, root: &Path, dependencies: &[String]) -> io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&entry::VERSION.to_le_bytes()).update(toolchain.version.as_bytes());
    hasher.update(format!("{ARGS:?}{MANIFEST}{dependencies:?}").as_bytes());
    hasher.update(manifest(root)?.as_bytes());
    for file in ["Cargo.lock", "cases/Cargo.toml"] {
        hasher.update(&std::fs::read(root.join(file))?);
    }
    for file in files::below(&root.join("cases/src"))? {
        let name = file.strip_prefix(root).unwrap_or(&file);
        hasher.update(name.as_os_str().as_encoded_bytes()).update(&std::fs::read(&file)?);
    }
    Ok(hasher.finalize().to_hex()[..32].to_owned())
}

/// Creates a workspace of `cases` and the package of [`MANIFEST`], in `store`, with the versions
/// that the whole workspace has locked.
///
/// The template is a member of the whole workspace. A dependency that a student adds to it, or a
/// mistake in its manifest, would keep cargo from building anything there.
fn alone(root: &Path, store: &Path) -> io::Result<Held> {
    std::fs::create_dir_all(store)?;
    let folder = Held::new(store, files::PARTS)?;
    std::fs::write(folder.path().join("Cargo.toml"), manifest(root)?)?;
    std::fs::copy(root.join("Cargo.lock"), folder.path().join("Cargo.lock"))?;
    std::os::unix::fs::symlink(root.join("cases"), folder.path().join("cases"))?;
    let sdk = folder.path().join("sdk");
    std::fs::create_dir_all(sdk.join("src"))?;
    std::fs::write(sdk.join("Cargo.toml"), MANIFEST)?;
    std::fs::write(sdk.join("src/lib.rs"), "pub use cases;")?;
    Ok(folder)
}

/// Returns the manifest of the workspace at `root` with `cases` and the package of
/// [`MANIFEST`] as its only members.
fn manifest(root: &Path) -> io::Result<String> {
    let wrong =
        |why: String| io::Error::new(io::ErrorKind::InvalidData, format!("Cargo.toml: {why}"));
    let text = std::fs::read_to_string(root.join("Cargo.toml"))?;
    let mut table: toml::Table =
        text.parse().map_err(|why: toml::de::Error| wrong(why.to_string()))?;
    let workspace = table.get_mut("workspace").and_then(toml::Value::as_table_mut);
    let workspace = workspace.ok_or_else(|| wrong("there is no workspace in it".to_owned()))?;
    workspace.insert("members".to_owned(), toml::Value::from(vec!["cases", "sdk"]));
    // Most of the packages that have a profile of their own are not here, and cargo would warn of
    // each of them.
    let profiles = table.get_mut("profile").and_then(toml::Value::as_table_mut);
    for (_, profile) in profiles.into_iter().flatten() {
        if let Some(packages) = profile.get_mut("package").and_then(toml::Value::as_table_mut) {
            packages.retain(|name, _| name == "*");
        }
    }
    toml::to_string(&table).map_err(|why| wrong(why.to_string()))
}

/// A library that cargo has made, or found fresh.
struct Artifact {
    crate_name: String,
    file: PathBuf,
}

#[derive(Deserialize)]
struct Message {
    reason: String,
    target: Option<Target>,
    #[serde(default)]
    filenames: Vec<PathBuf>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
}

/// Builds the workspace in `alone` without the network if possible, else with it.
///
/// Crates that the workspace at `root` has already compiled are reused.
fn compile(toolchain: &Toolchain, root: &Path, alone: &Path) -> Result<Vec<Artifact>, SdkError> {
    let run = |more: &[&str]| -> Result<Output, SdkError> {
        let mut cargo = Command::new(toolchain.cargo());
        cargo.args(ARGS).args(more).arg("--target-dir").arg(root.join("target")).current_dir(alone);
        cargo.env("RUSTC", toolchain.rustc()).env_remove("RUSTFLAGS");
        cargo.output().map_err(SdkError::Cargo)
    };
    let mut output = run(&["--offline"])?;
    if !output.status.success() {
        output = run(&[])?;
    }
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
        return Err(SdkError::Compiler(said));
    }
    let messages = output
        .stdout
        .split(|byte| *byte == b'\n')
        .filter_map(|line| serde_json::from_slice(line).ok());
    Ok(messages.flat_map(libraries).collect())
}

fn libraries(message: Message) -> Vec<Artifact> {
    let Some(target) = message.target.filter(|_| message.reason == "compiler-artifact") else {
        return vec![];
    };
    let is_library = |file: &PathBuf| {
        file.extension().is_some_and(|end| end == "rlib" || end == "so" || end == "dylib")
    };
    let artifact = |file| Artifact { crate_name: target.name.replace('-', "_"), file };
    message.filenames.into_iter().filter(is_library).map(artifact).collect()
}

/// Stores the libraries, with the names of those that the template depends on.
fn publish(artifacts: &[Artifact], dependencies: &[String], folder: &Path) -> Result<(), SdkError> {
    let mut externs = BTreeMap::new();
    for name in dependencies {
        let name = name.replace('-', "_");
        let Some(found) = artifacts.iter().find(|artifact| artifact.crate_name == name) else {
            return Err(SdkError::Dependency(name));
        };
        let file = found.file.file_name().unwrap_or_default();
        externs.insert(name, file.to_string_lossy().into_owned());
    }
    entry::publish(folder, &externs, |fresh| {
        for artifact in artifacts {
            std::fs::copy(
                &artifact.file,
                fresh.join(artifact.file.file_name().unwrap_or_default()),
            )?;
        }
        Ok(())
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A package that is not locked would be fetched from the network, and by any version.
    #[test]
    fn all_packages_of_the_manifest_are_locked() {
        let manifest: toml::Table = MANIFEST.parse().unwrap();
        let lock =
            std::fs::read_to_string("../Cargo.lock").unwrap().parse::<toml::Table>().unwrap();
        let packages = lock["package"].as_array().unwrap();
        let is_locked =
            |name: &String| packages.iter().any(|package| package["name"].as_str() == Some(name));
        for table in ["dependencies", "build-dependencies"] {
            for name in manifest[table].as_table().unwrap().keys() {
                assert!(is_locked(name), "{name} is not in Cargo.lock: leave it out");
            }
        }
    }
}
