//! Finds the scene that a SCENE argument names.

use std::fmt::Display;
use std::io::Read;
use std::path::{Path, PathBuf};

use cases::course::{self, Course};
use cases::problem::did_you_mean;
use cases::scene::{MAX_SCENE_BYTES, parse, parse_json};
use cases::{Effects, Scene, stage};

use super::stop::Stop;
use super::values::{CourseArg, STAGES};

/// The name of standard input.
const STANDARD_INPUT: &str = "-";

/// A scene with its allowed effects and its course.
pub(super) struct Found {
    pub(super) scene: Scene,
    /// The effects that may be simulated.
    ///
    /// For a case, they are the effects that the stage allows or that programs of the course always
    /// simulate. For a resolved scene, they are the effects that it lists. For a scene of no stage,
    /// they are all effects.
    pub(super) allowed: Effects,
    /// The course given on the command line, else the course of the case, else the lecture.
    pub(super) course: Course,
}

/// Returns the scene that `named` names, with its allowed effects and its course.
///
/// The name is a file, the id of a case below ./cases/stages, or `-` for standard input.
pub(super) fn found(named: &str, arg: &CourseArg) -> Result<Found, Stop> {
    let given = given(arg)?;
    if named == STANDARD_INPUT {
        let course = given.unwrap_or_default();
        let (scene, is_resolved) = standard_input(&course)?;
        let allowed = if is_resolved { scene.effects } else { Effects::all() };
        return Ok(Found { scene, allowed, course });
    }
    let path = path(named)?;
    let course = given.map_or_else(|| course::course_at(&path), Ok)?;
    let scene = stage::load_scene(&path, &course)?;
    let is_resolved = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
    let allowed = if is_resolved {
        scene.effects
    } else {
        stage::allowed_at(&path)?.union(course.always_simulated)
    };
    Ok(Found { scene, allowed, course })
}

/// Returns the course that is given on the command line, or `None` if there is none.
pub(super) fn given(arg: &CourseArg) -> Result<Option<Course>, Stop> {
    Ok(arg.course.as_deref().map(course::load).transpose()?)
}

/// Returns the scene on standard input and whether it is a resolved scene in JSON. A text that
/// begins with a brace is JSON, any other is TOML. Paths of meshes are relative to the current
/// folder.
fn standard_input(course: &Course) -> Result<(Scene, bool), Stop> {
    let name = "standard input";
    let mut bytes = Vec::new();
    let unusable = |why: &dyn Display| Stop::Usage(format!("standard input cannot be used: {why}"));
    std::io::stdin()
        .take(MAX_SCENE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|why| unusable(&why))?;
    if bytes.len() as u64 > MAX_SCENE_BYTES {
        return Err(unusable(&format!("a scene has at most {MAX_SCENE_BYTES} bytes")));
    }
    let text = String::from_utf8(bytes)
        .map_err(|why| unusable(&format!("it is not UTF-8: {}", why.utf8_error())))?;
    let is_resolved = text.trim_start().starts_with('{');
    let scene = if is_resolved {
        parse_json(name, &text)?
    } else {
        parse(name, &text, Path::new("."), course)?
    };
    Ok((scene, is_resolved))
}

fn path(named: &str) -> Result<PathBuf, Stop> {
    let as_file = PathBuf::from(named);
    let as_case = Path::new(STAGES).join(format!("{named}.toml"));
    if as_file.is_file() {
        Ok(as_file)
    } else if as_case.is_file() {
        Ok(as_case)
    } else {
        Err(Stop::Usage(format!(
            "there is no file `{named}` and no case `{named}` in ./{STAGES}{}",
            hint(named)
        )))
    }
}

pub(super) fn hint(named: &str) -> String {
    let known = case_ids();
    match did_you_mean(named, known.iter().map(String::as_str)) {
        Some(meant) => format!("\nhelp: did you mean `{meant}`?"),
        None if known.is_empty() => {
            String::from("\nhelp: run this in the folder that contains `cases`")
        }
        None => String::new(),
    }
}

fn case_ids() -> Vec<String> {
    let list = |folder: &Path| {
        std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
    };
    let stages: Vec<_> = list(Path::new(STAGES)).collect();
    let files =
        stages.iter().flat_map(|stage| list(stage)).filter(|path| cases::stage::is_case(path));
    let id = |path: PathBuf| {
        Some(path.strip_prefix(STAGES).ok()?.with_extension("").to_str()?.to_owned())
    };
    files.filter_map(id).collect()
}
