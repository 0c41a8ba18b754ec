//! The arguments of `reference cost`.

use std::path::PathBuf;

use clap::Parser;

use super::values::{CourseArg, formula, size, threshold};
use crate::cost::functions::Candidate;
use crate::cost::setting::Formula;
use crate::cost::sweep::{Axes, finer};
use crate::expect::variations::Precision;
use crate::rules::Robustness;

/// Measures what accuracy costs: time against error over precision, formulas, samples, depth,
/// threshold and effects
#[derive(Debug, Parser)]
#[command(after_help = "\
The command answers three questions, each with its own error and price. Rounding: precision and
formula, in kernels compiled alike, against f64 with the robust formulas. Depth: recursion and
cut-offs, against the greatest depth without cut-offs. Sampling: rays per pixel, against twice the
most of --samples per side; `adaptive` casts them only through pixels that differ from a neighbour.
It also renders the scene without each of its effects, with all effects and, for up to 1000 objects
and triangles, without trees. Depth and threshold vary only if the scene calls for reflection or
refraction. Formulas: `plain` is what most tracers use (textbook quadratic, Möller–Trumbore,
RAY_EPSILON), `stable` does not cancel, `robust` is the reference's own. Each round renders every
setting once. No setting counts as faster than another where their times overlap, so one round
gives figures without advice. Ctrl-C ends the measurement after the current picture; the finished
rounds are reported.

Examples:
  reference cost 04_refraction/crystal_ball
  reference cost scene.toml --samples 1,2,4,8 --rounds 9 --html cost.html
  reference cost 03_reflection/hall_of_mirrors --depths 0,1,2,4 --precisions f64 --no-effects
  reference cost scene.toml --thresholds 0,1/256,1/64 --csv - > cost.csv
  reference cost --functions --draws 100000 --html functions.html
  reference cost --functions --formulas robust --draws 1000000 --rounds 1
  reference cost --page docs/accuracy.md
  reference cost --store
  reference cost --check

Exit codes: 0 done, 2 usage, a file that cannot be read or a name that cannot be written, 3 the
machine failed, such as a full disk, 130 interrupted")]
pub(super) struct CostArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    #[arg(required_unless_present_any = ["functions", "page", "store", "check"])]
    pub scene: Option<String>,
    /// Measure one function at a time instead: nanoseconds against errors and wrong decisions, over
    /// families of hard questions
    #[arg(long, conflicts_with = "scene")]
    pub functions: bool,
    /// Number of questions per family for --functions and --page
    #[arg(
        long,
        value_name = "N",
        default_value = "2000",
        value_parser = clap::value_parser!(u64).range(1..=1_000_000_000)
    )]
    pub draws: u64,
    /// Write the page of the documentation, docs/accuracy.md, and its pictures beside it; this
    /// takes some minutes
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["scene", "functions", "store", "json", "csv", "svg", "html"]
    )]
    pub page: Option<PathBuf>,
    /// Measure all cases of ./cases/stages briefly and store the points as fronts.json beside them,
    /// for students' reports
    #[arg(long, conflicts_with_all = ["scene", "functions", "json", "csv", "svg", "html"])]
    pub store: bool,
    /// Report which of the stored figures in docs and cases/stages were measured on other code or
    /// cases than those of this workspace; stale figures do not change the exit code
    #[arg(
        long,
        conflicts_with_all = ["scene", "functions", "page", "store", "json", "csv", "svg", "html"]
    )]
    pub check: bool,
    /// Precisions to measure [default: f32,f64]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = precision)]
    pub precisions: Option<Vec<Precision>>,
    /// Formulas to measure; with --functions `robust` or others [default: plain,stable,robust]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = formula)]
    pub formulas: Option<Vec<Formula>>,
    /// N for N x N rays per pixel [default: 1,2,4]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=64)
    )]
    pub samples: Option<Vec<u32>>,
    /// N for N x N rays per pixel of the most accurate picture [default: twice the most of
    /// --samples]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=256)
    )]
    pub truth: Option<u32>,
    /// Depths of recursion [default: from 0 to a little beyond the scene's own]; the advice keeps
    /// the scene's own depth unless this, --thresholds or --light-cutoffs is given
    #[arg(long, conflicts_with = "functions", value_name = "LIST", value_delimiter = ',')]
    pub depths: Option<Vec<u32>>,
    /// Weights below which paths end, 0 for never [default: 0, 1e-3, 1/256, 1/64, 1/16 and the
    /// scene's own]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = threshold
    )]
    pub thresholds: Option<Vec<f64>>,
    /// Light below which a light source is skipped at a point, 0 for never [default: 0, 1e-3, 1/256
    /// and 1/64 if a light weakens with distance]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = threshold
    )]
    pub light_cutoffs: Option<Vec<f64>>,
    /// Measure every combination of precision, formulas, samples, depths and thresholds
    #[arg(long, conflicts_with = "functions")]
    pub full: bool,
    /// Do not measure the cost of effects and trees
    #[arg(long, conflicts_with = "functions")]
    pub no_effects: bool,
    /// Number of times that each setting is timed
    #[arg(
        long,
        value_name = "N",
        default_value = "5",
        value_parser = clap::value_parser!(u16).range(1..=1000)
    )]
    pub rounds: u16,
    /// Number of threads; one is measured by processor time, which other programs hardly disturb,
    /// more by the wall clock
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u16).range(1..=1024)
    )]
    pub threads: u16,
    /// Pixels, such as 640x480, instead of the scene's
    #[arg(long, conflicts_with = "functions", value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// All figures as JSON; `-` is the output stream, instead of the table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// The table as CSV; `-` as above
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Error against time as an SVG picture; `-` as above
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Tables and pictures as one self-contained HTML page; `-` as above
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub course: CourseArg,
}

impl CostArgs {
    /// Returns whether the formula and precision of `candidate` are selected. `robust` selects the
    /// reference's own formulas, `plain` and `stable` select all others.
    pub(super) fn wants(&self, candidate: &Candidate) -> bool {
        let is_own = candidate.rules.style.robustness == Robustness::Certified;
        let has_formula = |formulas: &Vec<Formula>| {
            formulas.iter().any(|formula| (*formula == Formula::Robust) == is_own)
        };
        let has_precision = |precisions: &Vec<Precision>| precisions.contains(&candidate.precision);
        self.formulas.as_ref().is_none_or(has_formula)
            && self.precisions.as_ref().is_none_or(has_precision)
    }

    /// Returns the axes of a scene, narrowed by the arguments.
    pub(super) fn narrowed(&self, axes: Axes) -> Axes {
        let samples = self.samples.clone().unwrap_or(axes.samples);
        Axes {
            precisions: self.precisions.clone().unwrap_or(axes.precisions),
            formulas: self.formulas.clone().unwrap_or(axes.formulas),
            truth_samples: self.truth.unwrap_or_else(|| finer(&samples)),
            samples,
            depths: self.depths.clone().unwrap_or(axes.depths),
            thresholds: self.thresholds.clone().unwrap_or(axes.thresholds),
            light_cutoffs: self.light_cutoffs.clone().unwrap_or(axes.light_cutoffs),
            varies_depth: self.depths.is_some()
                || self.thresholds.is_some()
                || self.light_cutoffs.is_some(),
            full: self.full,
            effects: !self.no_effects,
        }
    }
}

fn precision(text: &str) -> Result<Precision, String> {
    let known = [Precision::F32, Precision::F64];
    known.into_iter().find(|p| p.says() == text).ok_or_else(|| "f32 or f64".to_owned())
}
