//! A submission in the template: one call of the compiler, stored under the hash of all that went into it.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempDir;

use super::{BuildError, Built, LIMITS, Program, Sdk, Workshop, diagnostics, stopped};
use crate::files;
use crate::sandbox::{self, Call, Limits, Outcome};

/// How student code is compiled; part of the key.
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
/// A right one takes a second or two.
const QUICK: Limits = Limits { wall: Duration::from_secs(60), cpu: Duration::from_secs(60), ..LIMITS };
const SEARCH: &str = "/usr/bin:/bin";
const PROGRAM: &str = "program";
const WARNINGS: &str = "warnings.json";

/// Takes the stored program of these sources, or compiles it.
pub(super) fn build(
    sources: &BTreeMap<String, String>,
    digest: &str,
    workshop: &Workshop,
    tell: &dyn Fn(&str),
) -> Result<Built, BuildError> {
    let sdk = workshop.sdk(tell).map_err(BuildError::Ours)?;
    let key = blake3::hash(format!("{digest} {} {FLAGS:?}", sdk.key).as_bytes()).to_hex();
    let stored = workshop.store().join("builds").join(&key[..32]);
    if let Some(built) = take(&stored, Duration::ZERO) {
        return Ok(built);
    }
    tell("compiling the submission");
    let rustc = workshop.toolchain().map_err(BuildError::Ours)?.rustc();
    let time = compile(&rustc, sources, sdk, &stored)?;
    take(&stored, time).ok_or_else(|| BuildError::Ours(format!("{} cannot be read", stored.display())))
}

fn take(stored: &Path, time: Duration) -> Option<Built> {
    let path = stored.join(PROGRAM);
    let warnings = serde_json::from_slice(&std::fs::read(stored.join(WARNINGS)).ok()?).ok()?;
    let program = Program::new(path, vec![], SEARCH);
    program.path.is_file().then_some(Built { program, warnings, time })
}

/// Compiles in a folder of its own and publishes program and warnings at `stored`.
fn compile(rustc: &Path, sources: &BTreeMap<String, String>, sdk: &Sdk, stored: &Path) -> Result<Duration, BuildError> {
    let ours = |why: std::io::Error| BuildError::Ours(format!("the build folder: {why}"));
    let folder = TempDir::new().map_err(ours)?;
    for (name, text) in sources {
        files::write(&folder.path().join(name), text.as_bytes()).map_err(ours)?;
    }
    let finished = sandbox::run(&call(rustc, sdk, folder.path()));
    let said = diagnostics::parse(&finished.stderr);
    match finished.outcome {
        Outcome::Exited(0) => {}
        Outcome::Exited(1) if !said.errors.is_empty() => return Err(BuildError::Rejected(said.errors_text())),
        Outcome::Exited(_) | Outcome::Signalled(_) => {
            let text = finished.stderr_text().unwrap_or_default();
            return Err(BuildError::Rejected(format!("the compiler fails:\n{text}")));
        }
        outcome => return Err(stopped(outcome, &QUICK)),
    }
    let warnings = serde_json::to_vec(&said.warnings).map_err(|why| BuildError::Ours(why.to_string()))?;
    files::publish_folder(stored, |fresh| {
        std::fs::copy(folder.path().join(PROGRAM), fresh.join(PROGRAM))?;
        std::fs::write(fresh.join(WARNINGS), &warnings)
    })
    .map_err(ours)?;
    Ok(finished.wall)
}

fn call(rustc: &Path, sdk: &Sdk, folder: &Path) -> Call {
    let mut args: Vec<OsString> = FLAGS.map(OsString::from).to_vec();
    args.extend(["-L".into(), with("dependency=", &sdk.folder)]);
    for (name, file) in &sdk.externs {
        args.extend(["--extern".into(), with(&format!("{name}="), &sdk.folder.join(file))]);
    }
    let mut prefix = with("--remap-path-prefix=", folder);
    prefix.push("=.");
    args.extend([prefix, "-o".into(), PROGRAM.into(), "src/main.rs".into()]);
    Call {
        program: rustc.to_owned(),
        args,
        folder: folder.to_owned(),
        environment: vec![("PATH".into(), SEARCH.into()), ("TMPDIR".into(), folder.into())],
        stdin: vec![],
        limits: QUICK,
    }
}

fn with(prefix: &str, path: &Path) -> OsString {
    let mut text = OsString::from(prefix);
    text.push(PathBuf::from(path));
    text
}
