//! What a sweep found, as plain data: every output is a function of it.

use cases::Effect;
use serde::Serialize;

use super::error::Error;
use super::front::Times;
use super::setting::Setting;
use crate::watch::Counts;

/// On what a sweep was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor, as the system names it.
    pub processor: String,
    /// Threads that rendered.
    pub threads: usize,
    /// What times are of: `processor time` of one thread, which other programs hardly disturb, or
    /// else `wall clock`.
    pub clock: &'static str,
    /// Whether the program was compiled with optimisation; if not, times say little.
    pub is_optimised: bool,
}

/// The price of a scene's accuracy. Times are of rendering alone: loading the scene and writing the
/// picture are not in it.
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
    /// Proven: rays that were left out for depth or threshold darken no pixel by more than this, in
    /// linear light; none where nothing bounds it.
    pub left_out_at_most: Option<f64>,
    /// Against the truth.
    pub error: Error,
    /// Against the most accurate setting with as many rays a pixel: what precision, formulas, depth
    /// and threshold do, without what samples do.
    pub same_rays: Error,
    /// What precision and formulas alone do: against f64 and the robust formulas, all else the
    /// same.
    pub rounding: Option<Error>,
    /// Whether no other setting is as fast and as near to the truth (root mean square, in levels,
    /// to three digits) and better in one of both.
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
    /// The row of a setting.
    pub fn row(&self, setting: &Setting) -> Option<&Row> {
        self.rows.iter().find(|row| row.setting == *setting)
    }
}
