//! The settings of a picture: precision, formulas, samples, depth, cut-offs, effects.

use std::fmt;

use cases::{Effect, Effects, Scene};
use pages::figures::figure;
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
    /// Whether only pixels that differ from a neighbour get these rays, and the others one.
    pub adaptive: bool,
    /// The depth at which rays spawn no more rays. [rule 13]
    pub max_depth: u32,
    /// The weight below which rays spawn no more rays; 0 for never. [rule 13]
    pub threshold: f64,
    /// The light below which a light source is skipped at a point; 0 skips none.
    pub light_cutoff: f64,
    /// Whether the kernel is one of those that are compiled alike for all formulas, so that only
    /// the formulas differ. The picture is the same.
    pub alike: bool,
    /// Whether objects and triangles are searched through trees, not one after another. The picture
    /// is the same.
    pub trees: bool,
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
            adaptive: false,
            max_depth: scene.render.max_depth,
            threshold: if scene.effects.has(Effect::AdaptiveDepth) {
                scene.render.threshold
            } else {
                0.0
            },
            light_cutoff: 0.0,
            alike: false,
            trees: true,
            effects: scene.effects.without(Effect::AdaptiveDepth),
        }
    }

    /// Returns this setting with f64 and the robust formulas.
    pub fn by_exact_numbers(&self) -> Self {
        Self { precision: Precision::F64, formula: Formula::Robust, ..*self }
    }

    /// Returns this setting with the precision and the formulas of `other`.
    pub fn with_numbers_of(&self, other: &Self) -> Self {
        Self { precision: other.precision, formula: other.formula, ..*self }
    }

    /// Returns this setting with the depth, the threshold and the light cut-off of `other`.
    pub fn with_depth_of(&self, other: &Self) -> Self {
        let Self { max_depth, threshold, light_cutoff, .. } = *other;
        Self { max_depth, threshold, light_cutoff, ..*self }
    }

    /// Returns this setting with the sampling of `other`.
    pub fn with_sampling_of(&self, other: &Self) -> Self {
        Self { samples: other.samples, adaptive: other.adaptive, ..*self }
    }

    /// Returns the precision and formulas in words, such as `f64 robust`.
    pub fn numbers_name(&self) -> String {
        format!("{} {}", self.precision.says(), self.formula.name())
    }

    /// Returns the depth and the cut-offs in words, such as `depth 5, threshold 1/256`. Those of 0
    /// are left out.
    pub fn depth_name(&self) -> String {
        let mut name = format!("depth {}", self.max_depth);
        for (what, value) in [("threshold", self.threshold), ("light", self.light_cutoff)] {
            if value > 0.0 {
                name += &format!(", {what} {}", fraction(value));
            }
        }
        name
    }

    /// Returns the sampling in words, such as `2×2` or `4×4 adaptive`.
    pub fn sampling_name(&self) -> String {
        format!("{0}×{0}{1}", self.samples, if self.adaptive { " adaptive" } else { "" })
    }

    /// Returns the effects that the kernel simulates: `effects`, with `adaptive_depth` if the
    /// threshold is above 0.
    pub fn simulated(&self) -> Effects {
        if self.threshold > 0.0 { self.effects.with(Effect::AdaptiveDepth) } else { self.effects }
    }
}

/// Returns a value from 0 to 1 as text: as a fraction such as `1/256` where it is one of a whole
/// number from 2 to 1000, otherwise with three digits.
pub fn fraction(value: f64) -> String {
    let below = (1.0 / value).round();
    if (2.0..=1000.0).contains(&below) && 1.0 / below == value {
        format!("1/{below}")
    } else {
        figure(value)
    }
}

/// Writes text such as `f64 robust, 2×2, depth 5, threshold 1/256`. Cut-offs of 0 are left out. A
/// setting whose kernel is compiled like those of other formulas ends with `kernels alike`.
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, {}", self.numbers_name(), self.sampling_name(), self.depth_name())?;
        if self.alike { write!(f, ", kernels alike") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_of_one_read_as_such() {
        for (value, text) in [
            (1.0 / 256.0, "1/256"),
            (1e-3, "1/1000"),
            (0.3, "0.300"),
            (1e-4, "1.00e-4"),
            (1.0, "1.00"),
        ] {
            assert_eq!(fraction(value), text);
        }
    }
}
