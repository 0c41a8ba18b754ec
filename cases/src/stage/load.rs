//! Loads stages. Every file of the folder is read, and the problems of all files are reported at
//! once.

use std::path::{Path, PathBuf};

use super::allows::{allowed, limit, raw_stage};
use super::folder::{entries, file_name, is_case, is_toml, stem};
use super::raw::RawCase;
use super::{Base, Bounds, Case, Check, Stage, checks};
use crate::course::Course;
use crate::effects::Effects;
use crate::problem::Problems;
use crate::scene::{self, Scene};

/// Loads the stages below `stages_dir` under `course`, ordered by name, each with its cases and
/// unit checks ordered by file name.
///
/// # Errors
/// All problems of all files of all stages.
pub fn load_all(stages_dir: &Path, course: &Course) -> Result<Vec<Stage>, Problems> {
    let folders: Vec<PathBuf> =
        entries(stages_dir)?.into_iter().filter(|path| path.is_dir()).collect();
    let names: Vec<String> = folders.iter().map(|folder| file_name(folder)).collect();
    if folders.is_empty() {
        let help = "stages are folders such as `01_ray_casting` with a `stage.toml`".to_owned();
        return Err(Problems::of_file(
            stages_dir.display().to_string(),
            "there are no stages here",
            Some(help),
        ));
    }
    let stage = |(at, folder): (usize, &PathBuf)| stage(folder, &names[..at], course);
    let mut stages = all(folders.iter().enumerate().map(stage).collect())?;
    for at in 1..stages.len() {
        let before = stages[..at].iter().fold(Effects::NONE, |all, stage| all.union(stage.allows));
        let added = stages[at].allows.difference(before);
        if added != Effects::NONE {
            stages[at].base = Base::Without(added);
        }
    }
    Ok(stages)
}

/// Returns the scene of the file at `path`, which is a case, any other scene in TOML, or a resolved
/// scene in JSON (`.json`).
///
/// A resolved scene lists its effects. Any other scene requests the effects that it calls for under
/// `course`. A case whose folder holds a `stage.toml` requests only those that its stage allows.
/// Paths of meshes are relative to the folder of the file.
///
/// # Errors
/// All problems of the file.
pub fn load_scene(path: &Path, course: &Course) -> Result<Scene, Problems> {
    if is_case(path) {
        load_case(path, course).map(|case| case.scene)
    } else {
        scene::load(path, course)
    }
}

/// Returns the image case at `path`. Its scene requests the effects that it calls for under
/// `course` and that the stage around it allows.
///
/// # Errors
/// All problems of the case and its `stage.toml`. A case outside any stage is an error.
pub fn load_case(path: &Path, course: &Course) -> Result<Case, Problems> {
    let folder = path.canonicalize().ok().and_then(|path| path.parent().map(Path::to_path_buf));
    let folder = folder.unwrap_or_else(|| path.parent().unwrap_or(Path::new("")).to_path_buf());
    let about = path.with_file_name("stage.toml");
    let raw = raw_stage(&about, None);
    let allows = raw.as_ref().map_or_else(|_| Effects::all(), allowed);
    let case = case(path, &file_name(&folder), allows, course);
    both(raw, case).map(|(_, case)| case)
}

/// Returns both values, or the problems of both.
fn both<A, B>(a: Result<A, Problems>, b: Result<B, Problems>) -> Result<(A, B), Problems> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(a), Err(b)) => Err(a.and(b)),
        (Err(problems), _) | (_, Err(problems)) => Err(problems),
    }
}

/// Returns all values, or all problems.
fn all<T>(results: Vec<Result<T, Problems>>) -> Result<Vec<T>, Problems> {
    let (mut values, mut problems) = (vec![], vec![]);
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(found) => problems.extend(found.into_vec()),
        }
    }
    Problems::new(problems).map_or(Ok(values), Err)
}

/// Reads the stage in `folder`, with the base of a first stage. `before` names the earlier stages.
fn stage(folder: &Path, before: &[String], course: &Course) -> Result<Stage, Problems> {
    let id = file_name(folder);
    let raw = raw_stage(&folder.join("stage.toml"), Some(before));
    let allows = raw.as_ref().map_or_else(|_| Effects::all(), allowed);
    let files = entries(folder)?;
    let cases = files
        .iter()
        .filter(|path| is_case(path))
        .map(|path| case(path, &id, allows, course))
        .collect();
    let checks = checks(&folder.join("checks"), &id, allows, course);
    let (raw, (cases, checks)) = both(raw, both(all(cases), checks))?;
    Ok(Stage {
        id,
        title: raw.title,
        about: raw.about,
        allows,
        base: Base::Background,
        needs: raw.needs.into_iter().map(|name| name.value).collect(),
        unit_points: raw.unit_points.0,
        explained_share: (raw.explained_share.get() * 1000.0).round() as u32,
        cases,
        checks,
    })
}

/// Returns the unit checks of the files in `folder`, or none if there is no such folder.
fn checks(
    folder: &Path,
    stage: &str,
    allows: Effects,
    course: &Course,
) -> Result<Vec<Check>, Problems> {
    let files = if folder.is_dir() { entries(folder)? } else { vec![] };
    let files = files.iter().filter(|path| is_toml(path));
    all(files.map(|path| checks::load(path, stage, allows, course)).collect())
        .map(|lists| lists.concat())
}

/// Reads the case at `path`, in the stage of that id.
fn case(path: &Path, stage: &str, allows: Effects, course: &Course) -> Result<Case, Problems> {
    parse_case(path, &scene::read(path)?, stage, allows, course)
}

/// Parses the case in the `text` of a file at `path`. It belongs to the stage of that id, which
/// `allows` these effects, under `course`. No other files than the meshes of the scene are read.
///
/// # Errors
/// All problems of the text.
pub fn parse_case(
    path: &Path,
    text: &str,
    stage: &str,
    allows: Effects,
    course: &Course,
) -> Result<Case, Problems> {
    let (raw, mut notes) = scene::document::<RawCase>(&path.display().to_string(), text);
    let found = raw.and_then(|raw| {
        let base = path.parent().unwrap_or(Path::new(""));
        let bounds =
            raw.vary.as_ref().map(|vary| Bounds::read(vary, raw.scene.0.as_ref(), &mut notes));
        let mut scene = scene::body(&raw.render.0, &raw.scene.0, base, course, &mut notes)?;
        limit(&mut scene, allows, course, &mut notes);
        Some(Case {
            id: format!("{stage}/{}", stem(path)),
            title: raw.title,
            about: raw.about,
            rules: raw.rules.iter().map(|rule| rule.0).collect(),
            points: raw.points.0,
            scene,
            bounds,
        })
    });
    notes.finish(found)
}
