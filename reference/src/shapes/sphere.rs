//! The sphere. [rule 14]

use super::hit::ShapeHit;
use super::settle::{self, Ball};
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::two::DOUBT;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{Quadratic, Robustness, RuleSource, SphereNormal, SphereRoots, SquaredRadius};

/// The sphere ‖X − center‖ = radius.
#[derive(Clone, Copy, Debug)]
pub struct Sphere<T> {
    /// The centre.
    pub center: Vec3<T>,
    /// The radius, at least 0.
    pub radius: T,
}

impl<T: Real> Sphere<T> {
    /// Returns the first hit in the ray's interval: the near root, or the far one where the near
    /// one does not count. `None` for a miss. [rule 14]
    ///
    /// t is in units of the length of the ray's direction. A tangent ray hits the sphere once. A
    /// sphere without radius is hit by the rays through its centre.
    ///
    /// ```
    /// use reference::{numbers::vec3::Vec3, rays::ray::Ray, rules::Lecture, shapes::Sphere};
    ///
    /// let sphere = Sphere { center: Vec3::new(0.0, 0.0, -5.0), radius: 1.0 };
    /// let ray = Ray::all_of(Vec3::ZERO, Vec3::new(0.0, 0.0, -2.0));
    /// // (5 − 2 t)² = 1 at t = 2 and t = 3
    /// assert_eq!(sphere.intersect(Lecture, &ray).map(|hit| hit.t), Some(2.0));
    /// ```
    #[inline(always)]
    pub fn intersect<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        let roots = self.roots(rules, ray)?;
        self.first(rules, ray, roots).map(|t| ShapeHit::with(t, 0))
    }

    /// Returns where the ray's line intersects the sphere, in ascending order; `None` where it does
    /// not, or neither root counts.
    #[inline(always)]
    pub(super) fn roots<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<[T; 2]> {
        let style = &rules.get().style;
        let is_certified = style.robustness == Robustness::Certified
            && style.quadratic == Quadratic::NearestPoint
            && rules.get().has_right_spheres();
        if is_certified { self.certified(ray) } else { self.plain(rules, ray) }
    }

    /// Returns the root that is the hit in the ray's interval.
    #[inline(always)]
    pub(super) fn first<R: RuleSource>(&self, rules: R, ray: &Ray<T>, roots: [T; 2]) -> Option<T> {
        match rules.get().sphere_roots {
            SphereRoots::NearThenFar | SphereRoots::UnitDirection | SphereRoots::FourMissing => {
                ray.first(roots)
            }
            SphereRoots::NearOnly => ray.first([roots[0]; 2]),
            SphereRoots::FarFirst => ray.first([roots[1], roots[0]]),
        }
    }

    /// Returns both roots, computed from the point n of the ray's line that is nearest to the
    /// centre. `None` means that there are none, or that neither counts.
    ///
    /// The gap r² − ‖n‖² does not cancel where the sphere is small and far away (Haines et al., Ray
    /// Tracing Gems, chapter 7).
    ///
    /// With u half a ulp, rounding moves n by 2u‖f‖ + u‖n‖ across the ray, f from the centre to the
    /// origin. (What it moves it by along the ray changes ‖n‖² only in second order.) So the gap is
    /// off by 4u‖f‖‖n‖ + 6u‖n‖² + 2u r² + u‖f‖² at most; as ‖n‖ ≤ ‖f‖, twice that is below 24u
    /// (‖f‖² + r²). c = ‖f‖² − r² is off by 6u‖f‖² + 2u r² at most. Where the gap leaves a sign
    /// open, or few digits of the roots, the second step is taken.
    ///
    /// c cancels where the origin is near the surface, as above a ground. Then c alone is computed
    /// in two words, which takes a fraction of the time that both roots would take. With such a c,
    /// b² − (d·d) c is off by the rounding of b² alone.
    ///
    /// Two kinds of rays are decided at once. One starts outside and goes away from the centre:
    /// where rounding hides that b = −f·d is above 0, by 4u‖f‖‖d‖ at most, b² is too small against
    /// (d·d) c for a root. The other passes the sphere widely: b² is off by 10u‖f‖²(d·d), (d·d) c
    /// by 12u (d·d)(‖f‖² + r²) at most, and their difference shows the miss without a division.
    #[inline(always)]
    fn certified(&self, ray: &Ray<T>) -> Option<[T; 2]> {
        let d = ray.direction;
        let f = ray.origin - self.center;
        let (a, b) = (d.dot(d), -f.dot(d));
        let (ff, rr) = (f.dot(f), self.radius * self.radius);
        let (c, size) = (ff - rr, ff + rr);
        if !(a.is_safe() && size.is_safe()) {
            return self.settled(ray);
        }
        let (leaves, in_doubt) = (b < T::ZERO, size * (T::of(3.0) * T::ULP));
        if leaves && c > in_doubt && ray.is_before(T::ZERO) {
            return None;
        }
        if a * c - b * b > a * size * (T::of(16.0) * T::ULP) {
            return None;
        }
        let nearest = f + d * (b / a);
        let gap = rr - nearest.dot(nearest);
        let doubt = size * (T::of(12.0) * T::ULP);
        if gap < -doubt {
            return None;
        }
        if gap > doubt * T::MARGIN {
            if c.abs() > size * T::of(0.25) || (c < -in_doubt && !leaves) {
                return roots::ascending(a, b, c, a * gap);
            }
            let c = settle::power(&self.center, &self.radius, &ray.origin);
            if c.abs() > size * T::of(DOUBT * f64::MARGIN) {
                return roots::ascending(a, b, c, b * b - a * c);
            }
        }
        self.settled(ray)
    }

    /// Returns both roots, computed in two words. They are destructured and built again, so that
    /// the roots of the first step stay in registers.
    #[inline(always)]
    fn settled(&self, ray: &Ray<T>) -> Option<[T; 2]> {
        let [near, far] = Ball::new(&self.center, &self.radius, ray)?.ts()?;
        Some([near, far])
    }

    /// Returns both roots as students compute them, without a bound of their error.
    #[inline(always)]
    fn plain<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<[T; 2]> {
        let from_center = ray.origin - self.center;
        let a = match rules.get().sphere_roots {
            SphereRoots::UnitDirection => T::ONE,
            _ => ray.direction.dot(ray.direction),
        };
        let b = -from_center.dot(ray.direction);
        let square = match rules.get().squared_radius {
            SquaredRadius::Given => self.radius * self.radius,
            SquaredRadius::One => T::ONE,
            SquaredRadius::Halved => self.radius * self.radius * (T::HALF * T::HALF),
            SquaredRadius::NotSquared => self.radius,
        };
        let c = from_center.dot(from_center) - square;
        if rules.get().sphere_roots == SphereRoots::FourMissing {
            return roots::four_missing(a, b, c);
        }
        match rules.get().style.quadratic {
            Quadratic::NearestPoint if rules.get().sphere_roots != SphereRoots::UnitDirection => {
                let nearest = from_center + ray.direction * (b / a);
                roots::ascending(a, b, c, a * (square - nearest.dot(nearest)))
            }
            Quadratic::Textbook => roots::textbook(a, b, c),
            // a student's `a` without d·d goes into the usual discriminant
            Quadratic::NearestPoint | Quadratic::Stable => roots::ascending(a, b, c, b * b - a * c),
            Quadratic::Geometric => {
                let middle = b / a;
                let from_axis = from_center.dot(from_center) - middle * middle * a; // squared
                roots::about(middle, (square - from_axis) / a)
            }
        }
    }

    /// Returns the outward unit normal at the hit of the ray at `t`, however far away the origin
    /// is.
    ///
    /// Where the origin is 64 radii away or more, the point that t alone gives has too few digits:
    /// it is computed in two words. For a sphere without radius, the result is the direction
    /// against the ray, normalised.
    #[inline(always)]
    pub fn outwards(&self, ray: &Ray<T>, t: T) -> Vec3<T> {
        let from_center = ray.origin - self.center;
        let (ff, rr) = (from_center.dot(from_center), self.radius * self.radius);
        if ff.is_safe() && rr.is_safe() && ff < rr * T::of(4096.0) {
            return (from_center + ray.direction * t).normalised();
        }
        let out = Ball::new(&self.center, &self.radius, ray)
            .and_then(|ball| ball.outwards(t))
            .filter(|out| *out != Vec3::ZERO);
        out.map_or_else(
            || -ray.direction.normalised(),
            |out| {
                let unit = out.normalised();
                Vec3::new(T::of(unit.x), T::of(unit.y), T::of(unit.z))
            },
        )
    }

    /// Returns the outward unit normal at a point of the sphere; NaN at the centre.
    #[inline(always)]
    pub fn normal<R: RuleSource>(&self, rules: R, point: Vec3<T>) -> Vec3<T> {
        match rules.get().sphere_normal {
            SphereNormal::FromCentre => (point - self.center).normalised(),
            SphereNormal::FromOrigin => point.normalised(),
            SphereNormal::Inwards => (self.center - point).normalised(),
            SphereNormal::NotUnit => point - self.center,
        }
    }

    /// Returns the least box around the sphere, in object space.
    pub fn bounds(&self) -> Bounds<T> {
        let reach = Vec3::ONE * self.radius;
        Bounds { min: self.center - reach, max: self.center + reach }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::real::scaled;
    use crate::rules::Lecture;

    /// Checks a ray against the unit sphere around (0, 0, -5).
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<f64>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let sphere = Sphere { center: vec([0.0, 0.0, -5.0]), radius: 1.0 };
        let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
        let t = sphere.intersect(Lecture, &ray).map(|m| m.t);
        let is_right = match (t, expected) {
            (Some(t), Some(wanted)) => (t - wanted).abs() <= 2.0 * f64::EPSILON * wanted,
            _ => t == expected,
        };
        assert!(is_right, "from {origin:?} along {direction:?}: {t:?} is not {expected:?}");
    }

    #[test]
    fn roots_worked_out_on_paper() {
        check([0.0; 3], [0.0, 0.0, -1.0], Some(4.0));
        check([0.0; 3], [0.0, 0.0, -2.0], Some(2.0)); // t is in units of d
        check([0.0; 3], [0.0, 0.0, 1.0], None); // behind
        check([1.0, 0.0, 0.0], [0.0, 0.0, -1.0], Some(5.0)); // tangent
        check([1.0000001, 0.0, 0.0], [0.0, 0.0, -1.0], None);
        check([0.0, 0.0, -5.0], [0.0, 0.0, -1.0], Some(1.0)); // from the centre, the far root
        // from the surface, never itself again
        check([0.0, 0.0, -4.0], [0.0, 0.0, -1.0], Some(2.0));
        check([0.6, 0.0, 0.0], [0.0, 0.0, -1.0], Some(4.2)); // 3-4-5: half chord 0.8
    }

    #[test]
    fn a_far_sphere_keeps_its_digits() {
        check([1e8, 0.0, -5.0], [-1.0, 0.0, 0.0], Some(1e8 - 1.0));
        check([1e8, 0.0, -3.999], [-1.0, 0.0, 0.0], None);
    }

    #[test]
    fn a_ray_near_a_large_sphere_keeps_its_digits() {
        let sphere = Sphere { center: Vec3::new(0.0, -1e6, 0.0), radius: 1e6 };
        let hit = |y: f64, down: f64| {
            let ray = Ray::leaving(Lecture, Vec3::new(0.0, y, 0.0), Vec3::new(0.0, -down, 0.0));
            sphere.intersect(Lecture, &ray).map(|hit| hit.t)
        };
        // Straight down, t is the height.
        for height in [4096.0, 1.5, scaled(1.0, -20), scaled(1.0, -52)] {
            assert_eq!(hit(height, 1.0), Some(height));
            assert_eq!(hit(height, -1.0), None);
        }
        for height in [0.0, scaled(1.0, -200)] {
            assert_eq!(hit(height, 1.0), Some(2e6)); // from the surface, the far root
        }
        assert_eq!(hit(-scaled(1.0, -30), 1.0), Some(2e6 - scaled(1.0, -30))); // from within
    }
}
