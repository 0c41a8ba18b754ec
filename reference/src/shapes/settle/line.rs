//! Lines in units in which nothing overflows or underflows.

use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::Two;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;

/// The line of a ray, in units of its own.
pub(super) struct Line {
    pub(super) origin: Vec3<f64>,
    pub(super) direction: Vec3<f64>,
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
    pub(super) fn new<T: Real>(ray: &Ray<T>, size: f64, room: i32) -> Option<Self> {
        let (origin, direction) = (double(ray.origin), double(ray.direction));
        let (length, way) = (
            exponent(greatest(&[coordinates([origin]), size])),
            exponent(coordinates([direction])),
        );
        let is_finite = length < 1024 && way < 1024;
        let (lengths, ways) = (room - length, -way);
        let is_ray = direction != Vec3::ZERO && is_finite;
        is_ray.then(|| Self {
            origin: times(origin, lengths),
            direction: times(direction, ways),
            lengths,
            ways,
        })
    }

    /// Returns the same line with a direction that is 2^`e` times as long.
    pub(super) fn stretched(self, e: i32) -> Self {
        Self { direction: times(self.direction, e), ways: self.ways + e, ..self }
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
