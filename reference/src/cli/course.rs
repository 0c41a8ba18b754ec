//! The command `reference course`, and the files of a course that are stored with its answers.

use std::path::{Path, PathBuf};

use cases::course::{self, Course, FILE};

use super::args::CourseArgs;
use super::output::print;
use super::stop::Stop;
use super::values::CourseArg;
use crate::expect::Expected;

/// The path of the page for students, relative to the parent of the folder of `course.toml`.
const PAGE: &str = "docs/course.md";

/// Runs the command.
pub(super) fn run(args: &CourseArgs) -> Result<(), Stop> {
    print(course::markdown(&course::load(&args.course)?).as_bytes())
}

/// Returns the files that change with the answers of the folder `stages`: `course.toml` if another
/// file is given, and the page for students if there is one.
///
/// The page belongs to the `course.toml` beside the folder. A set with its own file changes no
/// page, and a file that other sets use as well is left unchanged.
pub(super) fn files(
    stages: &Path,
    given: &CourseArg,
    course: &Course,
) -> Result<Vec<Expected>, Stop> {
    let own = stages.join(FILE);
    let beside = course::path_of(stages).filter(|path| *path != own);
    let changed = beside.as_ref().filter(|path| given.course.is_none() || !is_shared(path, stages));
    let mut files = vec![];
    if let Some(page) = changed.and_then(|path| page(path)) {
        files.push(Expected { path: page, bytes: course::markdown(course).into_bytes() });
    }
    if let Some(path) = &given.course {
        let unreadable = |why| Stop::Usage(format!("{}: {why}", path.display()));
        let bytes = std::fs::read(path).map_err(unreadable)?;
        files.push(Expected { path: changed.cloned().unwrap_or(own), bytes });
    }
    Ok(files)
}

/// Returns whether a folder of stages other than `stages` uses the file `course`, which is beside
/// it.
fn is_shared(course: &Path, stages: &Path) -> bool {
    let folders = |path: &Path| {
        std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path())
    };
    let has_stage = |folder: &Path| folders(folder).any(|path| path.join("stage.toml").is_file());
    let is_this = |folder: &Path| folder.canonicalize().ok() == stages.canonicalize().ok();
    let beside = course.parent().map(folders).into_iter().flatten();
    beside
        .filter(|folder| !folder.join(FILE).is_file() && has_stage(folder))
        .any(|folder| !is_this(&folder))
}

/// Returns the page for students that belongs to the file `home`, or `None` if there is none.
fn page(home: &Path) -> Option<PathBuf> {
    let page = home.parent()?.join("..").join(PAGE);
    page.is_file().then_some(page)
}
