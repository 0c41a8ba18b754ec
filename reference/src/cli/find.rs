//! What a SCENE on the command line names.

use std::path::{Path, PathBuf};

use cases::course::{self, Course};
use cases::problem::did_you_mean;
use cases::{Effects, Scene, scene, stage};

use super::Stop;
use super::args::CourseArg;

/// Where stages are sought.
pub(super) const STAGES: &str = "cases/stages";

/// Returns the scene that `named` names under `course`: a file, or the id of a case below
/// ./cases/stages.
pub(super) fn scene(named: &str, course: &Course) -> Result<Scene, Stop> {
    Ok(scene::load(&path(named)?, course)?)
}

/// Returns the effects that may be simulated in `scene`, which `named` names: those that its stage allows
/// or that programs of the course always simulate; for a JSON file, those that it lists.
pub(super) fn allowed(named: &str, scene: &Scene, course: &Course) -> Result<Effects, Stop> {
    let path = path(named)?;
    if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("json")) {
        return Ok(scene.effects);
    }
    Ok(stage::allowed_at(&path)?.union(course.always_simulated))
}

/// Returns the course by which the scene that `named` names is rendered: the one that is given, otherwise
/// that of the case, otherwise the lecture.
pub(super) fn course(named: &str, arg: &CourseArg) -> Result<Course, Stop> {
    match given(arg)? {
        Some(course) => Ok(course),
        None => Ok(course::course_at(&path(named)?)?),
    }
}

/// Returns the course that is given on the command line.
pub(super) fn given(arg: &CourseArg) -> Result<Option<Course>, Stop> {
    Ok(arg.course.as_deref().map(course::load).transpose()?)
}

fn path(named: &str) -> Result<PathBuf, Stop> {
    let as_file = PathBuf::from(named);
    let as_case = Path::new(STAGES).join(format!("{named}.toml"));
    if as_file.is_file() {
        Ok(as_file)
    } else if as_case.is_file() {
        Ok(as_case)
    } else {
        Err(Stop::Usage(format!("there is no file `{named}` and no case `{named}` in ./{STAGES}{}", hint(named))))
    }
}

pub(super) fn hint(named: &str) -> String {
    let known = case_ids();
    match did_you_mean(named, known.iter().map(String::as_str)) {
        Some(meant) => format!("\nhelp: did you mean `{meant}`?"),
        None if known.is_empty() => String::from("\nhelp: run this where the folder `cases` lies"),
        None => String::new(),
    }
}

fn case_ids() -> Vec<String> {
    let list = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let stages: Vec<_> = list(Path::new(STAGES)).collect();
    let files = stages.iter().flat_map(|stage| list(stage)).filter(|path| cases::stage::is_case(path));
    let id = |path: PathBuf| Some(path.strip_prefix(STAGES).ok()?.with_extension("").to_str()?.to_owned());
    files.filter_map(id).collect()
}
