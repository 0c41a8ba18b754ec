//! The settings of a picture: precision, formulas, samples, depth, threshold, effects.

use std::fmt;

use cases::{Effect, Effects, Scene};
use serde::Serialize;

use crate::expect::variations::Precision;
use crate::rules::{
    PlaneFormula, Quadratic, Robustness, Rules, Snell, Start, Style, TriangleFormula,
};

/// A set of formulas. The sets are ordered from the fastest to the most reliable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Formula {
    /// Textbook quadratic and plane, Möller–Trumbore, RAY_EPSILON, as in most tracers.
    Plain,
    /// Formulas that avoid cancellation, without a bound on their error; RAY_EPSILON.
    Stable,
    /// The reference's own formulas. They bound their rounding error, and compute with more digits
    /// where the bound leaves a decision open.
    Robust,
}

impl Formula {
    /// All sets, the fastest first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Stable, Self::Robust];

    /// Returns the name on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Stable => "stable",
            Self::Robust => "robust",
        }
    }

    /// Returns the style that selects these formulas.
    pub const fn style(self) -> Style {
        let stable =
            Style { robustness: Robustness::Plain, start: Start::Interval, ..Style::REFERENCE };
        match self {
            Self::Plain => Style {
                quadratic: Quadratic::Textbook,
                plane: PlaneFormula::Textbook,
                triangle: TriangleFormula::MollerTrumbore,
                snell: Snell::Textbook,
                ..stable
            },
            Self::Stable => stable,
            Self::Robust => Style::REFERENCE,
        }
    }

    /// Returns the rules `base` with these formulas.
    pub fn rules(self, base: &Rules) -> Rules {
        Rules { style: self.style(), ..*base }
    }
}

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
