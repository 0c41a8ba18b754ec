//! Axis-aligned bounding boxes.

use crate::numbers::real::Real;
use crate::numbers::vec3::{Affine, Vec3};

/// The axis-aligned box of all points X with min ≤ X ≤ max in every component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// The least corner.
    pub min: Vec3<T>,
    /// The greatest corner.
    pub max: Vec3<T>,
}

impl<T: Real> Bounds<T> {
    /// Returns the empty box, from ∞ to −∞. Joined with another box, it gives the other box.
    pub fn empty() -> Self {
        let far = Vec3::new(T::INFINITY, T::INFINITY, T::INFINITY);
        Self { min: far, max: -far }
    }

    /// Returns the least box around all of `points`, the empty box if there are none. NaN
    /// coordinates are ignored.
    pub fn around(points: impl IntoIterator<Item = Vec3<T>>) -> Self {
        points.into_iter().fold(Self::empty(), |bounds, p| bounds.join(Self { min: p, max: p }))
    }

    /// Returns the least box around both boxes.
    pub fn join(self, other: Self) -> Self {
        Self { min: self.min.least(other.min), max: self.max.greatest(other.max) }
    }

    /// Returns the least box, in the frame that `map` leads to, around the images of the eight
    /// corners.
    pub fn moved(self, map: &Affine<T>) -> Self {
        let pick = |bit: usize, axis: usize| {
            if bit >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
        };
        Self::around(
            (0..8).map(|bit| map.point(Vec3::new(pick(bit, 0), pick(bit, 1), pick(bit, 2)))),
        )
    }

    /// Returns the centre; NaN for the empty box.
    pub fn middle(self) -> Vec3<T> {
        (self.min + self.max) * T::HALF
    }

    /// Returns half the surface area, in squared units of length; 0 for the empty box.
    pub fn half_area(self) -> T {
        let side = (self.max - self.min).greatest(Vec3::ZERO);
        side.x * side.y + side.y * side.z + side.z * side.x
    }
}
