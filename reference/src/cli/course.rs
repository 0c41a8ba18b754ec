//! `reference course`, and the files of a course that stand beside its answers.

use std::path::{Path, PathBuf};

use cases::course::{self, Course, FILE};

use super::args::{CourseArg, CourseArgs};
use super::{Stop, print};
use crate::expect::Expected;

/// Where the page for students lies, seen from the folder that holds the folder of `course.toml`.
const PAGE: &str = "docs/course.md";

/// Carries out the command.
pub(super) fn run(args: &CourseArgs) -> Result<(), Stop> {
    print(course::markdown(&course::load(&args.course)?).as_bytes())
}

/// Returns what else changes with the answers of the folder `stages`: its `course.toml`, where another
/// file is given, and the page for students, where there is one.
pub(super) fn files(stages: &Path, given: &CourseArg, course: &Course) -> Result<Vec<Expected>, Stop> {
    let home = course::path_of(stages).unwrap_or_else(|| stages.join(FILE));
    let mut files = vec![];
    if let Some(page) = page(&home) {
        files.push(Expected { path: page, bytes: course::markdown(course).into_bytes() });
    }
    if let Some(path) = &given.course {
        let unreadable = |why| Stop::Usage(format!("{}: {why}", path.display()));
        files.push(Expected { path: home, bytes: std::fs::read(path).map_err(unreadable)? });
    }
    Ok(files)
}

/// Returns the page for students that belongs to the file at `home`, if there is one.
fn page(home: &Path) -> Option<PathBuf> {
    let page = home.parent()?.join("..").join(PAGE);
    page.is_file().then_some(page)
}
