//! The effects that a tracer may simulate, and the effects that a scene calls for under a course.
//!
//! This folder is the only place that defines the effects. The choice of the kernel, the lint of
//! stages, the documents and the reports all read it.

#[cfg(feature = "authoring")]
mod called_for;

use std::fmt;

use serde::{Deserialize, Serialize};

#[cfg(feature = "authoring")]
pub use called_for::{Reason, called_for, reasons, simulate_only};

/// An effect that a tracer may simulate beyond eye rays and local light.
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
    /// Every effect, in the order in which effects are listed.
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

    /// Returns the name of the effect in files and on the command line.
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

    /// Returns the effect of that name, or `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of effects; in JSON, a list of names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(from = "Vec<Effect>", into = "Vec<Effect>")]
pub struct Effects(u16);

impl Effects {
    /// No effect: eye rays and local light.
    pub const NONE: Self = Self(0);

    /// Every effect there is.
    pub const ALL: Self = Self((1 << Effect::ALL.len()) - 1);

    /// Returns every effect there is.
    pub const fn all() -> Self {
        Self::ALL
    }

    /// Returns the set as a number: bit n stands for the n-th effect of [`Effect::ALL`].
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// Returns the set with these bits.
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// Returns whether `effect` is in the set.
    pub const fn has(self, effect: Effect) -> bool {
        self.0 & (1 << effect as u16) != 0
    }

    /// Returns the set with `effect` added.
    #[must_use]
    pub const fn with(self, effect: Effect) -> Self {
        Self(self.0 | (1 << effect as u16))
    }

    /// Returns the set with `effect` removed.
    #[must_use]
    pub const fn without(self, effect: Effect) -> Self {
        Self(self.0 & !(1 << effect as u16))
    }

    /// Returns the effects that are in both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Returns the effects that are in either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns the effects of this set that are not in `other`.
    #[must_use]
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Iterates over the effects of the set, in listed order.
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
