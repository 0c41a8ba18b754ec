//! Folders of stages: the cases to vary are read from one, a varied set is written as another.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course;
use cases::files::{self, WriteError};
use cases::stage::{Case, Stage};
use rayon::prelude::*;
use toml_edit::DocumentMut;

use super::{Asset, Care, Original, Varied, take_along};
use crate::expect::Set;

fn case_path(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{id}.toml"))
}

/// The cases of the `set` read from `folder`, ready to be varied; `done` is told of each.
///
/// # Errors
/// All that keeps any of them from being varied, a paragraph each.
pub fn originals(folder: &Path, set: &Set, done: impl Fn() + Sync) -> Result<Vec<Original>, String> {
    let stages = set.stages.iter().enumerate();
    let cases: Vec<(usize, &Case)> =
        stages.flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, case))).collect();
    let read = cases.par_iter().map(|(n, case)| {
        let path = case_path(folder, &case.id);
        let text = fs::read_to_string(&path).map_err(|why| cannot_read(&path, &why))?;
        let original = Original::new(set, *n, case, &path, &text);
        done();
        original
    });
    all(read.collect())
}

/// The cases of `set` under `seed`; `done` is told of each.
///
/// # Errors
/// Which cases will not do, and why, a paragraph each.
pub fn draw(originals: &[Original], set: &Set, seed: u64, done: impl Fn() + Sync) -> Result<Vec<Varied>, String> {
    let draw = |original: &Original| {
        let varied = original.vary(set, seed, Care::Whole);
        done();
        varied
    };
    all(originals.par_iter().map(draw).collect())
}

/// All values, or all that went wrong.
fn all<T>(results: Vec<Result<T, String>>) -> Result<Vec<T>, String> {
    let (mut values, mut wrong) = (vec![], vec![]);
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(why) => wrong.push(why),
        }
    }
    if wrong.is_empty() { Ok(values) } else { Err(wrong.join("\n")) }
}

/// Why a varied set was not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteSetError {
    /// What the set is made from cannot be read.
    #[error("{0}")]
    Source(String),
    /// The set cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Writes the `varied` cases of the `stages` in `folder` to `out`, with what their course decides.
///
/// The set is made beside `out` and then moved there whole. `out` is not there, or empty.
///
/// # Errors
/// [`WriteSetError`]; `out` is then as it was.
pub fn write(folder: &Path, stages: &[Stage], varied: &[Varied], out: &Path) -> Result<(), WriteSetError> {
    let beside = match out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let failed = |source: io::Error| unwritten(out, source);
    fs::create_dir_all(beside).map_err(failed)?;
    let part = tempfile::Builder::new().prefix(".varied-").tempdir_in(beside).map_err(failed)?;
    let whole = part.path().join("stages");
    for stage in stages {
        write_stage(&folder.join(&stage.id), &whole.join(&stage.id))?;
    }
    for varied in varied {
        let path = case_path(&whole, &varied.case.id);
        put(&path, varied.text.as_bytes())?;
        take(&case_path(folder, &varied.case.id), &path, &varied.assets)?;
    }
    if let Some(path) = course::path_of(folder) {
        let bytes = fs::read(&path).map_err(|why| unread(&path, &why))?;
        put(&whole.join(course::FILE), &bytes)?;
    }
    Ok(fs::rename(&whole, out).map_err(failed)?)
}

/// The stage's own file and its unit checks, which stay as they are.
fn write_stage(from: &Path, to: &Path) -> Result<(), WriteSetError> {
    let read = |path: &Path| fs::read_to_string(path).map_err(|why| unread(path, &why));
    put(&to.join("stage.toml"), read(&from.join("stage.toml"))?.as_bytes())?;
    let checks = from.join("checks");
    let entries =
        if checks.is_dir() { Some(fs::read_dir(&checks).map_err(|why| unread(&checks, &why))?) } else { None };
    for entry in entries.into_iter().flatten() {
        let path = entry.map_err(|why| unread(&checks, &why))?.path();
        if path.extension().is_some_and(|end| end == "toml") {
            let mut document: DocumentMut = read(&path)?.parse().map_err(|why| unread(&path, &why))?;
            let target = to.join("checks").join(path.file_name().unwrap_or_default());
            take(&path, &target, &take_along(&mut document))?;
            put(&target, document.to_string().as_bytes())?;
        }
    }
    Ok(())
}

/// Copies the meshes that the file `from` names to where the file `to` names them.
fn take(from: &Path, to: &Path, assets: &[Asset]) -> Result<(), WriteSetError> {
    assets.iter().try_for_each(|asset| {
        let source = from.with_file_name("").join(&asset.from);
        let bytes = fs::read(&source).map_err(|why| unread(&source, &why))?;
        put(&to.with_file_name("").join(&asset.to), &bytes)
    })
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), WriteSetError> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).map_err(|source| unwritten(path, source))?;
    Ok(files::write(path, bytes)?)
}

fn unwritten(path: &Path, source: io::Error) -> WriteError {
    WriteError { name: path.to_owned(), is_untouched: true, source }
}

fn unread(path: &Path, why: &dyn std::fmt::Display) -> WriteSetError {
    WriteSetError::Source(cannot_read(path, why))
}

fn cannot_read(path: &Path, why: &dyn std::fmt::Display) -> String {
    format!("cannot read {}: {why}", path.display())
}
