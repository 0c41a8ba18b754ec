//! How a picture may be computed: precision, formulas, samples, depth, threshold, effects.

use std::fmt;

use cases::{Effect, Effects, Scene};
use serde::Serialize;

use crate::rules::{
    PlaneFormula, Quadratic, Robustness, Rules, Snell, Start, Style, TriangleFormula,
};
use crate::variations::Precision;

/// Which formulas, from the cheapest to the surest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Formula {
    /// Textbook quadratic and plane, Möller–Trumbore, RAY_EPSILON: as most tracers are written.
    Plain,
    /// Formulas that do not cancel, without a bound on their error; RAY_EPSILON.
    Stable,
    /// The reference's own: with a proven bound, and more digits where the bound does not settle
    /// it.
    Robust,
}

impl Formula {
    /// All, the cheapest first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Stable, Self::Robust];

    /// Its name on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Stable => "stable",
            Self::Robust => "robust",
        }
    }

    /// What it leaves to rounding.
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

    /// The rules `base` by these formulas.
    pub fn rules(self, base: &Rules) -> Rules {
        Rules { style: self.style(), ..*base }
    }
}

/// One way of computing the picture of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// The scalars.
    pub precision: Precision,
    /// The formulas.
    pub formula: Formula,
    /// N for N × N rays a pixel.
    pub samples: u32,
    /// Depth at which rays spawn no more. [rule 13]
    pub max_depth: u32,
    /// Weight below which they spawn no more; 0 for never. [rule 13]
    pub threshold: f64,
    /// The effects that are simulated, but for `adaptive_depth`: `threshold` alone says whether
    /// paths end by their weight.
    #[serde(skip)]
    pub effects: Effects,
}

impl Setting {
    /// As the scene stands: f64, the reference's formulas, one ray a pixel.
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

    /// The same with f64 and the robust formulas.
    pub fn by_exact_numbers(&self) -> Self {
        Self { precision: Precision::F64, formula: Formula::Robust, ..*self }
    }

    /// The effects of the kernel.
    pub fn simulated(&self) -> Effects {
        if self.threshold > 0.0 { self.effects.with(Effect::AdaptiveDepth) } else { self.effects }
    }
}

/// Such as `f64 robust, 2×2, depth 5, threshold 0.001`; nothing of a threshold that is 0.
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
