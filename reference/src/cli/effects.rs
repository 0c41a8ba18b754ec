//! The command `reference effects`.

use std::path::Path;

use cases::{effects, files};
use pages::say;
use serde::Serialize;

use super::args::EffectsArgs;
use super::effects_measured;
use super::find::{self, Found};
use super::output::{Talk, print_json, print_text};
use super::stop::Stop;
use crate::cost::effects_document::{SCENES, Subject, markdown};
use crate::cost::need::Need;
use crate::cost::view::{Done, EffectInView, View};
use crate::rules::Rules;

/// The number of rays beyond which a picture is not examined unless `--max-rays` allows it.
const MOST_RAYS: u64 = 20_000_000;

#[derive(Serialize)]
struct Row<'a> {
    #[serde(flatten)]
    effect: &'a EffectInView,
    need: Need,
}

/// Runs the command.
pub(super) fn run(args: &EffectsArgs, talk: Talk) -> Result<(), Stop> {
    if args.measure {
        return effects_measured::run(args, talk);
    }
    let most_rays = args.max_rays.unwrap_or(MOST_RAYS);
    if let Some(path) = &args.page {
        return write_page(path, args, most_rays, talk);
    }
    let view = view(args.scene.as_deref().unwrap_or_default(), args, most_rays)?;
    if view.rays.is_none() && talk >= Talk::Normal {
        say::err(&format!(
            "warning: the picture takes more than {most_rays} rays, so that idle effects are not \
                found\nhelp: --max-rays N allows more"
        ));
    }
    if args.json {
        let rows = view.effects.iter().map(|effect| Row { effect, need: effect.need() });
        return print_json(&rows.collect::<Vec<_>>());
    }
    print_text(&view.effects.iter().map(line).collect::<String>())
}

fn view(named: &str, args: &EffectsArgs, most_rays: u64) -> Result<View, Stop> {
    let Found { scene, course, .. } = find::found(named, &args.course)?;
    let reasons = effects::reasons(&scene, &course);
    Ok(View::of(&scene, &Rules::of(&course), reasons, most_rays))
}

fn line(row: &EffectInView) -> String {
    let done = row.done.map_or_else(String::new, |Done { made, of, n_changed }| {
        let pixels = if n_changed == 1 { "pixel" } else { "pixels" };
        format!("; {made} {of} change {n_changed} {pixels}")
    });
    format!("{:<15} {}: {}{done}\n", row.effect.name(), row.need().says(), row.because)
}

/// Writes the page of the documentation.
fn write_page(path: &Path, args: &EffectsArgs, most_rays: u64, talk: Talk) -> Result<(), Stop> {
    files::check(path)?;
    let subject = |named| {
        let view = view(named, args, most_rays)?;
        if view.rays.is_none() {
            return Err(Stop::Usage(format!(
                "{named} takes more than {most_rays} rays\nhelp: --max-rays N allows more"
            )));
        }
        Ok(Subject { named, view })
    };
    let subjects = SCENES.into_iter().map(subject).collect::<Result<_, _>>()?;
    files::write(path, markdown(subjects).as_bytes())?;
    if talk >= Talk::Verbose {
        say::err(&format!("wrote {}", path.display()));
    }
    Ok(())
}
