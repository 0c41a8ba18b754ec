//! The output of `reference render --stats`: the simulated effects with their reasons, the rays and
//! work, and the times.

use std::fmt::Write;

use cases::effects::Reason;
use cases::glam::DVec3;
use cases::{Effects, Scene};
use pages::figures::figure;
use serde::Serialize;

use super::args::StatsForm;
use super::output::print;
use super::stop::Stop;
use crate::cost::figures::levels;
use crate::rules::Rules;
use crate::trace::cutoff::Limits;
use crate::trace::render::Stats;
use crate::watch::work::{Amounts, Work};
use crate::watch::{Counts, made_by};

/// The figures of a picture. Times are in seconds of wall clock; `render_s` includes the time of
/// counting.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) precision: &'static str,
    pub(super) samples: u32,
    /// Whether only pixels that differ from a neighbour have N × N rays.
    pub(super) adaptive: bool,
    pub(super) threads: usize,
    pub(super) effects: Effects,
    pub(super) rays: Counts,
    pub(super) work: Amounts,
    pub(super) by_effect: Vec<Row>,
    #[serde(flatten)]
    pub(super) left_out: LeftOut,
    pub(super) load_s: f64,
    pub(super) prepare_s: f64,
    pub(super) render_s: f64,
    pub(super) write_s: f64,
}

/// Bounds on the linear light that a pixel lacks because of depth, threshold and light cutoff.
/// [rule 13]
#[derive(Debug, Serialize)]
pub(super) struct LeftOut {
    /// The most by which the pixel is darker; `None` if it is unbounded.
    left_out_at_most: Option<f64>,
    /// The most by which each further level of rays makes a pixel brighter; `None` if it is
    /// unbounded, or if the levels grow.
    left_out_per_level_at_most: Option<f64>,
}

impl LeftOut {
    /// Returns the bounds for a picture with these figures.
    pub(super) fn of(scene: &Scene, rules: &Rules, stats: &Stats) -> Self {
        let limits = Limits::of(scene, rules, scene.effects);
        let level = limits.of_levels(stats.left_out.into(), 1).max_element();
        let grows = limits.sent_on.cmpgt(DVec3::ONE).any();
        Self {
            left_out_at_most: limits.of_picture(stats),
            left_out_per_level_at_most: Some(level).filter(|most| most.is_finite() && !grows),
        }
    }

    fn text(&self) -> String {
        let levels = |most| figure(levels(most));
        match (self.left_out_at_most, self.left_out_per_level_at_most) {
            (Some(0.0), _) => "nothing, for depth, threshold or light cutoff".to_owned(),
            (Some(most), _) => format!(
                "rays and light that darken no pixel by more than {} levels (proven)",
                levels(most)
            ),
            (None, Some(most)) => format!(
                "light without a bound, since a material with its own light has kr + kt of 1; each \
                    further level of rays adds at most {} levels to a pixel (proven)",
                levels(most)
            ),
            (None, None) => "light without a bound: some material has kr + kt above 1, or a light \
                grows without bound"
                .to_owned(),
        }
    }
}

/// An effect, with the reason for which it was simulated or not.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    effect: &'static str,
    called_for: bool,
    simulated: bool,
    because: String,
    /// The number of rays or units of work that the effect caused.
    made: u64,
    /// The name of these rays or units of work.
    of: &'static str,
}

impl Row {
    /// Returns a row for every effect, of which `simulated` were simulated.
    pub(super) fn all(
        reasons: Vec<Reason>,
        simulated: Effects,
        rays: &Counts,
        work: &Amounts,
    ) -> Vec<Self> {
        let row = |Reason { effect, called_for, because }| {
            let (made, of) = made_by(effect, rays, work);
            Self {
                effect: effect.name(),
                called_for,
                simulated: simulated.has(effect),
                because,
                made,
                of,
            }
        };
        reasons.into_iter().map(row).collect()
    }

    fn line(&self) -> String {
        let Self { effect, because, made, of, .. } = self;
        match (self.simulated, self.called_for) {
            (true, true) => format!("  {effect:<15} {made} {of}: {because}\n"),
            (true, false) => {
                format!("  {effect:<15} {made} {of}, though not called for: {because}\n")
            }
            (false, true) => format!("  {effect:<15} left out, though called for: {because}\n"),
            (false, false) => format!("  {effect:<15} not called for: {because}\n"),
        }
    }
}

impl Report {
    /// Prints the report to the output stream, or to the error stream if the picture went to the
    /// output stream.
    pub(super) fn say(&self, form: StatsForm, to_errors: bool) -> Result<(), Stop> {
        let text = match form {
            StatsForm::Json => {
                serde_json::to_string_pretty(self)
                    .map_err(Stop::machine("cannot encode the report"))?
                    + "\n"
            }
            StatsForm::Text => self.text(),
        };
        if to_errors {
            pages::say::err(&text);
            return Ok(());
        }
        print(text.as_bytes())
    }

    fn text(&self) -> String {
        let Counts { eye, shadow, reflected, refracted } = self.rays;
        let amounts = |works: &[Work]| {
            let done = works.iter().filter(|work| self.work.of(**work) > 0);
            let all: Vec<_> =
                done.map(|work| format!("{} {}", self.work.of(*work), work.name())).collect();
            if all.is_empty() { "nothing".to_owned() } else { all.join(", ") }
        };
        let mut text = format!(
            "picture    {}x{}, {}{} per pixel, {}, {} threads\n\
                rays       {eye} eye, {shadow} shadow, {reflected} reflected, {refracted} \
                refracted\n",
            self.width,
            self.height,
            if self.adaptive { "1 or " } else { "" },
            self.samples * self.samples,
            self.precision,
            self.threads,
        );
        let search = amounts(&[Work::ObjectNode, Work::Object, Work::MeshNode, Work::Triangle]);
        let shading = amounts(&[
            Work::Power,
            Work::FaintLight,
            Work::VanishingLight,
            Work::UntintedRay,
            Work::SureMiss,
        ]);
        let _ = writeln!(text, "search     {search}\nshading    {shading}\neffects");
        text.extend(self.by_effect.iter().map(Row::line));
        text += "  (`reference effects SCENE` counts the pixels that each effect changes)\n";
        let _ = writeln!(
            text,
            "left out   {}\nseconds    load {:.4}, prepare {:.4}, render {:.4} (with \
                counting), write {:.4}",
            self.left_out.text(),
            self.load_s,
            self.prepare_s,
            self.render_s,
            self.write_s,
        );
        text
    }
}
