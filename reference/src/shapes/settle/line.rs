//! Lines in units in which nothing overflows or underflows.

use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;

/// The line of a ray, in units of its own.
pub(super) struct Line {
    pub(super) origin: Two3,
    pub(super) direction: Two3,
    /// The exponent of the power of two that scales lengths of the scene to lengths here.
    pub(super) lengths: i32,
    /// The exponent of the power of two that scales the direction of the ray to the one here.
    ways: i32,
}

impl Line {
    /// Returns the line of `ray`, scaled; `None` where the ray has no direction, or something is
    /// not finite.
    ///
    /// The greatest coordinate of the origin, or `size` where that is greater, becomes some
    /// 2^`room`. The greatest component of the direction becomes some 1.
    pub(super) fn new(ray: &impl ExactRay, size: f64, room: i32) -> Option<Self> {
        let [(origin, of_origin), (direction, of_direction)] = ray.exact();
        let (from, along) = (coordinates([origin.f64()]), coordinates([direction.f64()]));
        let length = (exponent(from) + of_origin).max(exponent(size));
        let is_finite = from.is_finite() && size.is_finite() && along.is_finite();
        let lengths = room - length;
        (is_finite && along > 0.0).then(|| Self {
            origin: origin.scaled(of_origin + lengths),
            direction: direction.scaled(-exponent(along)),
            lengths,
            ways: -exponent(along) - of_direction,
        })
    }

    /// Returns the same line with a direction that is 2^`e` times as long.
    pub(super) fn stretched(self, e: i32) -> Self {
        Self { direction: self.direction.scaled(e), ways: self.ways + e, ..self }
    }

    /// Returns a point of the scene in these units.
    pub(super) fn point<T: Real>(&self, point: Vec3<T>) -> Vec3<f64> {
        times(double(point), self.lengths)
    }

    /// Returns a length of the scene in these units.
    pub(super) fn length<T: Real>(&self, length: T) -> f64 {
        scaled(length.f64(), self.lengths)
    }

    /// Returns the parameter along the ray as given; ∞ where it overflows.
    pub(super) fn t<T: Real>(&self, t: Two) -> T {
        T::of(scaled(t.f64(), self.ways - self.lengths))
    }
}

/// Returns `v` in f64, exactly.
pub(super) fn double<T: Real>(v: Vec3<T>) -> Vec3<f64> {
    Vec3::new(v.x.f64(), v.y.f64(), v.z.f64())
}

/// Returns v 2^e.
pub(super) fn times(v: Vec3<f64>, e: i32) -> Vec3<f64> {
    v.map(|x| scaled(x, e))
}

/// Returns the greatest magnitude of a coordinate; NaN if one is.
pub(super) fn coordinates<T: Real, const N: usize>(points: [Vec3<T>; N]) -> f64 {
    greatest(&points.map(|p| greatest(&[p.x.f64(), p.y.f64(), p.z.f64()])))
}

/// Returns the greatest magnitude; NaN if one is.
pub(super) fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| if x.abs() > most || x.is_nan() { x.abs() } else { most })
}
