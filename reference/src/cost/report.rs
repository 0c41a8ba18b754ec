//! The result of a sweep as plain data. Every output is a function of it.

use cases::Effect;
use serde::Serialize;

use super::error::Error;
use super::setting::Setting;
use super::times::Times;
use crate::watch::Counts;

/// The machine that a sweep was measured on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// The model of the processor, as the system names it.
    pub processor: String,
    /// The number of threads that rendered.
    pub threads: usize,
    /// The kind of the times: `processor time` of one thread, which other programs hardly disturb,
    /// or `wall clock` with several threads.
    pub clock: &'static str,
    /// Whether the program was compiled with optimisation. Without it, times say little.
    pub is_optimised: bool,
}

/// The cost of a scene's accuracy. Times are those of rendering alone, without loading the scene
/// and writing the picture.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The version of this format.
    pub schema: u32,
    /// The scene as the user named it, guarded: a file, or the id of a case.
    pub scene: String,
    /// The number of pixels in a row.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
    /// The machine that it was measured on.
    pub machine: Machine,
    /// The number of times that each setting was timed.
    pub rounds: usize,
    /// The scene's own setting.
    pub own: Setting,
    /// The most accurate setting, which all others are compared with.
    pub truth: Setting,
    /// Whether the measurement was stopped before all rounds were complete.
    pub is_cut_short: bool,
    /// Advice on which setting to pick, in sentences.
    pub advice: Vec<String>,
    /// One row for each setting.
    pub rows: Vec<SettingRow>,
    /// The cost of each effect.
    pub effects: Vec<EffectRow>,
}

/// One setting.
#[derive(Clone, Debug, Serialize)]
pub struct SettingRow {
    /// The setting in words.
    pub name: String,
    /// The setting as numbers.
    #[serde(flatten)]
    pub setting: Setting,
    /// Milliseconds a picture.
    pub time_ms: Times,
    /// The rays by kind.
    pub rays: Counts,
    /// Bytes of the world that rays search, and of the picture in the scalars of the setting.
    pub bytes: usize,
    /// A proven bound in linear light: the rays that were left out for depth or threshold darken no
    /// pixel by more. `None` if there is no bound.
    pub left_out_at_most: Option<f64>,
    /// The error against the truth.
    pub error: Error,
    /// The error against the most accurate setting with as many rays a pixel. It has the error of
    /// precision, formulas, depth and threshold, but not of sampling.
    pub same_rays: Error,
    /// The error of precision and formulas alone: against f64 and the robust formulas, with
    /// everything else equal. `None` if that setting was not rendered.
    pub rounding: Option<Error>,
    /// Whether the setting is on the Pareto front of median time and error against the truth (root
    /// mean square, in levels, to three digits).
    pub is_on_front: bool,
    /// Whether the setting is on the Pareto front by `same_rays`, among the settings with as many
    /// rays a pixel as the scene's own setting.
    pub is_on_same_rays_front: bool,
}

/// The cost of one effect, compared with the scene's own setting.
#[derive(Clone, Debug, Serialize)]
pub struct EffectRow {
    /// The name of the row, such as `without shadows`.
    pub name: String,
    /// The effect that is left out; `None` if all are simulated.
    pub without: Option<Effect>,
    /// Milliseconds a picture.
    pub time_ms: Times,
    /// The median, minus the median of the scene's own setting.
    pub more_ms: f64,
    /// The rays by kind.
    pub rays: Counts,
    /// The difference of the picture from that of the scene's own setting.
    pub error: Error,
}

impl Report {
    /// Returns the row of a setting, or `None` if it was not measured.
    pub fn row(&self, setting: &Setting) -> Option<&SettingRow> {
        self.rows.iter().find(|row| row.setting == *setting)
    }
}
