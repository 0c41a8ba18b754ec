//! The answers that functions give, in a few kinds.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{number, numbers};
use crate::ray::SurfaceHit;

/// The result of a function. The variant's name in snake case is the JSON key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// A hit with a bare shape.
    Hit {
        /// Parameter of the hit along the ray as given.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        t: f64,
        /// Outward unit normal.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        normal: DVec3,
    },
    /// A hit in a scene.
    Found {
        /// Parameter of the hit along the ray as given.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        t: f64,
        /// Index of the object.
        object: usize,
    },
    /// No hit, or no transmitted ray. Always `true`.
    Miss(bool),
    /// A ray. Its interval does not matter.
    Ray {
        /// The origin.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        origin: DVec3,
        /// The direction.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        direction: DVec3,
    },
    /// A number.
    Value(
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        f64,
    ),
    /// A direction, a normal, or three weights.
    Vector(
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        DVec3,
    ),
    /// Linear RGB.
    Colour(
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        DVec3,
    ),
    /// The normal turned against a ray.
    Facing {
        /// The turned normal.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        normal: DVec3,
        /// Whether the ray is inside the object.
        inside: bool,
    },
    /// The direction and distance of a light.
    ToLight {
        /// L_j.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        direction: DVec3,
        /// t_light; "inf" for a directional light.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        t: f64,
    },
    /// Indices of refraction on both sides.
    Indices {
        /// Index on the side of the ray.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        eta_i: f64,
        /// Index on the other side.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        eta_t: f64,
    },
    /// Whether the ray spawns further rays.
    GoesOn(bool),
    /// The function is still to be written. Always `true`.
    Todo(bool),
    /// The function panicked, with this message.
    Panic(String),
}

impl Answer {
    /// Returns `hit`, or `miss` for `None`.
    pub fn from_hit(hit: Option<SurfaceHit>) -> Self {
        hit.map_or(Self::Miss(true), |hit| Self::Hit { t: hit.t, normal: hit.normal })
    }

    /// Returns `vector`, or `miss` for `None`.
    pub fn from_direction(direction: Option<DVec3>) -> Self {
        direction.map_or(Self::Miss(true), Self::Vector)
    }
}
