//! The answers, of a few kinds.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{number, numbers};
use crate::ray::SurfaceHit;

/// What a function returned; the variant's name in snake case is the key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// A hit with a bare shape.
    Hit {
        /// Along the ray as given.
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
        /// Along the ray as given.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        t: f64,
        /// Index of the object.
        object: usize,
    },
    /// Nothing: no hit, or no transmitted ray. Always `true`.
    Miss(bool),
    /// A ray; the interval does not matter.
    Ray {
        /// Where it starts.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        origin: DVec3,
        /// Where it goes.
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
        /// That normal.
        #[serde(with = "numbers")]
        #[cfg_attr(feature = "authoring", schemars(with = "[crate::probe::number::Number; 3]"))]
        normal: DVec3,
        /// Whether the ray is inside the object.
        inside: bool,
    },
    /// The way to a light.
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
    /// Indices on both sides.
    Indices {
        /// On the side of the ray.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        eta_i: f64,
        /// On the other side.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        eta_t: f64,
    },
    /// Whether the ray spawns more.
    GoesOn(bool),
    /// The function is still to be written. Always `true`.
    Todo(bool),
    /// The function panicked, with this message.
    Panic(String),
}

impl Answer {
    /// `hit`, or `miss` for `None`.
    pub fn from_hit(hit: Option<SurfaceHit>) -> Self {
        hit.map_or(Self::Miss(true), |hit| Self::Hit { t: hit.t, normal: hit.normal })
    }

    /// `vector`, or `miss` for `None`.
    pub fn from_direction(direction: Option<DVec3>) -> Self {
        direction.map_or(Self::Miss(true), Self::Vector)
    }
}
