//! A submission that says how it is built: its command runs in a private copy of the folder.

use std::ffi::OsString;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::{BuildError, Built, LIMITS, Program, stopped};
use crate::sandbox::{self, Call, Folder, Outcome};
use crate::submission::Own;

/// Copies, builds if there is a command for it, and says what is to be run.
pub(super) fn build(own: &Own, tell: &dyn Fn(&str)) -> Result<Built, BuildError> {
    let folder = copy(own).map_err(|why| BuildError::Ours(format!("the submission cannot be copied: {why}")))?;
    let search = std::env::var_os("PATH").unwrap_or_else(|| "/usr/bin:/bin".into());
    let mut time = Duration::ZERO;
    if let Some(words) = &own.build {
        tell("building the submission");
        time = run(words, folder.path(), &search)?;
    }
    let (path, args) = command(&own.run, folder.path());
    if path.is_absolute() && !path.is_file() {
        let word = crate::plain::name(own.run[0].as_bytes());
        return Err(BuildError::Rejected(format!(
            "the run command of submission.toml starts with `{word}`, which is not there"
        )));
    }
    Ok(Built { program: Program { path, args, search, folder: Some(folder) }, warnings: vec![], time })
}

/// A private copy. All files are made executable: archives do not say which are.
fn copy(own: &Own) -> std::io::Result<Folder> {
    let folder = Folder::new()?;
    for file in &own.files {
        let to = folder.path().join(file);
        std::fs::create_dir_all(to.parent().unwrap_or(folder.path()))?;
        std::fs::copy(own.folder.join(file), &to)?;
        std::fs::set_permissions(&to, std::fs::Permissions::from_mode(0o755))?;
    }
    Ok(folder)
}

/// The words of a command, where one that begins with `./` is a path in `folder`.
fn command(words: &[String], folder: &Path) -> (PathBuf, Vec<OsString>) {
    let resolve = |word: &String| match word.strip_prefix("./") {
        Some(rest) => folder.join(rest).into_os_string(),
        None => word.into(),
    };
    (words.first().map(resolve).unwrap_or_default().into(), words.iter().skip(1).map(resolve).collect())
}

fn run(words: &[String], folder: &Path, search: &OsString) -> Result<Duration, BuildError> {
    let (program, args) = command(words, folder);
    let environment =
        [("PATH", search.clone()), ("HOME", folder.into()), ("TMPDIR", folder.into()), ("LANG", "C.UTF-8".into())];
    let finished = sandbox::run(&Call {
        program,
        args,
        folder: folder.to_owned(),
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin: vec![],
        limits: LIMITS,
    });
    let said = finished.stderr_text().unwrap_or_default();
    match finished.outcome {
        Outcome::Exited(0) => Ok(finished.wall),
        Outcome::Exited(code) => Err(BuildError::Rejected(format!("the build command ends with code {code}:\n{said}"))),
        Outcome::NoProgram(why) => Err(BuildError::Rejected(format!("the build command cannot be started: {why}"))),
        outcome => Err(stopped(outcome, &LIMITS)),
    }
}
