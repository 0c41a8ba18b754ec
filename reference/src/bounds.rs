//! Boxes around things, for the tree.

use crate::real::Real;
use crate::vec3::{Affine, Vec3};

/// min ≤ X ≤ max.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// Least corner.
    pub min: Vec3<T>,
    /// Greatest corner.
    pub max: Vec3<T>,
}

impl<T: Real> Bounds<T> {
    /// The box around nothing: joined with another it gives the other.
    pub fn empty() -> Self {
        let far = Vec3::new(T::INFINITY, T::INFINITY, T::INFINITY);
        Self { min: far, max: -far }
    }

    /// The least box around all of `points`.
    pub fn around(points: impl IntoIterator<Item = Vec3<T>>) -> Self {
        points.into_iter().fold(Self::empty(), |bounds, p| bounds.join(Self { min: p, max: p }))
    }

    /// The least box around both.
    pub fn join(self, other: Self) -> Self {
        Self { min: self.min.least(other.min), max: self.max.greatest(other.max) }
    }

    /// The box around this one in another frame.
    pub fn moved(self, map: &Affine<T>) -> Self {
        let pick = |bit: usize, axis: usize| {
            if bit >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
        };
        Self::around(
            (0..8).map(|bit| map.point(Vec3::new(pick(bit, 0), pick(bit, 1), pick(bit, 2)))),
        )
    }

    /// Its middle.
    pub fn middle(self) -> Vec3<T> {
        (self.min + self.max) * T::HALF
    }

    /// Half of its surface; 0 for the empty one.
    pub fn half_area(self) -> T {
        let side = (self.max - self.min).greatest(Vec3::ZERO);
        side.x * side.y + side.y * side.z + side.z * side.x
    }
}
