//! The sphere. [rule 14]

use super::Meeting;
use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
use crate::roots;
use crate::rules::{Quadratic, RuleSource, SphereNormal, SphereRoots};
use crate::vec3::Vec3;

/// ‖X − center‖ = radius.
#[derive(Clone, Copy, Debug)]
pub struct Sphere<T> {
    /// Center.
    pub center: Vec3<T>,
    /// Radius, above 0.
    pub radius: T,
}

impl<T: Real> Sphere<T> {
    /// The first meeting in the ray's interval: the near root, or the far one where the near one does not count. [rule 14]
    ///
    /// The discriminant is taken from the point of the ray nearest to the centre (Haines et al., Ray Tracing Gems, chapter 7),
    /// which does not cancel when the sphere is small and far away. A touching ray meets it once.
    #[inline(always)]
    pub fn meet<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        let from_center = ray.origin - self.center;
        let a = match rules.get().sphere_roots {
            SphereRoots::UnitDirection => T::ONE,
            _ => ray.direction.dot(ray.direction),
        };
        let b = -from_center.dot(ray.direction);
        let c = from_center.dot(from_center) - self.radius * self.radius;
        let roots = match rules.get().style.quadratic {
            Quadratic::NearestPoint if rules.get().sphere_roots != SphereRoots::UnitDirection => {
                let nearest = from_center + ray.direction * (b / a);
                roots::ascending(a, b, c, a * (self.radius * self.radius - nearest.dot(nearest)))?
            }
            Quadratic::Textbook => roots::textbook(a, b, c)?,
            // who forgets d·d does so in the usual discriminant
            Quadratic::NearestPoint | Quadratic::Stable => roots::ascending(a, b, c, b * b - a * c)?,
            Quadratic::Geometric => {
                let middle = b / a;
                let from_axis = from_center.dot(from_center) - middle * middle * a; // squared
                roots::about(middle, (self.radius * self.radius - from_axis) / a)?
            }
        };
        let t = match rules.get().sphere_roots {
            SphereRoots::NearThenFar | SphereRoots::UnitDirection => ray.first(roots)?,
            SphereRoots::NearOnly => ray.first([roots[0]; 2])?,
            SphereRoots::FarFirst => ray.first([roots[1], roots[0]])?,
        };
        Some(Meeting::with(t, 0))
    }

    /// The outward unit normal at a point of the sphere.
    #[inline(always)]
    pub fn normal<R: RuleSource>(&self, rules: R, point: Vec3<T>) -> Vec3<T> {
        match rules.get().sphere_normal {
            SphereNormal::FromCentre => (point - self.center).normalised(),
            SphereNormal::FromOrigin => point.normalised(),
            SphereNormal::Inwards => (self.center - point).normalised(),
        }
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        let reach = Vec3::ONE * self.radius;
        Bounds { min: self.center - reach, max: self.center + reach }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    /// With the unit sphere about (0, 0, -5).
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<f64>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let sphere = Sphere { center: vec([0.0, 0.0, -5.0]), radius: 1.0 };
        let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
        let t = sphere.meet(Lecture, &ray).map(|m| m.t);
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
        check([1.0, 0.0, 0.0], [0.0, 0.0, -1.0], Some(5.0)); // touching
        check([1.0000001, 0.0, 0.0], [0.0, 0.0, -1.0], None);
        check([0.0, 0.0, -5.0], [0.0, 0.0, -1.0], Some(1.0)); // from the centre, the far root
        check([0.0, 0.0, -4.0], [0.0, 0.0, -1.0], Some(2.0)); // from the surface, never itself again
        check([0.6, 0.0, 0.0], [0.0, 0.0, -1.0], Some(4.2)); // 3-4-5: half chord 0.8
    }

    #[test]
    fn a_far_sphere_keeps_its_digits() {
        check([1e8, 0.0, -5.0], [-1.0, 0.0, 0.0], Some(1e8 - 1.0));
        check([1e8, 0.0, -3.999], [-1.0, 0.0, 0.0], None);
    }
}
