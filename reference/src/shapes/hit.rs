//! The hit on a shape, as a search keeps it.

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;

/// A hit on a shape: enough to compare it with another hit, and to compute the normal of the
/// nearest one later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeHit<T> {
    /// The parameter along the ray, in units of the length of its direction.
    pub t: T,
    /// The part of the shape: a face, a cap, the index of a triangle.
    pub part: u32,
    /// The barycentric coordinates (α, β, γ) on a triangle, else 0. [rule 17]
    pub weights: Vec3<T>,
}

impl<T: Real> ShapeHit<T> {
    /// Returns the hit at `t` on a part of a shape without vertices.
    #[inline(always)]
    pub fn with(t: T, part: u32) -> Self {
        Self { t, part, weights: Vec3::ZERO }
    }
}
