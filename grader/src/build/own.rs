//! Builds a submission that says how it is built. Its command runs in a private copy of the folder.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::error::{BuildError, Fault};
use super::limits::{LIMITS, stopped};
use super::program::{Built, Program};
use crate::sandbox::{self, Call, Folder, Layers, Outcome, Turn};
use crate::submission::Own;

/// Bytes that must be free for a build. Small tools do not report that they lacked room.
const NEEDED: u64 = 16 << 20;

/// Copies the submission, runs its build command if it has one, and returns its program.
pub(super) fn build(
    own: &Own,
    layers: Layers,
    progress: &dyn Fn(&str),
) -> Result<Built, BuildError> {
    let folder = Folder::new().map_err(Fault::from)?;
    copy(own, &folder).map_err(Fault::Copy)?;
    let search = std::env::var_os("PATH").unwrap_or_else(|| "/usr/bin:/bin".into());
    let mut time = Duration::ZERO;
    if let Some(words) = &own.build {
        progress("building the submission");
        time = run(words, folder.path(), &search, layers)?;
    }
    let (path, args) = command(&own.run, folder.path());
    if path.is_absolute() && !path.is_file() {
        let word = crate::plain::name(own.run[0].as_bytes());
        return Err(BuildError::Rejected(format!(
            "the run command of submission.toml starts with `{word}`, which does not exist"
        )));
    }
    let program = Program::in_folder(path, args, search, folder);
    Ok(Built { program, template: own.template, warnings: vec![], time })
}

/// Copies the submission to `folder`. All files are made executable, since archives do not say
/// which are.
fn copy(own: &Own, folder: &Folder) -> std::io::Result<()> {
    for file in &own.files {
        let to = folder.path().join(file);
        std::fs::create_dir_all(to.parent().unwrap_or(folder.path()))?;
        sandbox::place_program(&to, &std::fs::read(own.folder.join(file))?)?;
    }
    Ok(())
}

/// Returns the program and the arguments of a command. A word that begins with `./` is a path in
/// `folder`.
fn command(words: &[String], folder: &Path) -> (PathBuf, Vec<OsString>) {
    let resolve = |word: &String| match word.strip_prefix("./") {
        Some(rest) => folder.join(rest).into_os_string(),
        None => word.into(),
    };
    (
        words.first().map(resolve).unwrap_or_default().into(),
        words.iter().skip(1).map(resolve).collect(),
    )
}

fn run(
    words: &[String],
    folder: &Path,
    search: &OsString,
    layers: Layers,
) -> Result<Duration, BuildError> {
    let (program, args) = command(words, folder);
    let environment = [
        ("PATH", search.clone()),
        ("HOME", folder.into()),
        ("TMPDIR", folder.into()),
        ("LANG", "C.UTF-8".into()),
    ];
    let call = Call {
        program,
        args,
        folder: folder.to_owned(),
        in_memory: false,
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin: vec![],
        limits: LIMITS,
        layers,
        access: sandbox::interpreters(search),
        needed: NEEDED,
    };
    let (finished, _) = sandbox::run(&call, Turn::Shared);
    if finished.outcome == Outcome::Exited(0) {
        return Ok(finished.wall);
    }
    let finished = sandbox::blame(&call, finished);
    let said = finished.stderr_text().unwrap_or_default();
    match finished.outcome {
        Outcome::Exited(code) => {
            Err(BuildError::Rejected(format!("the build command ends with code {code}:\n{said}")))
        }
        Outcome::NoProgram(why) => {
            Err(BuildError::Rejected(format!("the build command cannot be started: {why}")))
        }
        outcome => Err(stopped(outcome, &LIMITS)),
    }
}
