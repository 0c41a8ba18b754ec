//! The command `reference effects`.

use cases::effects;
use serde::Serialize;

use super::args::EffectsArgs;
use super::effects_measured;
use super::find::{self, Found};
use super::output::{Talk, print_json, print_text};
use super::stop::Stop;

#[derive(Serialize)]
struct Row {
    effect: &'static str,
    called_for: bool,
    simulated: bool,
    because: String,
}

/// Runs the command.
pub(super) fn run(args: &EffectsArgs, talk: Talk) -> Result<(), Stop> {
    if args.measure {
        return effects_measured::run(args, talk);
    }
    let Found { scene, course, .. } = find::found(&args.scene, &args.course)?;
    let row = |reason: effects::Reason| Row {
        effect: reason.effect.name(),
        called_for: reason.called_for,
        simulated: scene.effects.has(reason.effect),
        because: reason.because,
    };
    let rows: Vec<Row> = effects::reasons(&scene, &course).into_iter().map(row).collect();
    if args.json {
        return print_json(&rows);
    }
    print_text(&rows.iter().map(line).collect::<String>())
}

fn line(row: &Row) -> String {
    let verdict = match (row.called_for, row.simulated) {
        (true, true) => "yes",
        (false, false) => "no",
        (true, false) => "yes, but left out here",
        (false, true) => "no, but simulated here",
    };
    format!("{:<15} {verdict}: {}\n", row.effect, row.because)
}
