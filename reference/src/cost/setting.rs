//! The settings of a picture: precision, formulas, samples, depth, threshold, effects.

use std::fmt;

use cases::{Effect, Effects, Scene};
use serde::Serialize;

use crate::expect::variations::Precision;
pub use crate::rules::Formula;

/// One way to compute the picture of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// The precision of the scalars.
    pub precision: Precision,
    /// The formulas.
    pub formula: Formula,
    /// The N of N × N rays a pixel.
    pub samples: u32,
    /// The depth at which rays spawn no more rays. [rule 13]
    pub max_depth: u32,
    /// The weight below which rays spawn no more rays; 0 for never. [rule 13]
    pub threshold: f64,
    /// Whether the kernel is one of those that are compiled alike for all formulas, so that only
    /// the formulas differ. The picture is the same.
    pub alike: bool,
    /// The effects that are simulated, except for `adaptive_depth`: `threshold` alone decides
    /// whether paths end by their weight.
    #[serde(skip)]
    pub effects: Effects,
}

impl Setting {
    /// Returns the scene's own setting: f64, the reference's formulas, one ray a pixel, and the
    /// depth, threshold and effects of the scene.
    pub fn of(scene: &Scene) -> Self {
        Self {
            precision: Precision::F64,
            formula: Formula::Robust,
            samples: 1,
            max_depth: scene.render.max_depth,
            threshold: if scene.effects.has(Effect::AdaptiveDepth) {
                scene.render.threshold
            } else {
                0.0
            },
            alike: false,
            effects: scene.effects.without(Effect::AdaptiveDepth),
        }
    }

    /// Returns this setting with f64 and the robust formulas.
    pub fn by_exact_numbers(&self) -> Self {
        Self { precision: Precision::F64, formula: Formula::Robust, ..*self }
    }

    /// Returns the effects that the kernel simulates: `effects`, with `adaptive_depth` if the
    /// threshold is above 0.
    pub fn simulated(&self) -> Effects {
        if self.threshold > 0.0 { self.effects.with(Effect::AdaptiveDepth) } else { self.effects }
    }
}

/// Writes text such as `f64 robust, 2×2, depth 5, threshold 0.0010`. A threshold of 0 is left out.
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { samples, max_depth, .. } = self;
        write!(
            f,
            "{} {}, {samples}×{samples}, depth {max_depth}",
            self.precision.says(),
            self.formula.name()
        )?;
        if self.threshold > 0.0 {
            write!(f, ", threshold {:.4}", self.threshold)?;
        }
        Ok(())
    }
}
