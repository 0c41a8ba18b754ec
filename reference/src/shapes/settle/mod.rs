//! The second step of certified formulas: the same questions in two words a number, for what the rounding of one leaves open. [rule 21]
//!
//! Lengths and directions are scaled by powers of two first, which rounds nothing: nothing over- or underflows, be the scene as large or as
//! small as it may. What is less than [`DOUBT`](crate::two::DOUBT) of its terms counts as zero, and borders are closed: so no hit is lost, and
//! none is found that is farther than that beside a border. A ray without direction, or one that is not finite, meets nothing.

mod flat;
mod round;
mod sphere;
mod triangle;

pub(super) use flat::{cuboid, plane, square};
pub(super) use round::Coil;
pub(super) use sphere::Ball;
pub(super) use triangle::{barycentric, outwards, triangle};

use crate::ray::Ray;
use crate::real::{Real, exponent, scaled};
use crate::two::Two;
use crate::vec3::Vec3;

/// A ray in units of its own.
struct Line {
    origin: Vec3<f64>,
    direction: Vec3<f64>,
    /// Lengths here are those of the scene times two to this power.
    lengths: i32,
    /// The direction here is the ray's times two to this power.
    ways: i32,
}

impl Line {
    /// The greatest coordinate of the origin and the greatest of `size` become some 2^`room`, that of the direction some 1.
    fn new<T: Real>(ray: &Ray<T>, size: f64, room: i32) -> Option<Self> {
        let (origin, direction) = (double(ray.origin), double(ray.direction));
        let (length, way) = (exponent(greatest(&[coordinates([origin]), size])), exponent(coordinates([direction])));
        let is_finite = length < 1024 && way < 1024;
        let (lengths, ways) = (room - length, -way);
        let is_ray = direction != Vec3::ZERO && is_finite;
        is_ray.then(|| Self { origin: times(origin, lengths), direction: times(direction, ways), lengths, ways })
    }

    /// A point of the scene in these units.
    fn point<T: Real>(&self, point: Vec3<T>) -> Vec3<f64> {
        times(double(point), self.lengths)
    }

    /// A length of the scene in these units.
    fn length<T: Real>(&self, length: T) -> f64 {
        scaled(length.f64(), self.lengths)
    }

    /// The parameter along the ray as given; ∞ where that is beyond all numbers.
    fn t<T: Real>(&self, t: Two) -> T {
        T::of(scaled(t.f64(), self.ways - self.lengths))
    }
}

/// The same vector in f64, exactly.
fn double<T: Real>(v: Vec3<T>) -> Vec3<f64> {
    Vec3::new(v.x.f64(), v.y.f64(), v.z.f64())
}

/// v 2^e.
fn times(v: Vec3<f64>, e: i32) -> Vec3<f64> {
    v.map(|x| scaled(x, e))
}

/// The greatest amount of a coordinate; NaN where one is.
fn coordinates<T: Real, const N: usize>(points: [Vec3<T>; N]) -> f64 {
    greatest(&points.map(|p| greatest(&[p.x.f64(), p.y.f64(), p.z.f64()])))
}

/// The greatest amount; NaN where one is.
fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| if x.abs() > most || x.is_nan() { x.abs() } else { most })
}
