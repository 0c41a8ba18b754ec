//! A ray in units in which nothing over- or underflows.

use crate::ray::Ray;
use crate::real::{Real, exponent, scaled};
use crate::two::Two;
use crate::vec3::Vec3;

/// A ray in units of its own.
pub(super) struct Line {
    pub(super) origin: Vec3<f64>,
    pub(super) direction: Vec3<f64>,
    /// The power of two by which lengths of the scene become lengths here.
    pub(super) lengths: i32,
    /// The power of two by which the direction of the ray becomes the one here.
    ways: i32,
}

impl Line {
    /// Returns `ray` in units in which the greatest coordinate of its origin, or `size` where that
    /// is greater, is some 2^`room`, and the greatest one of its direction some 1.
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

    /// Returns a point of the scene in these units.
    pub(super) fn point<T: Real>(&self, point: Vec3<T>) -> Vec3<f64> {
        times(double(point), self.lengths)
    }

    /// Returns a length of the scene in these units.
    pub(super) fn length<T: Real>(&self, length: T) -> f64 {
        scaled(length.f64(), self.lengths)
    }

    /// Returns the parameter along the ray as given; ∞ where that is beyond all numbers.
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

/// Returns the greatest amount of a coordinate; NaN where one is.
pub(super) fn coordinates<T: Real, const N: usize>(points: [Vec3<T>; N]) -> f64 {
    greatest(&points.map(|p| greatest(&[p.x.f64(), p.y.f64(), p.z.f64()])))
}

/// Returns the greatest amount; NaN where one is.
pub(super) fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| if x.abs() > most || x.is_nan() { x.abs() } else { most })
}
