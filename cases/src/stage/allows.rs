//! The effects that a stage allows, and scenes that call for others.

use std::path::Path;

use super::folder::is_case;
use super::raw::RawStage;
use crate::course::Course;
use crate::effects::{self, Effect, Effects};
use crate::problem::{Problems, quoted};
use crate::scene::raw::read::Notes;
use crate::scene::{self, Scene};

/// Returns the effects that the stage around the file at `path` allows, or all effects for a file
/// outside any stage.
///
/// # Errors
/// All problems of the `stage.toml`.
pub fn allowed_at(path: &Path) -> Result<Effects, Problems> {
    if is_case(path) {
        Ok(allowed(&raw_stage(&path.with_file_name("stage.toml"), None)?))
    } else {
        Ok(Effects::all())
    }
}

/// Returns the stage file at `path` as it is written. If `before` names the earlier stages, the
/// stage may need no others.
pub(super) fn raw_stage(path: &Path, before: Option<&[String]>) -> Result<RawStage, Problems> {
    let (raw, mut notes) =
        scene::document::<RawStage>(&path.display().to_string(), &scene::read(path)?);
    if let (Some(raw), Some(before)) = (&raw, before) {
        for name in raw.needs.iter().filter(|name| !before.contains(name)) {
            let message = format!("no earlier stage is called `{}`", name.value);
            let problem =
                notes.add(name.span.clone(), message, "a stage can only need an earlier one");
            problem.help(format!("earlier stages: {}", quoted(before.iter().map(String::as_str))));
        }
    }
    notes.finish(raw)
}

/// Returns the effects that the stage file lists.
pub(super) fn allowed(raw: &RawStage) -> Effects {
    raw.allows.iter().map(|name| name.0).collect()
}

/// Removes the effects from `scene` that neither the stage allows nor the programs of the course
/// always simulate. An effect that no tracer can leave out of the picture is also noted as a
/// problem.
pub(super) fn limit(scene: &mut Scene, allows: Effects, course: &Course, notes: &mut Notes) {
    let allows = allows.union(course.always_simulated);
    for reason in
        effects::reasons(scene, course).iter().filter(|reason| scene.effects.has(reason.effect))
    {
        let must_be_allowed = matches!(reason.effect, Effect::Transforms | Effect::Attenuation);
        if must_be_allowed && !allows.has(reason.effect) {
            let message =
                format!("this stage does not allow {}: {}", reason.effect, reason.because);
            notes
                .add(0..0, message, "")
                .help("change the scene, or add the effect to `allows` in stage.toml");
        }
    }
    scene.effects = scene.effects.intersection(allows);
}
