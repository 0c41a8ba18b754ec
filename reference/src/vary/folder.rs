//! Reads the cases to vary from a folder of stages, and writes a varied set as another one.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course;
use cases::files::{self, WriteError};
use cases::stage::Case;
use rayon::prelude::*;
use tempfile::TempDir;
use toml_edit::DocumentMut;

use super::{Asset, Care, Original, Varied, VaryError, take_along};
use crate::expect::Set;

/// The cases of a folder, by whether their numbers may be changed.
#[derive(Clone, Debug)]
pub struct Originals {
    /// The cases with a `[vary]`.
    pub varying: Vec<Original>,
    /// The ids of the cases without one. A varied set contains them unchanged.
    pub constant: Vec<String>,
}

fn case_path(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{id}.toml"))
}

/// Returns the cases of the `set` that was read from `folder`, prepared for varying. Calls `done`
/// after each.
///
/// # Errors
/// An error for each case with a `[vary]` that cannot be varied.
pub fn originals(
    folder: &Path,
    set: &Set,
    done: impl Fn() + Sync,
) -> Result<Originals, Vec<VaryError>> {
    let stages = set.stages.iter().enumerate();
    let cases = stages.flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, case)));
    let (varying, constant): (Vec<(usize, &Case)>, Vec<_>) =
        cases.partition(|(_, case)| case.bounds.is_some());
    let read = varying.par_iter().map(|(n, case)| {
        let path = case_path(folder, &case.id);
        let text = fs::read_to_string(&path)
            .map_err(|source| VaryError::Read { path: path.clone(), source })?;
        let original = Original::new(set, *n, case, &path, &text);
        done();
        original
    });
    let constant = constant.into_iter().map(|(_, case)| case.id.clone()).collect();
    Ok(Originals { varying: all(read.collect())?, constant })
}

/// Returns the varied cases of `set` under `seed`. Calls `done` after each.
///
/// # Errors
/// An error for each case without an accepted draw.
pub fn draw(
    originals: &[Original],
    set: &Set,
    seed: u64,
    done: impl Fn() + Sync,
) -> Result<Vec<Varied>, Vec<VaryError>> {
    let draw = |original: &Original| {
        let varied = original.vary(set, seed, Care::Whole);
        done();
        varied
    };
    all(originals.par_iter().map(draw).collect())
}

/// Returns all values, or all errors.
fn all<T>(results: Vec<Result<T, VaryError>>) -> Result<Vec<T>, Vec<VaryError>> {
    let (mut values, mut wrong) = (vec![], vec![]);
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(why) => wrong.push(why),
        }
    }
    if wrong.is_empty() { Ok(values) } else { Err(wrong) }
}

/// The reasons for which a varied set was not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteSetError {
    /// A file from which the set is made cannot be read.
    #[error("cannot read {}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A file from which the set is made is not TOML.
    #[error("cannot read {}", .path.display())]
    Toml {
        /// The file.
        path: PathBuf,
        /// The error, with line and column.
        source: toml_edit::TomlError,
    },
    /// The set cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// A set of stages in a temporary folder. It is deleted when dropped unless it is published.
#[derive(Debug)]
pub struct Draft {
    part: TempDir,
}

impl Draft {
    /// Writes a set to a temporary folder beside `out`. It has the `varied` cases of the `set` that
    /// was read from `folder`, its `constant` cases unchanged, its unit checks and its course.
    ///
    /// # Errors
    /// [`WriteSetError`].
    pub fn write(
        folder: &Path,
        set: &Set,
        varied: &[Varied],
        constant: &[String],
        out: &Path,
    ) -> Result<Self, WriteSetError> {
        let beside = match out.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let failed = |source: io::Error| WriteError::untouched(out, source);
        fs::create_dir_all(beside).map_err(failed)?;
        let draft = Self {
            part: tempfile::Builder::new().prefix(".part-").tempdir_in(beside).map_err(failed)?,
        };
        let whole = draft.stages();
        for stage in &set.stages {
            write_stage(&folder.join(&stage.id), &whole.join(&stage.id))?;
        }
        for id in constant {
            copy(&case_path(folder, id), &case_path(&whole, id))?;
        }
        for varied in varied {
            let path = case_path(&whole, &varied.case.id);
            put(&path, varied.text.as_bytes())?;
            take(&case_path(folder, &varied.case.id), &path, &varied.assets)?;
        }
        // The set has its own course file, so that one beside `out` decides nothing.
        let course = match course::path_of(folder) {
            Some(path) => fs::read(&path).map_err(unread(&path))?,
            None => b"# The choices of the lecture.\n".to_vec(),
        };
        put(&whole.join(course::FILE), &course)?;
        Ok(draft)
    }

    /// Returns the folder of the stages, to which answers may be added.
    pub fn stages(&self) -> PathBuf {
        self.part.path().join("stages")
    }

    /// Moves the set to `out`, which must be an empty folder or not exist.
    ///
    /// # Errors
    /// The error of the file system. `out` is then unchanged.
    pub fn publish(self, out: &Path) -> Result<(), WriteError> {
        fs::rename(self.stages(), out).map_err(|source| WriteError::untouched(out, source))
    }
}

/// Writes the stage's own file and its unit checks, which are not varied.
fn write_stage(from: &Path, to: &Path) -> Result<(), WriteSetError> {
    let file = "stage.toml";
    put(&to.join(file), read(&from.join(file))?.as_bytes())?;
    let checks = from.join("checks");
    if !checks.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(&checks).map_err(unread(&checks))? {
        let path = entry.map_err(unread(&checks))?.path();
        if path.extension().is_some_and(|end| end == "toml") {
            copy(&path, &to.join("checks").join(path.file_name().unwrap_or_default()))?;
        }
    }
    Ok(())
}

/// Copies a case or a file of checks with the meshes that it names. The text stays the same, byte
/// for byte, unless a mesh moves.
fn copy(from: &Path, to: &Path) -> Result<(), WriteSetError> {
    let text = read(from)?;
    let mut document: DocumentMut =
        text.parse().map_err(|source| WriteSetError::Toml { path: from.to_owned(), source })?;
    let assets = take_along(&mut document);
    take(from, to, &assets)?;
    put(to, if assets.is_empty() { text } else { document.to_string() }.as_bytes())
}

fn read(path: &Path) -> Result<String, WriteSetError> {
    fs::read_to_string(path).map_err(unread(path))
}

/// Copies the meshes that the file `from` names to where the file `to` names them.
fn take(from: &Path, to: &Path, assets: &[Asset]) -> Result<(), WriteSetError> {
    assets.iter().try_for_each(|asset| {
        let source = from.with_file_name("").join(&asset.from);
        let bytes = fs::read(&source).map_err(unread(&source))?;
        put(&to.with_file_name("").join(&asset.to), &bytes)
    })
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), WriteSetError> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))
        .map_err(|source| WriteError::untouched(path, source))?;
    Ok(files::write(path, bytes)?)
}

fn unread(path: &Path) -> impl Fn(io::Error) -> WriteSetError {
    move |source| WriteSetError::Read { path: path.to_owned(), source }
}
