//! Hit points: the point of a hit, moved back onto the surface, and a bound of how far off it still
//! is.
//!
//! O + t d is off by what t and the sum lose, which grows with the distance that the ray has come.
//! The point moved back onto the surface is off by what the formula of the surface loses, which
//! does not grow. u is half of `ULP`; γ(n) = n u / (1 − n u), and n `ULP` is twice that.

use super::settle;
use super::{Cuboid, Plane, Round, ShapeHit, Solid, Sphere, Square};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{RuleSource, SphereNormal};

impl<T: Real> Solid<T> {
    /// Returns the hit point of `ray`, in object space: the point, its error bound, and the outward
    /// unit normal there. [rule 11]
    #[inline(always)]
    pub fn place<R: RuleSource>(&self, rules: R, ray: &Ray<T>, hit: &ShapeHit<T>) -> HitPoint<T> {
        let at = ray.at(hit.t);
        match self {
            Self::Sphere(sphere) => sphere.place(rules, ray, hit.t),
            Self::Plane(plane) => plane.place(at),
            // z = 0 is exact, and the error of the rest lies within the plane
            Self::Square(_) => HitPoint {
                point: Vec3::new(at.x, at.y, T::ZERO),
                error: Vec3::ZERO,
                n_geom: Square::normal(rules),
            },
            Self::Cuboid(cuboid) => cuboid.place(rules, at, hit.part),
            Self::Round(round) => round.place(rules, ray, hit),
        }
    }
}

impl<T: Real> Solid<T> {
    /// Returns the outward unit normal at the hit of `ray`, in object space. By rules that move no
    /// hits back onto surfaces, the normal is that at the point along the ray.
    #[inline(always)]
    pub fn normal_at_hit<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        hit: &ShapeHit<T>,
    ) -> Vec3<T> {
        match rules.get().places_hits() {
            true => self.place(rules, ray, hit).n_geom,
            false => self.normal(rules, ray.at(hit.t), hit.part),
        }
    }
}

impl<T: Real> Sphere<T> {
    /// Returns C + r q for a unit vector q. The bound holds whichever vector q is.
    ///
    /// q takes γ(3) for the square of its length, half of that and one u for the root, one each for
    /// the quotient, q itself and r: γ(6) of r q. The last sum takes u of its result.
    ///
    /// That bound grows with r. Where it would exceed 2⁻¹⁷ of the point's coordinates, shadows
    /// would be lost, and the point along the ray is moved onto the sphere instead.
    #[inline(always)]
    fn place<R: RuleSource>(&self, rules: R, ray: &Ray<T>, t: T) -> HitPoint<T> {
        let out = self.outwards(ray, t);
        let at = ray.at(t);
        let share = T::of(6.0 * 131_072.0) * T::ULP;
        let (point, error) = if self.radius * share > at.abs().dot(Vec3::ONE) {
            self.moved_onto(at, out)
        } else {
            let offset = out * self.radius;
            let point = self.center + offset;
            (point, (offset.abs() * T::of(6.0) + point.abs()) * T::ULP)
        };
        let n_geom = match rules.get().sphere_normal {
            SphereNormal::FromCentre => out,
            _ => self.normal(rules, point),
        };
        HitPoint { point, error, n_geom }
    }

    /// Returns X − h q, and the bound of its error, for the point X along the ray, its height h
    /// above the sphere, and the unit vector q towards X from the centre.
    ///
    /// h = p / (‖X − C‖ + r), where p is the power of X with respect to the sphere. It takes 6u of
    /// itself, q takes 6u, and the product and the sum one u each of their results.
    #[cold]
    #[inline(never)]
    fn moved_onto(&self, at: Vec3<T>, out: Vec3<T>) -> (Vec3<T>, Vec3<T>) {
        let power = settle::power(&self.center, &self.radius, &at);
        let height = power / ((at - self.center).length() + self.radius);
        let point = at - out * height;
        (point, (point.abs() + Vec3::ONE * (height.abs() * T::of(16.0))) * T::ULP)
    }
}

impl<T: Real> Plane<T> {
    /// Returns X + (k − N·X)/(N·N) N, where X is the point along the ray.
    ///
    /// There N·X = k holds except for the roundings of the sums: γ(8) (|k| + Σ |N_i X_i|) along N.
    /// N need not be of unit length.
    #[inline(always)]
    fn place(&self, at: Vec3<T>) -> HitPoint<T> {
        let n = self.normal;
        let inverse = T::ONE / n.dot(n);
        let point = at + n * ((self.k - n.dot(at)) * inverse);
        let terms = self.k.abs() + n.abs().dot(at.abs());
        HitPoint { point, error: n.abs() * (terms * inverse * T::of(8.0) * T::ULP), n_geom: n }
    }
}

impl<T: Real> Cuboid<T> {
    /// Returns the point on the face: the coordinate of the face is exact, and the errors of the
    /// others lie within the face.
    #[inline(always)]
    fn place<R: RuleSource>(&self, rules: R, at: Vec3<T>, part: u32) -> HitPoint<T> {
        let face = if part % 2 == 1 { self.max } else { self.min };
        let pick = |axis: u32, of: T, face: T| if part / 2 == axis { face } else { of };
        let point = Vec3::new(pick(0, at.x, face.x), pick(1, at.y, face.y), pick(2, at.z, face.z));
        HitPoint { point, error: Vec3::ZERO, n_geom: Self::normal_at(rules, point, part) }
    }
}

impl<T: Real> Round<T> {
    /// Returns the point on a cap or on the side.
    ///
    /// z of a cap is exact. On the side, (x, y) is scaled to length r(z): it is off by γ(6) of it
    /// as on the sphere, and by what r(z) itself loses, three roundings of the slope and three more
    /// of the terms of r(z).
    #[inline(always)]
    fn place<R: RuleSource>(&self, rules: R, ray: &Ray<T>, hit: &ShapeHit<T>) -> HitPoint<T> {
        let part = hit.part;
        if let Some(z) = self.cap_height(part) {
            let at = ray.at(hit.t);
            let point = Vec3::new(at.x, at.y, z);
            return HitPoint { point, error: Vec3::ZERO, n_geom: self.normal(rules, point, part) };
        }
        let at = self.on_side(ray, hit.t);
        let (out, z) =
            (Vec3::new(at.x, at.y, T::ZERO), at.z.greatest(self.z_min).least(self.z_max));
        let radius = self.radius(z);
        let out = if out == Vec3::ZERO { out } else { out.normalised() * radius };
        let point = Vec3::new(out.x, out.y, z);
        let of_radius = self.bottom_radius.abs() + (radius - self.bottom_radius).abs();
        let loss = T::of(if self.bottom_radius == self.top_radius { 0.0 } else { 6.0 });
        let across = (out.abs() * T::of(6.0) + Vec3::ONE * (of_radius * loss)) * T::ULP;
        HitPoint {
            point,
            error: Vec3::new(across.x, across.y, T::ZERO),
            n_geom: self.normal(rules, point, part),
        }
    }
}

/// Returns α A + β B + γ C, the hit point on a triangle.
///
/// The point is off its plane by at most γ(4) for weights whose sum is not quite 1 and γ(5) for
/// their products and sums, both of the greatest of the sums of magnitudes: where a ray hits a
/// triangle, its coordinates mix.
#[inline(always)]
pub(crate) fn on_triangle<T: Real>(
    corners: &[Vec3<T>; 3],
    weights: Vec3<T>,
    n_geom: Vec3<T>,
) -> HitPoint<T> {
    let [a, b, c] = corners;
    let (a, b, c) = (*a * weights.x, *b * weights.y, *c * weights.z);
    let terms = (a.abs() + b.abs() + c.abs()).max_element();
    HitPoint { point: a + b + c, error: Vec3::ONE * (terms * T::of(9.0) * T::ULP), n_geom }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    #[test]
    fn a_ray_leaves_a_plane_whose_normal_is_not_of_unit_length() {
        let normal = Vec3::new(0.0, 1.0 + 1e-7, 0.0);
        let plane = Plane { normal, k: 0.0 };
        for n in 1..1000 {
            // off the plane by what rounding leaves of some units
            let at = Vec3::new(f64::from(n), f64::from(n) * 1e-19, 1.0);
            let hit_point = plane.place(at);
            assert!(
                hit_point.point.y.abs() <= hit_point.error.y,
                "{hit_point:?} is off by more than its bound"
            );
            let leaving = Ray::spawned(Lecture, &hit_point, Vec3::new(0.8, 0.6, 0.0));
            assert_eq!(
                plane.intersect(Lecture, &leaving),
                None,
                "{leaving:?} hits the plane that it leaves"
            );
        }
    }

    #[test]
    fn the_bound_on_a_large_sphere_is_that_of_the_point() {
        let sphere = Sphere { center: Vec3::new(0.0f32, -1e6, 0.0), radius: 1e6 };
        for n in 1..100 {
            let ray = Ray::all_of(Vec3::new(0.0, 1.0, 0.0), Vec3::new(n as f32, -8.0, 3.0));
            let hit = sphere.intersect(Lecture, &ray).unwrap();
            let HitPoint { point, error, .. } = sphere.place(Lecture, &ray, hit.t);
            // ‖X − C‖² − r² = x² + y² + z² + 2 r y
            let at = point.f64();
            let height = ((at.length_squared() + 2e6 * at.y) / 2e6).abs();
            assert!(height <= error.y.f64(), "{point:?} is {height:e} off, not {error:?}");
            assert!(error.y < 4e-6, "{error:?}"); // without the second step, 0.7
        }
    }
}
