//! The choices of a course where courses differ: the resolved [`Course`], and the reader of
//! `course.toml`.
//!
//! A value is legal where real courses teach it and no lecture calls it a mistake. A course does
//! not choose the values that a scene file may leave out (ka defaults to kd, kr to ks): the scene
//! format fixes them, and programs get scenes in which nothing is left out.

mod choice;
mod condition;
mod decisions;
mod deviations;
mod page;

use std::path::{Path, PathBuf};

pub use choice::{Decision, Legal};
pub(crate) use condition::Condition;
pub use decisions::*;
pub use deviations::{Deviation, deviations};
pub use page::markdown;

use crate::problem::Problems;
use crate::{scene, stage};

/// The name of the course file.
pub const FILE: &str = "course.toml";

/// Reads the course file at `path`.
///
/// # Errors
/// All problems of the file.
pub fn load(path: &Path) -> Result<Course, Problems> {
    parse(&path.display().to_string(), &scene::read(path)?)
}

/// Reads a course from TOML text, which messages call `name`. A key that is left out has the
/// lecture's value.
///
/// # Errors
/// All problems of the text.
pub fn parse(name: &str, text: &str) -> Result<Course, Problems> {
    let (raw, notes) = scene::document::<RawCourse>(name, text);
    notes.finish(raw.map(Course::from))
}

/// Returns the course of the stages in the folder `stages`.
///
/// The `course.toml` in the folder counts, which a varied set has, or else the one beside the
/// folder, which is `cases/course.toml` for `cases/stages`. Without either, the result is the
/// lecture's course.
///
/// # Errors
/// All problems of the file.
pub fn course_of(stages: &Path) -> Result<Course, Problems> {
    path_of(stages).map_or_else(|| Ok(Course::default()), |path| load(&path))
}

/// Returns the path of the file that [`course_of`] reads, or `None` if there is none.
pub fn path_of(stages: &Path) -> Option<PathBuf> {
    [stages.join(FILE), folder_of(stages).join(FILE)].into_iter().find(|path| path.exists())
}

/// Returns the course of the scene or case at `path`. A case has the course of the folder that
/// holds its stage. Any other scene has the lecture's course.
///
/// # Errors
/// All problems of the `course.toml`.
pub fn course_at(path: &Path) -> Result<Course, Problems> {
    if stage::is_case(path) {
        course_of(&folder_of(&folder_of(path)))
    } else {
        Ok(Course::default())
    }
}

/// Returns the folder that holds `path`. A path without a file name, such as `..`, is resolved
/// first; if that fails, the result is empty.
fn folder_of(path: &Path) -> PathBuf {
    match (path.file_name(), path.parent()) {
        (Some(_), Some(folder)) if folder.as_os_str().is_empty() => PathBuf::from("."),
        (Some(_), Some(folder)) => folder.to_path_buf(),
        _ => path
            .canonicalize()
            .ok()
            .and_then(|path| path.parent().map(Path::to_path_buf))
            .unwrap_or_default(),
    }
}
