//! The command `reference effects --measure`.

use std::fmt::Write;

use cases::effects;
use pages::figures::{figure, percent};

use super::args::EffectsArgs;
use super::cost_session::Session;
use super::find::{self, Found};
use super::output::{Talk, print_json, print_text};
use super::stop::Stop;
use crate::cost::figures::signed;
use crate::cost::idle::{EffectCost, EffectCosts, Without};
use crate::cost::sweep::Sweep;
use crate::rules::Rules;

/// Runs the command.
pub(super) fn run(args: &EffectsArgs, talk: Talk) -> Result<(), Stop> {
    let Found { scene, course, .. } =
        find::found(args.scene.as_deref().unwrap_or_default(), &args.course)?;
    let session = Session::start(1, talk)?;
    let (rules, sweep) = (Rules::of(&course), Sweep::of_effects(&scene));
    let measured = session.sweep(&scene, &rules, &sweep, usize::from(args.rounds))?;
    let costs = EffectCosts::new(&scene, effects::reasons(&scene, &course), &measured);
    if args.json {
        print_json(&costs)?;
    } else {
        print_text(&text(&costs))?;
    }
    session.end(costs.rounds, args.rounds)
}

fn text(costs: &EffectCosts) -> String {
    let EffectCosts { n_pixels, rounds, time_ms, rays, effects } = costs;
    let mut text = format!(
        "{n_pixels} pixels, {} rays, {} ms (median of {rounds} rounds, {} to {})\n\n\
            {:<15} {:>16}  {:>12}  {:>10}\n",
        rays.total(),
        figure(time_ms.median),
        figure(time_ms.least),
        figure(time_ms.greatest),
        "without",
        "pixels changed",
        "rays",
        "ms",
    );
    for row in effects {
        let _ = writeln!(text, "{}", line(costs, row));
    }
    text
}

fn line(costs: &EffectCosts, row: &EffectCost) -> String {
    let EffectCost { because, without, .. } = row;
    let (effect, verdict) = (row.effect.name(), row.need().says());
    let Some(Without { n_changed, time_ms, rays }) = without else {
        return format!("{effect:<15} {verdict}: {because}");
    };
    let share = percent(*n_changed as f64 / costs.n_pixels.max(1) as f64);
    let more_rays = rays.total() as i128 - costs.rays.total() as i128;
    // Where the ranges overlap, or a single round has none, the difference may be noise.
    let is_clear = costs.rounds > 1
        && (time_ms.least > costs.time_ms.greatest || time_ms.greatest < costs.time_ms.least);
    let more_ms =
        if is_clear { signed(time_ms.median - costs.time_ms.median) } else { "~0".to_owned() };
    format!(
        "{effect:<15} {:>16}  {more_rays:>+12}  {more_ms:>10}  {verdict}: {because}",
        format!("{n_changed} ({share})"),
    )
}
