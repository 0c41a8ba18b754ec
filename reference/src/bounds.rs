//! Boxes around things, for the tree.

use crate::ray::Ray;
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
        let pick = |bit: usize, axis: usize| if bit >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
        Self::around((0..8).map(|bit| map.point(Vec3::new(pick(bit, 0), pick(bit, 1), pick(bit, 2)))))
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

/// A ray prepared for many boxes, which it takes for a little larger than they are.
///
/// Rounding in a box test or in the test of what is inside must never hide a hit: every box grows on each side by a few hundred roundings of
/// the largest coordinate in play. A tree then finds exactly what a walk through the whole list finds.
#[derive(Clone, Copy, Debug)]
pub struct BoxRay<T> {
    origin: Vec3<T>,
    inverse: Vec3<T>,
    pad: T,
    t_min: T,
}

impl<T: Real> BoxRay<T> {
    /// For boxes within `all`, where rounding in the test of what is inside loses up to `loss` times what it loses in world space.
    pub fn new(ray: &Ray<T>, all: Bounds<T>, loss: T) -> Self {
        let reach = ray.origin.abs().max_element().greatest(all.min.abs().greatest(all.max.abs()).max_element());
        Self {
            origin: ray.origin,
            inverse: ray.direction.map(|d| T::ONE / d),
            pad: reach * (loss * T::of(256.0) * T::ULP),
            t_min: ray.t_min,
        }
    }

    /// Where the ray enters the box, if it does so before `limit`.
    #[inline(always)]
    pub fn enter(&self, bounds: &Bounds<T>, limit: T) -> Option<T> {
        let (mut enter, mut leave) = (self.t_min, limit);
        for axis in 0..3 {
            let one = (bounds.min[axis] - self.pad - self.origin[axis]) * self.inverse[axis];
            let two = (bounds.max[axis] + self.pad - self.origin[axis]) * self.inverse[axis];
            enter = enter.greatest(one.least(two)); // 0 · ∞ is NaN, which both functions pass over
            leave = leave.least(one.greatest(two));
        }
        (enter <= leave).then_some(enter)
    }
}
