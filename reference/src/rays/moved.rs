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
    pub in_world: &'a Ray<T>,
    /// The matrix that moved it.
    pub way: &'a WayToObject<T>,
}

impl<T: Real> ExactRay for MovedRay<'_, T> {
    fn exact(&self) -> [(Two3, i32); 2] {
        self.way.exact(self.in_world)
    }
}

/// A⁻¹ in two words, and a bound of the error of rays that the rounded matrix moves.
#[derive(Clone, Copy, Debug)]
pub struct WayToObject<T> {
    /// A⁻¹.
    inverse: Inverse,
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
        Self {
            inverse: Inverse::of(rows),
            translation: Vec3::of(forth.translation.f64()),
            blur,
            most,
        }
    }

    /// Returns the greatest distances along the axes between a rounded point or direction of object
    /// space and the exact one. Not finite where the matrix is too nearly singular for a bound.
    #[inline(always)]
    pub fn blur(&self, v: Vec3<T>) -> Vec3<T> {
        let v = v.abs();
        Vec3::new(self.blur[0].dot(v), self.blur[1].dot(v), self.blur[2].dot(v))
    }

    /// Returns the greatest length of `blur(v)` for a unit vector v.
    #[inline(always)]
    pub fn norm(&self) -> T {
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
        let [origin, direction] = [from, along].map(|v| self.inverse.times(v));
        [(origin, of_o + self.inverse.exponent), (direction, of_d + self.inverse.exponent)]
    }
}

/// The inverse of a matrix A in two words: A⁻¹ = 2^e C B⁻¹ R, with diagonal matrices C and R of
/// powers of two.
///
/// The axes of an object may have scales of very different sizes, whose products leave the range of
/// floats. So the columns of A are scaled to a greatest number of some 1 first, and then its rows.
/// B is what is left.
#[derive(Clone, Copy, Debug)]
struct Inverse {
    /// The rows of B⁻¹. They are not finite if A is singular.
    rows: [Two3; 3],
    /// The exponents in R and in C, at most 0.
    before: [i32; 3],
    after: [i32; 3],
    /// e.
    exponent: i32,
}

impl Inverse {
    fn of(rows: [Vec3<f64>; 3]) -> Self {
        let column = |n: usize| rows.iter().map(|row| row[n].abs()).fold(0.0, f64::max);
        let of_columns = [column(0), column(1), column(2)].map(exponent);
        let rows = rows.map(|row| powers(row, of_columns.map(|e| -e)));
        let of_rows = rows.map(|row| exponent(row.abs().max_element()));
        let row = |n: usize| Two3::of(rows[n].map(|x| scaled(x, -of_rows[n])));
        let [a, b, c] = [row(0), row(1), row(2)];
        let columns = [b.cross(c), c.cross(a), a.cross(b)];
        let det = a.dot(columns[0]);
        let [x, y, z] = columns.map(|column| column * (Two::of(1.0) / det));
        let row = |n: usize| Two3 { x: x.along(n), y: y.along(n), z: z.along(n) };
        let least = |all: [i32; 3]| all[0].min(all[1]).min(all[2]);
        let (row_least, column_least) = (least(of_rows), least(of_columns));
        Self {
            rows: [row(0), row(1), row(2)],
            before: of_rows.map(|e| row_least - e),
            after: of_columns.map(|e| column_least - e),
            exponent: -row_least - column_least,
        }
    }

    /// Returns C B⁻¹ R v.
    fn times(&self, v: Two3) -> Two3 {
        let shifted = |v: Two3, e: [i32; 3]| Two3 {
            x: v.x.scaled(e[0]),
            y: v.y.scaled(e[1]),
            z: v.z.scaled(e[2]),
        };
        let v = shifted(v, self.before);
        let [x, y, z] = self.rows.map(|row| row.dot(v));
        shifted(Two3 { x, y, z }, self.after)
    }
}

/// Returns the components of v, each times 2 to the power of its own exponent.
fn powers(v: Vec3<f64>, e: [i32; 3]) -> Vec3<f64> {
    Vec3::new(scaled(v.x, e[0]), scaled(v.y, e[1]), scaled(v.z, e[2]))
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

    #[test]
    fn axes_of_any_scales_have_an_inverse() {
        for [x, y, z] in [[1.0, 1e-170, 1e-170], [1e200, 1.0, 1e-90], [1e-300, 1e-300, 1e-300]] {
            let diagonal = [Vec3::axis(0) * x, Vec3::axis(1) * y, Vec3::axis(2) * z];
            // y and z change places, so that scales stand in other rows than columns.
            let forth =
                Affine { rows: [diagonal[0], diagonal[2], diagonal[1]], translation: Vec3::ZERO };
            let way = WayToObject::of(&forth, &forth, &[Vec3::ZERO; 3]);
            let ray = Ray::all_of(Vec3::new(x, z, y) * 3.0, Vec3::axis(0));
            let [(origin, of_origin), _] = way.exact(&ray);
            let off = origin.scaled(of_origin).f64() - Vec3::new(3.0, 3.0, 3.0);
            assert!(off.length() < 1e-14, "{x:e} {y:e} {z:e}: {off:?}");
        }
    }
}
