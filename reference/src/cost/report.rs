//! The result of a sweep as plain data. Every output is a function of it.

use cases::Effect;
use serde::Serialize;

use super::error::Error;
use super::error_picture::ErrorPicture;
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
    /// Whether the measurement was stopped before all rounds were complete.
    pub is_cut_short: bool,
    /// What accuracy costs here and which setting to pick, in one sentence. After one round, times
    /// have no spread, and the sentence gives the reason why there is no advice.
    pub headline: String,
    /// The questions that were measured, each with its own error and price.
    pub questions: Vec<Question>,
    /// One row for each setting.
    pub rows: Vec<SettingRow>,
    /// The cost of each effect, and what trees save.
    pub effects: Vec<EffectRow>,
    /// Sentences on what belongs to no question: trees, the start of new rays, threads. None
    /// without advice.
    pub facts: Vec<String>,
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
    /// A proven bound in linear light: the rays and the lights that were left out for depth,
    /// threshold or light cut-off darken no pixel by more. `None` if there is no bound.
    pub left_out_at_most: Option<f64>,
    /// The error of precision and formulas alone: against f64 and the robust formulas, with
    /// everything else equal. `None` if that setting was not rendered.
    pub rounding: Option<Error>,
    /// The error of depth and cut-offs, and of rounding: against the deepest setting. `None` for
    /// another sampling than the scene's own.
    pub depth: Option<Error>,
    /// The error of sampling, and of rounding: against the most samples. `None` for another depth
    /// or cut-off than the scene's own.
    pub sampling: Option<Error>,
}

/// The choice that a question is about. All other choices are the scene's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Choice {
    /// Precision and formulas.
    Rounding,
    /// Depth of recursion, threshold and light cut-off.
    Depth,
    /// Rays a pixel.
    Sampling,
}

impl Choice {
    /// All choices, in the order of reports.
    pub const ALL: [Self; 3] = [Self::Rounding, Self::Depth, Self::Sampling];

    /// Returns the heading of the question.
    pub fn title(self) -> &'static str {
        match self {
            Self::Rounding => "Rounding: precision and formulas",
            Self::Depth => "Depth: recursion and cut-offs",
            Self::Sampling => "Sampling: rays a pixel",
        }
    }

    /// Returns the word for this choice in identifiers.
    pub fn word(self) -> &'static str {
        match self {
            Self::Rounding => "rounding",
            Self::Depth => "depth",
            Self::Sampling => "sampling",
        }
    }

    /// Returns the part of a setting's name that this choice decides.
    pub fn name(self, setting: &Setting) -> String {
        match self {
            Self::Rounding => setting.numbers_name(),
            Self::Depth => setting.depth_name(),
            Self::Sampling => setting.sampling_name(),
        }
    }

    /// Returns `own` with this choice as in `setting`.
    pub fn only(self, own: &Setting, setting: &Setting) -> Setting {
        match self {
            Self::Rounding => own.with_numbers_of(setting),
            Self::Depth => own.with_depth_of(setting),
            Self::Sampling => own.with_sampling_of(setting),
        }
    }
}

/// One choice: the settings that differ from the scene's own in nothing else.
#[derive(Clone, Debug, Serialize)]
pub struct Question {
    /// The choice.
    pub about: Choice,
    /// The setting that errors are against, in words.
    pub against: String,
    /// The answer in one sentence; empty without advice.
    pub answer: String,
    /// More sentences, one for each part of the choice that was measured; none without advice.
    pub facts: Vec<String>,
    /// The settings, sorted by time.
    pub rows: Vec<QuestionRow>,
}

impl Question {
    /// Returns the row of the scene's own setting.
    pub fn own(&self) -> Option<&QuestionRow> {
        self.rows.iter().find(|row| row.is_own)
    }

    /// Returns the row that is advised, if there is advice.
    pub fn pick(&self) -> Option<&QuestionRow> {
        self.rows.iter().find(|row| row.is_pick)
    }
}

/// A setting among those of a question.
#[derive(Clone, Debug, Serialize)]
pub struct QuestionRow {
    /// The part of the setting that the question is about, in words.
    pub name: String,
    /// The setting.
    #[serde(skip)]
    pub setting: Setting,
    /// The index of the setting in [`Report::rows`].
    pub row: usize,
    /// Milliseconds a picture.
    pub time_ms: Times,
    /// The median over the median of the scene's own setting.
    pub of_own: f64,
    /// The error that the question is about.
    pub error: Error,
    /// The share of the pixels whose 8-bit colour differs from the scene's own setting.
    pub changed_from_own: f64,
    /// Whether the setting is on the Pareto front of median time and error (root mean square, in
    /// levels, to three digits).
    pub is_on_front: bool,
    /// Whether this is the scene's own setting.
    pub is_own: bool,
    /// Whether this setting is advised.
    pub is_pick: bool,
    /// The picture of the error; `None` if no 8-bit pixel changes.
    #[serde(skip)]
    pub picture: Option<ErrorPicture>,
}

/// The cost of one effect or of trees, compared with the scene's own setting.
#[derive(Clone, Debug, Serialize)]
pub struct EffectRow {
    /// The name of the row, such as `without shadows`.
    pub name: String,
    /// The effect that is left out; `None` if all are simulated, or if trees are left out.
    pub without: Option<Effect>,
    /// Whether trees are left out.
    pub is_without_trees: bool,
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
    /// Returns the rows of settings that belong to no question, because they differ from the
    /// scene's own in several choices.
    pub fn others(&self) -> impl Iterator<Item = &SettingRow> {
        let is_in = |at: usize| {
            self.questions.iter().any(|question| question.rows.iter().any(|row| row.row == at))
        };
        self.rows.iter().enumerate().filter(move |(at, _)| !is_in(*at)).map(|(_, row)| row)
    }
}
