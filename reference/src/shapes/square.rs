//! The unit square in the plane z = 0. [rule 15]

use super::hit::ShapeHit;
use super::settle;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{Robustness, RuleSource, SquareSize};

/// The square |x| ≤ 0.5, |y| ≤ 0.5, z = 0, border included, with the normal +z.
#[derive(Clone, Copy, Debug)]
pub struct Square;

impl Square {
    /// Returns the hit in the ray's interval; `None` for a miss. A ray within the plane of the
    /// square misses it. [rule 15]
    #[inline(always)]
    pub fn intersect<T: Real, R: RuleSource>(self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        self.first(rules, ray).map(|t| ShapeHit::with(t, 0))
    }

    /// Ray parameter of the hit. Never inlined: the whole computation depends only on the ray, so
    /// the optimiser would hoist it out of the object loop and run it for scenes without a square.
    #[inline(never)]
    fn first<T: Real, R: RuleSource>(self, rules: R, ray: &Ray<T>) -> Option<T> {
        if ray.direction.z == T::ZERO {
            return None;
        }
        let t = -ray.origin.z / ray.direction.z;
        let at = ray.at(t);
        let is_within = |half: T| at.x.abs() <= half && at.y.abs() <= half;
        let is_certified = rules.get().style.robustness == Robustness::Certified;
        let is_inside = match rules.get().square {
            SquareSize::Half if is_certified => self.certified(T::HALF, ray, t, at),
            SquareSize::One if is_certified => self.certified(T::ONE, ray, t, at),
            SquareSize::Half => is_within(T::HALF),
            SquareSize::One => is_within(T::ONE),
            SquareSize::FromZero => T::ZERO <= at.x.least(at.y) && at.x.greatest(at.y) <= T::ONE,
            SquareSize::Disc => at.x * at.x + at.y * at.y <= T::HALF * T::HALF,
        };
        (is_inside && ray.contains(t)).then_some(t)
    }

    /// Returns whether the ray's line passes within `half` of both axes; `at` is its point at `t`.
    ///
    /// The point takes t, a product and a sum: with u half a ulp, a coordinate is off by 3u of the
    /// magnitudes of its terms at most. Where that leaves the result open, the second step is
    /// taken.
    #[inline(always)]
    fn certified<T: Real>(self, half: T, ray: &Ray<T>, t: T, at: Vec3<T>) -> bool {
        let doubt = |o: T, d: T| (o.abs() + (d * t).abs()) * (T::of(4.0) * T::ULP);
        let (beyond_x, beyond_y) = (at.x.abs() - half, at.y.abs() - half);
        let (doubt_x, doubt_y) =
            (doubt(ray.origin.x, ray.direction.x), doubt(ray.origin.y, ray.direction.y));
        if beyond_x > doubt_x || beyond_y > doubt_y {
            return false;
        }
        (beyond_x < -doubt_x && beyond_y < -doubt_y) || settle::square(half, ray)
    }

    /// Returns the unit normal +z, in object space. [rule 15]
    #[inline(always)]
    pub fn normal<T: Real, R: RuleSource>(rules: R) -> Vec3<T> {
        if rules.get().square_faces_z { Vec3::axis(2) } else { -Vec3::axis(2) }
    }

    /// Returns the least box around the square, in object space.
    pub fn bounds<T: Real>() -> Bounds<T> {
        let corner = Vec3::new(T::HALF, T::HALF, T::ZERO);
        Bounds { min: -corner, max: corner }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<f64>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
        assert_eq!(
            Square.intersect(Lecture, &ray).map(|m| m.t),
            expected,
            "from {origin:?} along {direction:?}"
        );
    }

    #[test]
    fn distances_worked_out_on_paper() {
        check([0.25, -0.25, 2.0], [0.0, 0.0, -1.0], Some(2.0));
        check([0.25, -0.25, -2.0], [0.0, 0.0, 1.0], Some(2.0)); // from behind
        check([0.5, 0.5, 2.0], [0.0, 0.0, -1.0], Some(2.0)); // a corner belongs to it
        check([0.50001, 0.0, 2.0], [0.0, 0.0, -1.0], None);
        check([0.0, 0.0, 1.0], [0.25, 0.0, -0.5], Some(2.0)); // leaves by (0.5, 0, 0)
        check([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], None); // within its plane
        check([0.0, 0.0, 0.0], [0.0, 0.0, -1.0], None); // starts on it
    }
}
