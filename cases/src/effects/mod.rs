//! The effects that a tracer may simulate, and which of them a scene calls for under a course.
//!
//! This folder is the only place that defines what an effect is. The choice of the kernel, the
//! lint of stages, the documents and the reports all read it.

#[cfg(feature = "authoring")]
mod called_for;

use std::fmt;

use serde::{Deserialize, Serialize};

#[cfg(feature = "authoring")]
pub use called_for::{Reason, called_for, reasons, simulate_only};

/// Something a tracer may simulate beyond eye rays and local light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// Surfaces hide lights. [rule 5]
    Shadows,
    /// Shadows take the colour of what the light goes through. [rule 6]
    TintedShadows,
    /// Mirrored rays. [rule 7]
    Reflection,
    /// Transmitted rays. [rule 8]
    Refraction,
    /// Shading by interpolated vertex normals. [rule 18]
    SmoothNormals,
    /// Objects whose matrix is not the identity. [rule 20]
    Transforms,
    /// Light that weakens with distance. [rule 4]
    Attenuation,
    /// Paths cut where their weight no longer matters. [rule 13]
    AdaptiveDepth,
}

impl Effect {
    /// Every effect, in the order in which they are listed.
    pub const ALL: [Self; 8] = [
        Self::Shadows,
        Self::TintedShadows,
        Self::Reflection,
        Self::Refraction,
        Self::SmoothNormals,
        Self::Transforms,
        Self::Attenuation,
        Self::AdaptiveDepth,
    ];

    /// Its name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shadows => "shadows",
            Self::TintedShadows => "tinted_shadows",
            Self::Reflection => "reflection",
            Self::Refraction => "refraction",
            Self::SmoothNormals => "smooth_normals",
            Self::Transforms => "transforms",
            Self::Attenuation => "attenuation",
            Self::AdaptiveDepth => "adaptive_depth",
        }
    }

    /// The effect of that name, if there is one.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of effects. In JSON: a list of names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(from = "Vec<Effect>", into = "Vec<Effect>")]
pub struct Effects(u16);

impl Effects {
    /// No effect: eye rays and local light.
    pub const NONE: Self = Self(0);

    /// Every effect there is.
    pub const ALL: Self = Self((1 << Effect::ALL.len()) - 1);

    /// Every effect there is.
    pub const fn all() -> Self {
        Self::ALL
    }

    /// The set as a number: bit n stands for the n-th effect of [`Effect::ALL`].
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The set with these bits.
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// Whether `effect` is in the set.
    pub const fn has(self, effect: Effect) -> bool {
        self.0 & (1 << effect as u16) != 0
    }

    /// The set with `effect` in it.
    #[must_use]
    pub const fn with(self, effect: Effect) -> Self {
        Self(self.0 | (1 << effect as u16))
    }

    /// The set with `effect` taken out.
    #[must_use]
    pub const fn without(self, effect: Effect) -> Self {
        Self(self.0 & !(1 << effect as u16))
    }

    /// The effects that are in both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The effects that are in either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The effects of this set that are not in `other`.
    #[must_use]
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The effects in the set, in listed order.
    pub fn iter(self) -> impl Iterator<Item = Effect> {
        Effect::ALL.into_iter().filter(move |effect| self.has(*effect))
    }
}

impl FromIterator<Effect> for Effects {
    fn from_iter<I: IntoIterator<Item = Effect>>(effects: I) -> Self {
        effects.into_iter().fold(Self::NONE, Self::with)
    }
}

impl From<Vec<Effect>> for Effects {
    fn from(effects: Vec<Effect>) -> Self {
        effects.into_iter().collect()
    }
}

impl From<Effects> for Vec<Effect> {
    fn from(effects: Effects) -> Self {
        effects.iter().collect()
    }
}
