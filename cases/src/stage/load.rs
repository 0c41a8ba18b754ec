//! Loads stages. Every file of the folder is read, and the problems of all files are reported at once.

use std::path::{Path, PathBuf};

use super::raw::RawStage;
use super::{Base, Case, Check, Stage, checks};
use crate::course::Course;
use crate::effects::{self, Effect, Effects};
use crate::problem::{Problems, quoted};
use crate::scene::raw::read::Notes;
use crate::scene::raw::{RawCase, vary};
use crate::scene::{self, Scene};

/// Returns the stages below `stages_dir` under `course`, ordered by name, each with its cases and unit
/// checks ordered by file name.
///
/// # Errors
/// Everything that is wrong in any file of any stage.
pub fn load_all(stages_dir: &Path, course: &Course) -> Result<Vec<Stage>, Problems> {
    let folders: Vec<PathBuf> = entries(stages_dir)?.into_iter().filter(|path| path.is_dir()).collect();
    let names: Vec<String> = folders.iter().map(|folder| file_name(folder)).collect();
    if folders.is_empty() {
        let help = "stages are folders such as `01_ray_casting` with a `stage.toml`".to_owned();
        return Err(Problems::of_file(stages_dir.display().to_string(), "there are no stages here", Some(help)));
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

/// Whether `path` is an image case of a stage: a TOML file whose folder holds a `stage.toml`.
pub fn is_case(path: &Path) -> bool {
    is_toml(path) && file_name(path) != "stage.toml" && path.with_file_name("stage.toml").is_file()
}

/// Returns the image case at `path`. Its scene requests the effects that it calls for under `course`
/// and that the stage around it allows.
///
/// # Errors
/// Everything that is wrong with the case or its `stage.toml`; a case outside any stage.
pub fn load_case(path: &Path, course: &Course) -> Result<Case, Problems> {
    let folder = path.canonicalize().ok().and_then(|path| path.parent().map(Path::to_path_buf));
    let folder = folder.unwrap_or_else(|| path.parent().unwrap_or(Path::new("")).to_path_buf());
    let about = path.with_file_name("stage.toml");
    let raw = raw_stage(&about, None);
    let allows = raw.as_ref().map_or_else(|_| Effects::all(), allowed);
    let case = case(path, &file_name(&folder), allows, course);
    both(raw, case).map(|(_, case)| case)
}

/// The effects that the stage around the file at `path` allows; all of them for a file outside any stage.
///
/// # Errors
/// Everything that is wrong with the `stage.toml`.
pub fn allowed_at(path: &Path) -> Result<Effects, Problems> {
    if is_case(path) { Ok(allowed(&raw_stage(&path.with_file_name("stage.toml"), None)?)) } else { Ok(Effects::all()) }
}

/// Both values, or the problems of both.
fn both<A, B>(a: Result<A, Problems>, b: Result<B, Problems>) -> Result<(A, B), Problems> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(a), Err(b)) => Err(a.and(b)),
        (Err(problems), _) | (_, Err(problems)) => Err(problems),
    }
}

/// All values, or all problems.
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

/// Returns the stage in `folder` with the base of a first stage; `before` names the earlier stages.
fn stage(folder: &Path, before: &[String], course: &Course) -> Result<Stage, Problems> {
    let id = file_name(folder);
    let raw = raw_stage(&folder.join("stage.toml"), Some(before));
    let allows = raw.as_ref().map_or_else(|_| Effects::all(), allowed);
    let files = entries(folder)?;
    let cases = files.iter().filter(|path| is_case(path)).map(|path| case(path, &id, allows, course)).collect();
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
        cases,
        checks,
    })
}

/// The unit checks of the files in `folder`, if there is such a folder.
fn checks(folder: &Path, stage: &str, allows: Effects, course: &Course) -> Result<Vec<Check>, Problems> {
    let files = if folder.is_dir() { entries(folder)? } else { vec![] };
    let files = files.iter().filter(|path| is_toml(path));
    all(files.map(|path| checks::load(path, stage, allows, course)).collect()).map(|lists| lists.concat())
}

fn raw_stage(path: &Path, before: Option<&[String]>) -> Result<RawStage, Problems> {
    let (raw, mut notes) = scene::document::<RawStage>(&path.display().to_string(), &scene::read(path)?);
    if let (Some(raw), Some(before)) = (&raw, before) {
        for name in raw.needs.iter().filter(|name| !before.contains(name)) {
            let message = format!("no earlier stage is called `{}`", name.value);
            let problem = notes.add(name.span.clone(), message, "a stage can only need an earlier one");
            problem.help(format!("earlier stages: {}", quoted(before.iter().map(String::as_str))));
        }
    }
    notes.finish(raw)
}

fn allowed(raw: &RawStage) -> Effects {
    raw.allows.iter().map(|name| name.0).collect()
}

/// Returns the case at `path` in the stage of that id.
fn case(path: &Path, stage: &str, allows: Effects, course: &Course) -> Result<Case, Problems> {
    parse_case(path, &scene::read(path)?, stage, allows, course)
}

/// Returns the case that a file with this `text` at `path` is, in the stage of that id, which
/// `allows` these effects, under `course`. Nothing but the meshes of the scene is read.
///
/// # Errors
/// Everything that is wrong with the text.
pub fn parse_case(path: &Path, text: &str, stage: &str, allows: Effects, course: &Course) -> Result<Case, Problems> {
    let (raw, mut notes) = scene::document::<RawCase>(&path.display().to_string(), text);
    let found = raw.and_then(|raw| {
        let base = path.parent().unwrap_or(Path::new(""));
        let bounds = raw.vary.as_ref().map(|vary| vary::bounds(vary, raw.scene.0.as_ref(), &mut notes));
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

/// Removes the effects from `scene` that neither the stage allows nor the programs of the course always
/// simulate. An effect that no tracer can leave out of the picture is a problem instead.
pub(super) fn limit(scene: &mut Scene, allows: Effects, course: &Course, notes: &mut Notes) {
    let allows = allows.union(course.always_simulated);
    for reason in effects::reasons(scene, course).iter().filter(|reason| scene.effects.has(reason.effect)) {
        let must_be_allowed = matches!(reason.effect, Effect::Transforms | Effect::Attenuation);
        if must_be_allowed && !allows.has(reason.effect) {
            let message = format!("this stage does not allow {}: {}", reason.effect, reason.because);
            notes.add(0..0, message, "").help("change the scene, or add the effect to `allows` in stage.toml");
        }
    }
    scene.effects = scene.effects.intersection(allows);
}

/// What is in `folder`, ordered by name.
pub(super) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Problems> {
    let list = || std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>();
    let mut paths = list().map_err(|why| Problems::of_listing(folder, &why))?;
    paths.sort();
    Ok(paths)
}

pub(super) fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|end| end == "toml") && path.is_file()
}

pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
