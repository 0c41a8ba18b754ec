//! The plane. [rule 15]

use super::Meeting;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{PlaneFormula, PlaneSide, RuleSource};
use crate::vec3::Vec3;

/// N·X = k, N a unit vector.
#[derive(Clone, Copy, Debug)]
pub struct Plane<T> {
    /// N.
    pub normal: Vec3<T>,
    /// k.
    pub k: T,
}

impl<T: Real> Plane<T> {
    /// The meeting in the ray's interval. [rule 15]
    ///
    /// t = N·(kN − P) / N·d: the difference of two points first, so that far from the origin nothing cancels. A parallel ray
    /// never meets it, not even one that runs within it.
    #[inline(always)]
    pub fn meet<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        let slope = self.normal.dot(ray.direction);
        if slope == T::ZERO || (rules.get().plane == PlaneSide::FrontOnly && slope > T::ZERO) {
            return None;
        }
        let k = if rules.get().plane == PlaneSide::NegatedK { -self.k } else { self.k };
        let t = match rules.get().style.plane {
            PlaneFormula::FromFoot => self.normal.dot(self.normal * k - ray.origin) / slope,
            PlaneFormula::Textbook => (k - self.normal.dot(ray.origin)) / slope,
        };
        ray.contains(t).then(|| Meeting::with(t, 0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    /// With the plane 0.6 x + 0.8 y = 2.
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<f64>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let plane = Plane { normal: vec([0.6, 0.8, 0.0]), k: 2.0 };
        let t = plane.meet(Lecture, &Ray::leaving(Lecture, vec(origin), vec(direction))).map(|m| m.t);
        match (t, expected) {
            (Some(t), Some(wanted)) => assert!((t - wanted).abs() < 1e-15, "from {origin:?}: {t} is not {wanted}"),
            _ => assert_eq!(t, expected, "from {origin:?} along {direction:?}"),
        }
    }

    #[test]
    fn distances_worked_out_on_paper() {
        check([0.0; 3], [0.6, 0.8, 0.0], Some(2.0));
        check([0.0; 3], [0.0, 1.0, 0.0], Some(2.5)); // 2 / 0.8
        check([0.0; 3], [0.0, -1.0, 0.0], None);
        check([6.0, 8.0, 1.0], [-0.6, -0.8, 0.0], Some(8.0)); // from behind: 10 − 2
        check([0.0; 3], [0.0, 0.0, 1.0], None); // parallel
    }
}
