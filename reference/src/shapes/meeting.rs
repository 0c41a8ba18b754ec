//! What a search keeps of a shape that lies in a ray's way.

use crate::real::Real;
use crate::vec3::Vec3;

/// The place of a shape in a ray's way: enough to tell which of two is nearer, and to work out the
/// normal of the winner later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting<T> {
    /// The parameter along the ray as given.
    pub t: T,
    /// The part of the shape: a face, a cap, the index of a triangle.
    pub part: u32,
    /// (α, β, γ) on a triangle, else 0. [rule 17]
    pub weights: Vec3<T>,
}

impl<T: Real> Meeting<T> {
    /// Returns the place `t` on that part of a shape without vertices.
    #[inline(always)]
    pub fn with(t: T, part: u32) -> Self {
        Self { t, part, weights: Vec3::ZERO }
    }
}
