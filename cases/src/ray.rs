//! Rays, hits, and the one place that says where a ray's interval begins and ends.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Below this parameter an intersection does not count: a new ray starts on a surface only up to
/// rounding. [rule 2] [rule 21]
pub const RAY_EPSILON: f64 = 1e-6;

/// r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]
///
/// The direction of an eye, shadow, reflected or refracted ray is a unit vector; after going to
/// object space it has whatever length the matrix gives it. [rule 20]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Ray {
    /// Where t = 0.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub origin: DVec3,
    /// Never the zero vector.
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
    /// The ray over RAY_EPSILON < t < ∞. [rule 2]
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self::until(origin, direction, f64::INFINITY)
    }

    /// The ray over RAY_EPSILON < t < `t_max`, as a shadow ray that ends at its light. [rule 5]
    pub fn until(origin: DVec3, direction: DVec3, t_max: f64) -> Self {
        Self { origin, direction, t_min: RAY_EPSILON, t_max }
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// Whether a hit at `t` counts: strictly inside the interval; never for NaN. [rule 2]
    pub fn contains(&self, t: f64) -> bool {
        self.t_min < t && t < self.t_max
    }
}

/// What the intersection with a bare shape finds, in the frame of the ray. A miss is `None`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SurfaceHit {
    /// Parameter along the ray as given, its direction not normalised. [rule 20]
    #[serde(with = "crate::probe::number")]
    #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
    pub t: f64,
    /// Unit vector; points outwards, from inside as well. [rule 11]
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub normal: DVec3,
}

/// The nearest thing a ray meets in a scene, in world space. A miss is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter along the ray.
    pub t: f64,
    /// Where it hits.
    pub point: DVec3,
    /// Unit normal of the surface itself, outwards. [rule 19]
    pub n_geom: DVec3,
    /// Unit normal to shade with: interpolated on a mesh that carries vertex normals, else
    /// `n_geom`. [rule 18]
    pub n_shading: DVec3,
    /// Index into [`Scene::objects`](crate::Scene).
    pub object: usize,
}
