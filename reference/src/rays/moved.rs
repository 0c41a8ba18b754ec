//! Rays in the space of an object: rounded, with a bound of what rounding loses, and in two words.
//! [rule 20]
//!
//! A hit on a transformed shape is decided for the exact ray: A⁻¹ (O − t) + s A⁻¹ d, with the
//! matrix and the ray of the scene. The rounded ray decides it where its bound allows.

use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::{Affine, Vec3};
use crate::rays::ray::Ray;

/// The error of W (O − t) in units of `ULP`: four roundings, with room for what the bound itself
/// loses.
const SUM_OF_THREE: f64 = 3.0;
/// A relative error beyond which the bound proves nothing.
const USELESS: f64 = 0.1;

/// A ray whose numbers are known to two words.
pub trait ExactRay {
    /// Returns origin and direction, each with the exponent of a power of two that it is to be
    /// multiplied by.
    fn exact(&self) -> [(Two3, i32); 2];
}

impl<T: Real> ExactRay for Ray<T> {
    fn exact(&self) -> [(Two3, i32); 2] {
        [self.origin, self.direction].map(|v| (Two3::of(Vec3::of(v.f64())), 0))
    }
}

/// A ray in the space of an object.
#[derive(Clone, Copy, Debug)]
pub struct MovedRay<'a, T> {
    /// The ray in object space, rounded, with the interval of the search.
    pub ray: Ray<T>,
    /// The ray in world space.
    pub cast: &'a Ray<T>,
    /// The matrix that moved it.
    pub way: &'a WayToObject<T>,
}

impl<T: Real> ExactRay for MovedRay<'_, T> {
    fn exact(&self) -> [(Two3, i32); 2] {
        self.way.exact(self.cast)
    }
}

/// A⁻¹ in two words, and a bound of the error of rays that the rounded matrix moves.
#[derive(Clone, Copy, Debug)]
pub struct WayToObject<T> {
    /// The rows of A⁻¹ 2^e.
    rows: [Two3; 3],
    /// e.
    exponent: i32,
    /// t.
    translation: Vec3<f64>,
    /// The matrix G: the rounded origin o is off by at most G |o|, and so is the direction.
    blur: [Vec3<T>; 3],
    /// ‖G‖, as the root of the sum of squares.
    most: T,
}

impl<T: Real> WayToObject<T> {
    /// Returns the way for M = (A, t). Rays are moved by W (O − t), and `rest` is |W A − I|.
    pub fn of(forth: &Affine<T>, back: &Affine<T>, rest: &[Vec3<T>; 3]) -> Self {
        let column = |n: usize| Vec3::new(forth.rows[0][n], forth.rows[1][n], forth.rows[2][n]);
        let columns = [column(0), column(1), column(2)].map(Vec3::abs);
        let row = |i: usize| {
            let through = columns.map(|column| back.rows[i].abs().dot(column));
            let [x, y, z] = through.map(|x| x * (T::of(SUM_OF_THREE) * T::ULP));
            Vec3::new(x, y, z) + rest[i] * T::of(1.25)
        };
        let blur = [row(0), row(1), row(2)];
        let most = blur.iter().fold(T::ZERO, |sum, row| sum + row.dot(*row)).sqrt();
        let is_useful = most < T::of(USELESS);
        let nothing = [Vec3::ONE * T::INFINITY; 3];
        let (blur, most) = if is_useful { (blur, most) } else { (nothing, T::INFINITY) };
        let rows = forth.rows.map(|row| Vec3::of(row.f64()));
        let (rows, exponent) = inverse(rows);
        Self { rows, exponent, translation: Vec3::of(forth.translation.f64()), blur, most }
    }

    /// Returns the greatest distances along the axes between a rounded point or direction of object
    /// space and the exact one. NaN where the matrix is too nearly singular for a bound.
    #[inline(always)]
    pub fn blur(&self, v: Vec3<T>) -> Vec3<T> {
        let v = v.abs();
        Vec3::new(self.blur[0].dot(v), self.blur[1].dot(v), self.blur[2].dot(v))
    }

    /// Returns the greatest length of `blur(v)` for a unit vector v.
    #[inline(always)]
    pub fn most(&self) -> T {
        self.most
    }

    /// Returns A⁻¹ (O − t) and A⁻¹ d.
    fn exact(&self, ray: &Ray<T>) -> [(Two3, i32); 2] {
        let greatest = |v: Vec3<f64>| exponent(v.abs().max_element());
        let times = |v: Vec3<f64>, e: i32| v.map(|x| scaled(x, e));
        let (o, d): (Vec3<f64>, Vec3<f64>) =
            (Vec3::of(ray.origin.f64()), Vec3::of(ray.direction.f64()));
        let (of_o, of_d) = (greatest(o).max(greatest(self.translation)), greatest(d));
        let from = Two3::difference(times(o, -of_o), times(self.translation, -of_o));
        let along = Two3::of(times(d, -of_d));
        [(self.apply(from), of_o - self.exponent), (self.apply(along), of_d - self.exponent)]
    }

    fn apply(&self, v: Two3) -> Two3 {
        let [x, y, z] = self.rows.map(|row| row.dot(v));
        Two3 { x, y, z }
    }
}

/// Returns the rows of A⁻¹ 2^e, and e.
fn inverse(rows: [Vec3<f64>; 3]) -> ([Two3; 3], i32) {
    let most = exponent(rows.iter().map(|row| row.abs().max_element()).fold(0.0, f64::max));
    let [a, b, c] = rows.map(|row| Two3::of(row.map(|x| scaled(x, -most))));
    let columns = [b.cross(c), c.cross(a), a.cross(b)];
    let det = a.dot(columns[0]);
    let [x, y, z] = columns.map(|column| column * (Two::of(1.0) / det));
    let row = |n: usize| Two3 { x: x.along(n), y: y.along(n), z: z.along(n) };
    ([row(0), row(1), row(2)], most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_ray_keeps_two_words() {
        // A⁻¹ (O − t) = (1 − 3, 0, 8 / 4) and A⁻¹ d = (1/3, 0, 0), a number of many words.
        let forth = Affine {
            rows: [Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 0.0, 4.0)],
            translation: Vec3::new(9.0, 1.0, -8.0),
        };
        let way = WayToObject::of(&forth, &forth, &[Vec3::ZERO; 3]);
        let ray = Ray::all_of(Vec3::new(3.0, 1.0, 0.0), Vec3::axis(0));
        let [(origin, of_origin), (direction, of_direction)] = way.exact(&ray);
        assert_eq!(origin.scaled(of_origin).f64(), Vec3::new(-2.0, 0.0, 2.0));
        let third = direction.scaled(of_direction).x;
        assert!((third * Two::of(3.0) - Two::of(1.0)).abs().f64() < 1e-30, "{third:?}");
    }
}
