//! What can be typed after `reference cost`.

use std::path::PathBuf;

use clap::Parser;

use super::values::{CourseArg, size, threshold};
use crate::cost::functions::Candidate;
use crate::cost::setting::Formula;
use crate::cost::sweep::{Axes, finer};
use crate::rules::Robustness;
use crate::variations::Precision;

/// Measures what accuracy costs: time against error over precision, formulas, samples, depth,
/// threshold and effects
#[derive(Debug, Parser)]
#[command(after_help = "\
Measured are precision × formula × samples in full around the scene's own depth and threshold,
then at one ray a pixel precision × formula at the greatest depth, each depth and each threshold
alone, then the scene without each of its effects. Nothing that the scene does not call for is
swept. Errors are differences from the most accurate picture: f64, robust, twice the most samples
a side, the greatest depth, no threshold; and from the most accurate one with as many rays a
pixel. Formulas: `plain` is what most tracers have (textbook quadratic, Möller–Trumbore,
RAY_EPSILON), `stable` does not cancel, `robust` is the reference's own. Each round takes every
setting once. Ctrl-C ends the measurement after the picture at hand; the rounds done by then are
reported.

Examples:
  reference cost 04_refraction/crystal_ball
  reference cost scene.toml --samples 1,2,4,8 --rounds 9 --html cost.html
  reference cost 03_reflection/hall_of_mirrors --depths 0,1,2,4 --precisions f64 --no-effects
  reference cost scene.toml --thresholds 0,1/256,1/64 --csv - > cost.csv
  reference cost --functions --draws 100000 --html functions.html
  reference cost --functions --formulas robust --draws 1000000 --rounds 1
  reference cost --page docs/accuracy.md
  reference cost --store

Exit codes: 0 done, 2 usage, a file that cannot be read or a name that cannot be written, 3 the
disk is full, say, 130 interrupted")]
pub(super) struct CostArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    #[arg(required_unless_present_any = ["functions", "page", "store"])]
    pub scene: Option<String>,
    /// One function at a time instead: nanoseconds against errors and wrong decisions, over
    /// families of hard questions
    #[arg(long, conflicts_with = "scene")]
    pub functions: bool,
    /// Questions a family for --functions and --page
    #[arg(
        long,
        value_name = "N",
        default_value = "2000",
        value_parser = clap::value_parser!(u64).range(1..=1_000_000_000)
    )]
    pub draws: u64,
    /// Writes the page of the documentation, docs/accuracy.md, and its pictures beside it; some
    /// minutes
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["scene", "functions", "store", "json", "csv", "svg", "html"]
    )]
    pub page: Option<PathBuf>,
    /// Measures all cases of ./cases/stages briefly and stores it as fronts.json beside them, for
    /// students' reports
    #[arg(long, conflicts_with_all = ["scene", "functions", "json", "csv", "svg", "html"])]
    pub store: bool,
    /// Scalars to measure [default: f32,f64]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = precision)]
    pub precisions: Option<Vec<Precision>>,
    /// Formulas to measure; with --functions `robust` or others [default: plain,stable,robust]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = formula)]
    pub formulas: Option<Vec<Formula>>,
    /// N for N x N rays a pixel [default: 1,2,4]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=64)
    )]
    pub samples: Option<Vec<u32>>,
    /// Rays a side of a pixel of the truth [default: twice the most of --samples]
    #[arg(
        long,
        conflicts_with = "functions",
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=256)
    )]
    pub truth: Option<u32>,
    /// Depths of recursion [default: from 0 to a little beyond the scene's own]
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
    /// Every setting with every other
    #[arg(long, conflicts_with = "functions")]
    pub full: bool,
    /// Leave out what effects cost
    #[arg(long, conflicts_with = "functions")]
    pub no_effects: bool,
    /// Times that each setting is timed
    #[arg(
        long,
        value_name = "N",
        default_value = "5",
        value_parser = clap::value_parser!(u16).range(1..=1000)
    )]
    pub rounds: u16,
    /// Threads; of one, processor time is measured, which other programs hardly disturb; of more,
    /// the wall clock
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u16).range(1..=1024)
    )]
    pub threads: u16,
    /// Pixels, such as 640x480, in the place of the scene's
    #[arg(long, conflicts_with = "functions", value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// All figures as JSON; `-` is the output stream, in the place of the table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// The table as CSV; `-` as above
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Error against time as a picture; `-` as above
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Tables and pictures as a page that needs nothing else; `-` as above
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub course: CourseArg,
}

impl CostArgs {
    /// Whether a function's formula is among those typed: `robust` is the reference's own, `plain`
    /// and `stable` are all others.
    pub(super) fn asks_for(&self, candidate: &Candidate) -> bool {
        let is_own = candidate.rules.style.robustness == Robustness::Certified;
        let has_formula = |formulas: &Vec<Formula>| {
            formulas.iter().any(|formula| (*formula == Formula::Robust) == is_own)
        };
        let has_precision = |precisions: &Vec<Precision>| precisions.contains(&candidate.precision);
        self.formulas.as_ref().is_none_or(has_formula)
            && self.precisions.as_ref().is_none_or(has_precision)
    }

    /// The axes of a scene, narrowed to what was typed.
    pub(super) fn narrowed(&self, axes: Axes) -> Axes {
        let samples = self.samples.clone().unwrap_or(axes.samples);
        Axes {
            precisions: self.precisions.clone().unwrap_or(axes.precisions),
            formulas: self.formulas.clone().unwrap_or(axes.formulas),
            truth_samples: self.truth.unwrap_or_else(|| finer(&samples)),
            samples,
            depths: self.depths.clone().unwrap_or(axes.depths),
            thresholds: self.thresholds.clone().unwrap_or(axes.thresholds),
            full: self.full,
            effects: !self.no_effects,
        }
    }
}

fn precision(text: &str) -> Result<Precision, String> {
    let known = [Precision::F32, Precision::F64];
    known.into_iter().find(|p| p.says() == text).ok_or_else(|| "f32 or f64".to_owned())
}

fn formula(text: &str) -> Result<Formula, String> {
    Formula::ALL
        .into_iter()
        .find(|f| f.name() == text)
        .ok_or_else(|| "plain, stable or robust".to_owned())
}
