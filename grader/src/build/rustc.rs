//! Builds a submission in the template by one call of the compiler. The result is stored under a
//! hash of everything that went into it.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::error::{BuildError, Fault};
use super::limits::{LIMITS, stopped};
use super::program::{Built, PROGRAM, Program, Stored};
use super::sdk::Sdk;
use super::workshop::Workshop;
use super::{diagnostics, entry};
use crate::files;
use crate::sandbox::{self, Access, Call, Finished, Folder, Layers, Limits, Outcome, Turn};
use crate::submission::Language;

/// The flags of the compiler for student code, which are part of the key.
const FLAGS: [&str; 11] = [
    "--crate-name=student",
    "--edition=2024",
    "-F",
    "unsafe_code",
    "-C",
    "opt-level=2",
    "-C",
    "codegen-units=1",
    "-C",
    "strip=debuginfo",
    "--error-format=json",
];
/// The limit on the CPU time of the compiler; a correct program takes a second or two.
const CPU: Duration = Duration::from_secs(60);
/// Bytes that the compiler and the linker write for a program, temporary files included: four times
/// what was measured.
const NEEDED: u64 = 8 << 20;
/// PATH of the compiler and of the program.
const SEARCH: &str = "/usr/bin:/bin";

/// Returns the stored program of these sources, or compiles it.
pub(super) fn build(
    sources: &BTreeMap<String, String>,
    digest: &str,
    workshop: &Workshop,
    progress: &dyn Fn(&str),
) -> Result<Built, BuildError> {
    let sdk = workshop.sdk(progress)?;
    // Without layers, a compiler may have read what it must not.
    let text = format!("{digest} {} {FLAGS:?} {}", sdk.key, workshop.layers);
    let key = blake3::hash(text.as_bytes()).to_hex();
    let folder = workshop.store().join("builds").join(&key[..32]);
    if let Some(stored) = Stored::take(&folder).map_err(Fault::from)? {
        return built(stored, Duration::ZERO);
    }
    progress("compiling the submission");
    let time = compile(workshop, sources, sdk, &folder)?;
    built(Stored::take(&folder).map_err(Fault::from)?.ok_or(Fault::Lost(folder))?, time)
}

fn built(stored: Stored, time: Duration) -> Result<Built, BuildError> {
    let warnings = stored.about.clone();
    let program = Program::of_stored(stored, SEARCH)?;
    Ok(Built { program, template: Some(Language::Rust), warnings, time })
}

/// Compiles in a folder of its own, and stores program and warnings as the entry `stored`.
fn compile(
    workshop: &Workshop,
    sources: &BTreeMap<String, String>,
    sdk: &Sdk,
    stored: &Path,
) -> Result<Duration, BuildError> {
    let folder = Folder::new().map_err(Fault::from)?;
    for (name, text) in sources {
        let path = folder.path().join(name);
        files::write(&path, text.as_bytes()).map_err(|source| Fault::Write { path, source })?;
    }
    let toolchain = workshop.toolchain()?;
    let call = Call {
        layers: workshop.layers,
        access: vec![Access::execute(&toolchain.sysroot), Access::execute(sdk.folder())],
        ..call(&toolchain.rustc(), sdk, folder.path())
    };
    let (finished, _) = sandbox::run(&call, Turn::Shared);
    if finished.outcome != Outcome::Exited(0) {
        return Err(failed(sandbox::blame(&call, finished), sdk, &call.limits));
    }
    let warnings = diagnostics::parse(&finished.stderr).warnings;
    entry::publish(stored, &warnings, |fresh| {
        std::fs::copy(folder.path().join(PROGRAM), fresh.join(PROGRAM)).map(drop)
    })
    .map_err(Fault::from)?;
    Ok(finished.wall)
}

/// Returns why there is no program. The student is blamed only if no library was changed.
fn failed(finished: Finished, sdk: &Sdk, limits: &Limits) -> BuildError {
    if let Err(why) = sdk.check() {
        return Fault::from(why).into();
    }
    let said = diagnostics::parse(&finished.stderr);
    match finished.outcome {
        Outcome::Exited(1) if !said.errors.is_empty() => BuildError::Rejected(said.errors_text()),
        Outcome::Exited(_) | Outcome::Signalled(_) => {
            let text = finished.stderr_text().unwrap_or_default();
            BuildError::Rejected(format!("the compiler fails:\n{text}"))
        }
        outcome => stopped(outcome, limits),
    }
}

fn call(rustc: &Path, sdk: &Sdk, folder: &Path) -> Call {
    let mut args: Vec<OsString> = FLAGS.map(OsString::from).to_vec();
    args.extend(["-L".into(), with("dependency=", sdk.folder())]);
    for (name, file) in sdk.externs() {
        args.extend(["--extern".into(), with(&format!("{name}="), &file)]);
    }
    let mut prefix = with("--remap-path-prefix=", folder);
    prefix.push("=.");
    args.extend([prefix, "-o".into(), PROGRAM.into(), "src/main.rs".into()]);
    Call {
        program: rustc.to_owned(),
        args,
        folder: folder.to_owned(),
        in_memory: false,
        environment: vec![("PATH".into(), SEARCH.into()), ("TMPDIR".into(), folder.into())],
        stdin: vec![],
        limits: LIMITS.with_time(CPU),
        layers: Layers::default(),
        access: vec![],
        needed: NEEDED,
    }
}

fn with(prefix: &str, path: &Path) -> OsString {
    let mut text = OsString::from(prefix);
    text.push(PathBuf::from(path));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks who is to blame for an error of the compiler after `spoil` has changed the libraries.
    fn check(spoil: impl Fn(&Path), is_rejected: bool) {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("sdk");
        let externs = BTreeMap::from([("cases".to_owned(), "libcases.rlib".to_owned())]);
        let fill = |fresh: &Path| std::fs::write(fresh.join("libcases.rlib"), "a library");
        entry::publish(&folder, &externs, fill).unwrap();
        let sdk = Sdk::of_entry(entry::Entry::take(&folder).unwrap().unwrap());
        spoil(&folder.join("libcases.rlib"));
        let said = br#"{"level":"error","message":"can't find crate for `cases`"}"#.to_vec();
        let finished = Finished { stderr: said, ..Finished::without_run(Outcome::Exited(1)) };
        let found = failed(finished, &sdk, &LIMITS);
        match is_rejected {
            true => assert!(
                matches!(&found, BuildError::Rejected(why) if why.contains("find crate")),
                "{found}"
            ),
            false => {
                assert!(matches!(&found, BuildError::Ours(Fault::Store(_))), "{found}");
                assert!(!folder.exists(), "the spoilt libraries are still there");
            }
        }
    }

    #[test]
    fn libraries_that_were_changed_are_not_the_students_fault() {
        check(|_| {}, true);
        check(|library| std::fs::write(library, "a librarx").unwrap(), false);
        check(|library| std::fs::write(library, "").unwrap(), false);
        check(|library| std::fs::remove_file(library).unwrap(), false);
        check(
            |library| {
                std::os::unix::fs::symlink("/dev/null", library.with_extension("so")).unwrap()
            },
            false,
        );
    }
}
