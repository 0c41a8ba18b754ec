//! Sets of formulas: what a program computes with, from the usual textbook to the reference's own.

use serde::Serialize;

use super::style::{PlaneFormula, Quadratic, Robustness, Snell, Start, Style, TriangleFormula};

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
}
