//! What a course decides where courses differ: the resolved [`Course`], and the reader of
//! `course.toml`.
//!
//! A value is legal where real courses teach it and no lecture calls it a mistake. What a scene
//! leaves out (ka without a value is kd, kr is ks) is no decision of a course: a scene file says
//! it, and programs get scenes in which nothing is left out.

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

/// The file's name.
pub const FILE: &str = "course.toml";

/// The course of the file at `path`.
///
/// # Errors
/// Everything that is wrong with the file.
pub fn load(path: &Path) -> Result<Course, Problems> {
    parse(&path.display().to_string(), &scene::read(path)?)
}

/// The course of a TOML text, called `name` in messages; a key left out is decided as the lecture
/// does.
///
/// # Errors
/// Everything that is wrong with the text.
pub fn parse(name: &str, text: &str) -> Result<Course, Problems> {
    let (raw, notes) = scene::document::<RawCourse>(name, text);
    notes.finish(raw.map(Course::from))
}

/// The course whose stages lie in the folder `stages`: that of the `course.toml` in it, as a varied
/// set has one, or else beside it, which is `cases/course.toml` for `cases/stages`; the lecture
/// where there is neither.
///
/// # Errors
/// Everything that is wrong with the file.
pub fn course_of(stages: &Path) -> Result<Course, Problems> {
    path_of(stages).map_or_else(|| Ok(Course::default()), |path| load(&path))
}

/// The file that [`course_of`] reads; `None` where there is none.
pub fn path_of(stages: &Path) -> Option<PathBuf> {
    [stages.join(FILE), folder_of(stages).join(FILE)].into_iter().find(|path| path.exists())
}

/// The course of the scene or case at `path`: for a case that of the folder its stage lies in, else
/// the lecture.
///
/// # Errors
/// Everything that is wrong with the `course.toml`.
pub fn course_at(path: &Path) -> Result<Course, Problems> {
    if stage::is_case(path) {
        course_of(&folder_of(&folder_of(path)))
    } else {
        Ok(Course::default())
    }
}

/// The folder that holds `path`.
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
