//! Rays and hits. Only this module says where a ray's interval begins and ends.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Lower end of a ray's interval. An intersection at this parameter or below does not count,
/// because a new ray starts on a surface only up to rounding. [rule 2] [rule 21]
pub const RAY_EPSILON: f64 = 1e-6;

/// A ray r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]
///
/// Eye, shadow, reflected and refracted rays have unit directions. In object space, the direction
/// of a ray has the length that the matrix gives it. [rule 20]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Ray {
    /// The point at t = 0.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub origin: DVec3,
    /// The direction, which is never the zero vector.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub direction: DVec3,
    /// Open lower end of the interval.
    #[serde(with = "crate::probe::number")]
    #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
    pub t_min: f64,
    /// Open upper end of the interval; may be infinite.
    #[serde(with = "crate::probe::number")]
    #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
    pub t_max: f64,
}

impl Ray {
    /// Returns the ray over RAY_EPSILON < t < ∞. [rule 2]
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self::until(origin, direction, f64::INFINITY)
    }

    /// Returns the ray over RAY_EPSILON < t < `t_max`, such as a shadow ray to its light. [rule 5]
    pub fn until(origin: DVec3, direction: DVec3, t_max: f64) -> Self {
        Self { origin, direction, t_min: RAY_EPSILON, t_max }
    }

    /// Returns the point at parameter `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// Returns whether a hit at `t` counts: strictly inside the interval; never for NaN. [rule 2]
    pub fn contains(&self, t: f64) -> bool {
        self.t_min < t && t < self.t_max
    }
}

/// The intersection of a ray with a single shape, in the frame of the ray. A miss is `None`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SurfaceHit {
    /// Parameter along the ray as given, whose direction is not normalised. [rule 20]
    #[serde(with = "crate::probe::number")]
    #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
    pub t: f64,
    /// Unit normal, which points outwards even if the ray comes from inside. [rule 11]
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub normal: DVec3,
}

/// The nearest hit of a ray in a scene, in world space. A miss is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter along the ray.
    pub t: f64,
    /// The point of the hit.
    pub point: DVec3,
    /// Outward unit normal of the surface itself. [rule 19]
    pub n_geom: DVec3,
    /// Unit normal for shading: interpolated on a mesh that has vertex normals, else `n_geom`.
    /// [rule 18]
    pub n_shading: DVec3,
    /// Index into [`Scene::objects`](crate::Scene).
    pub object: usize,
}
