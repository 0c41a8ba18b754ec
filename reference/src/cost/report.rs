//! What a sweep found, as plain data: every output is a function of it.

use cases::{Effect, Scene};
use serde::Serialize;

use super::error::Error;
use super::forms::Forms;
use super::front::{Times, front};
use super::measure::Measured;
use super::plot::Plot;
use super::setting::Setting;
use super::sweep::{About, Sweep};
use super::{advice, csv, page, table};
use crate::cutoff::Limits;
use crate::rules::Rules;
use crate::watch::Counts;

/// On what a sweep was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor, as the system names it.
    pub processor: String,
    /// Threads that rendered.
    pub threads: usize,
    /// What times are of: `processor time` of one thread, which other programs hardly disturb, or else `wall clock`.
    pub clock: &'static str,
    /// Whether the program was compiled with optimisation; if not, times say little.
    pub is_optimised: bool,
}

/// The price of a scene's accuracy. Times are of rendering alone: loading the scene and writing the picture are not in it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Version of this form.
    pub schema: u32,
    /// What was asked for: a file, or the id of a case.
    pub scene: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// On what it was measured.
    pub machine: Machine,
    /// Times that each setting was timed.
    pub rounds: usize,
    /// How the scene itself would be rendered.
    pub own: Setting,
    /// What all others are compared with.
    pub truth: Setting,
    /// Whether it was stopped before all rounds were done.
    pub is_cut_short: bool,
    /// What to pick, in sentences.
    pub advice: Vec<String>,
    /// A row a setting.
    pub rows: Vec<Row>,
    /// What each effect costs.
    pub effects: Vec<EffectRow>,
}

/// One setting.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// In words.
    pub name: String,
    /// The same as numbers.
    #[serde(flatten)]
    pub setting: Setting,
    /// Milliseconds.
    pub time_ms: Times,
    /// Rays by kind.
    pub rays: Counts,
    /// The scene made ready for rays, and the picture in the scalars it is computed with.
    pub bytes: usize,
    /// Proven: rays that were left out for depth or threshold darken no pixel by more than this, in linear light; none where nothing bounds it.
    pub left_out_at_most: Option<f64>,
    /// Against the truth.
    pub error: Error,
    /// Against the most accurate setting with as many rays a pixel: what precision, formulas, depth and threshold do, without what samples do.
    pub same_rays: Error,
    /// What precision and formulas alone do: against f64 and the robust formulas, all else the same.
    pub rounding: Option<Error>,
    /// Whether no other setting is as fast and as near to the truth (root mean square, in levels, to three digits) and better in one of both.
    pub is_on_front: bool,
    /// The same among the settings with one ray a pixel, by `same_rays`.
    pub is_on_same_rays_front: bool,
}

/// One effect, the scene as it stands being the other choice.
#[derive(Clone, Debug, Serialize)]
pub struct EffectRow {
    /// Such as `without shadows`.
    pub name: String,
    /// The effect that is left out; none where all are simulated.
    pub without: Option<Effect>,
    /// Milliseconds.
    pub time_ms: Times,
    /// The median, less that of the scene as it stands.
    pub more_ms: f64,
    /// Rays by kind.
    pub rays: Counts,
    /// How the picture differs from the scene as it stands.
    pub error: Error,
}

impl Report {
    /// What `measured` comes to, of `scene` by `rules`; `n_rounds` were asked for.
    pub fn new(
        name: &str,
        scene: &Scene,
        rules: &Rules,
        machine: Machine,
        sweep: &Sweep,
        measured: &[Measured],
        n_rounds: usize,
    ) -> Self {
        let rounds = measured.first().map_or(0, |row| row.times_s.len());
        let mut report = Self {
            schema: 1,
            scene: shown(name),
            width: scene.render.width,
            height: scene.render.height,
            machine,
            rounds,
            own: sweep.own,
            truth: sweep.truth,
            is_cut_short: rounds < n_rounds,
            advice: Vec::new(),
            rows: rows(sweep, measured, &Limits::of(scene, rules, sweep.own.effects)),
            effects: effects(sweep, measured),
        };
        report.advice = advice::advice(&report);
        report
    }

    /// The row of a setting.
    pub fn row(&self, setting: &Setting) -> Option<&Row> {
        self.rows.iter().find(|row| row.setting == *setting)
    }
}

impl Forms for Report {
    fn text(&self) -> String {
        table::text(self)
    }

    fn csv(&self) -> Result<Vec<u8>, ::csv::Error> {
        csv::csv(self)
    }

    fn plots(&self) -> Vec<Plot> {
        page::plots(self).into()
    }

    fn page(&self) -> String {
        page::page(self)
    }
}

fn rows(sweep: &Sweep, measured: &[Measured], limits: &Limits) -> Vec<Row> {
    let mut rows: Vec<Row> =
        measured.iter().filter(|one| one.about == About::Accuracy).map(|one| row(one, limits)).collect();
    let all: Vec<(f64, f64)> =
        rows.iter().map(|row| (row.time_ms.median, three_digits(row.error.rms_levels))).collect();
    let outside = (f64::NAN, f64::NAN);
    let same = |row: &Row| (row.time_ms.median, three_digits(row.same_rays.rms_levels));
    let same: Vec<_> =
        rows.iter().map(|row| if row.setting.samples == sweep.own.samples { same(row) } else { outside }).collect();
    for ((row, is_on), is_on_same) in rows.iter_mut().zip(front(&all)).zip(front(&same)) {
        (row.is_on_front, row.is_on_same_rays_front) = (is_on, is_on_same);
    }
    rows
}

/// So that of two errors that nobody would tell apart neither is the lesser.
fn three_digits(error: f64) -> f64 {
    format!("{error:.2e}").parse().unwrap_or(error)
}

fn row(one: &Measured, limits: &Limits) -> Row {
    Row {
        name: one.setting.to_string(),
        setting: one.setting,
        time_ms: milliseconds(one),
        rays: one.stats.rays,
        bytes: one.bytes,
        left_out_at_most: Some(limits.of_weight(one.stats.left_out.into()).max_element())
            .filter(|most| most.is_finite()),
        error: one.error,
        same_rays: one.same_rays,
        rounding: one.rounding,
        is_on_front: false,
        is_on_same_rays_front: false,
    }
}

fn effects(sweep: &Sweep, measured: &[Measured]) -> Vec<EffectRow> {
    let own = measured.iter().find(|one| one.about == About::Accuracy && one.setting == sweep.own);
    let own_ms = own.map_or(f64::NAN, |own| milliseconds(own).median);
    let row = |one: &Measured| {
        let (name, without) = match one.about {
            About::Accuracy => return None,
            About::Without(effect) => (format!("without {effect}"), Some(effect)),
            About::Everything => ("with every effect there is".to_owned(), None),
        };
        let time_ms = milliseconds(one);
        let more_ms = time_ms.median - own_ms;
        Some(EffectRow { name, without, time_ms, more_ms, rays: one.stats.rays, error: one.error })
    };
    measured.iter().filter_map(row).collect()
}

fn milliseconds(one: &Measured) -> Times {
    Times::of(&one.times_s.iter().map(|seconds| 1e3 * seconds).collect::<Vec<_>>())
}

/// A name from the command line without what could steer a terminal or hide.
fn shown(name: &str) -> String {
    let is_hidden = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fffe}'..='\u{ffff}')
    };
    name.chars().map(|c| if is_hidden(c) { c.escape_unicode().to_string() } else { c.to_string() }).collect()
}
