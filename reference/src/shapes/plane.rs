//! The plane. [rule 15]

use super::hit::ShapeHit;
use super::settle;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{PlaneFormula, PlaneSide, Robustness, RuleSource};

/// The plane N·X = k, with a unit vector N.
#[derive(Clone, Copy, Debug)]
pub struct Plane<T> {
    /// The unit normal N.
    pub normal: Vec3<T>,
    /// The offset k of the plane along N.
    pub k: T,
}

impl<T: Real> Plane<T> {
    /// Returns the hit in the ray's interval; `None` for a miss. [rule 15]
    ///
    /// A parallel ray misses the plane, even one that runs within it.
    #[inline(always)]
    pub fn intersect<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        if rules.get().plane == PlaneSide::FrontOnly && self.normal.dot(ray.direction) > T::ZERO {
            return None;
        }
        let k = self.offset(rules);
        let t = match rules.get().style.robustness {
            Robustness::Certified => self.certified(k, ray),
            Robustness::Plain => self.plain(rules, k, ray),
        }?;
        ray.contains(t).then(|| ShapeHit::with(t, 0))
    }

    /// Returns k, or what a mistake takes for it. [rule 15]
    #[inline(always)]
    pub(super) fn offset<R: RuleSource>(&self, rules: R) -> T {
        match rules.get().plane {
            PlaneSide::Both | PlaneSide::FrontOnly => self.k,
            PlaneSide::NegatedK => -self.k,
            PlaneSide::ThroughOrigin => T::ZERO,
        }
    }

    /// Returns t = (k − N·P) / N·d; `None` for a parallel ray, and where t certainly does not
    /// count.
    ///
    /// With u half a ulp, N·d is off by 3u Σ|N_i d_i| at most and k − N·P by 4u (|k| + Σ|N_i P_i|);
    /// 8u is twice that. Where that leaves a sign open, or most digits of t cancel, the second step
    /// is taken. A ray that starts on a plane through the origin has only terms that are 0: it
    /// leaves the plane at t = 0, or is parallel.
    #[inline(always)]
    fn certified(&self, k: T, ray: &Ray<T>) -> Option<T> {
        let n = self.normal;
        let (slope, slopes) = (n.dot(ray.direction), n.abs().dot(ray.direction.abs()));
        let (height, terms) = (k - n.dot(ray.origin), k.abs() + n.abs().dot(ray.origin.abs()));
        if slopes.is_safe() && terms.is_safe() {
            let exceeds = |share: T| slope.abs() > slopes * share && height.abs() > terms * share;
            if exceeds(T::of(4.0) * T::ULP)
                && (slope < T::ZERO) != (height < T::ZERO)
                && ray.is_before(T::ZERO)
            {
                return None;
            }
            if exceeds(T::of(1.0 / 32.0)) {
                return Some(height / slope);
            }
        }
        let is_zero = |axis: usize| (n[axis] == T::ZERO) | (ray.origin[axis] == T::ZERO);
        if k == T::ZERO && is_zero(0) & is_zero(1) & is_zero(2) && ray.is_before(T::ZERO) {
            return None;
        }
        settle::plane(&self.normal, k, ray)
    }

    /// Returns t as students compute it; `None` for a parallel ray.
    #[inline(always)]
    fn plain<R: RuleSource>(&self, rules: R, k: T, ray: &Ray<T>) -> Option<T> {
        let slope = self.normal.dot(ray.direction);
        let way = match rules.get().style.plane {
            PlaneFormula::FromFoot => self.normal.dot(self.normal * k - ray.origin),
            PlaneFormula::Textbook => k - self.normal.dot(ray.origin),
        };
        (slope != T::ZERO).then(|| way / slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    /// Checks a ray against the plane 0.6 x + 0.8 y = 2.
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<f64>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let plane = Plane { normal: vec([0.6, 0.8, 0.0]), k: 2.0 };
        let t = plane
            .intersect(Lecture, &Ray::leaving(Lecture, vec(origin), vec(direction)))
            .map(|m| m.t);
        match (t, expected) {
            (Some(t), Some(wanted)) => {
                assert!((t - wanted).abs() < 1e-15, "from {origin:?}: {t} is not {wanted}")
            }
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

    #[test]
    fn a_ray_that_starts_on_a_plane_through_the_origin_leaves_it() {
        let plane = Plane { normal: Vec3::axis(1), k: 0.0 };
        let from = |y: f64, direction: Vec3<f64>| {
            let ray = Ray::leaving(Lecture, Vec3::new(3.0, y, -2.0), direction);
            plane.intersect(Lecture, &ray).map(|hit| hit.t)
        };
        assert_eq!(from(0.0, Vec3::new(0.8, 0.6, 0.0)), None);
        assert_eq!(from(0.0, Vec3::new(0.8, -0.6, 0.0)), None);
        assert_eq!(from(-0.0, Vec3::new(1.0, 0.0, 0.0)), None);
        // The plane lies a little below, although products with 1e-200 are not trusted.
        assert_eq!(from(1e-200, Vec3::new(0.0, -0.5, 0.0)), Some(2e-200));
        assert_eq!(from(1e-200, Vec3::new(0.0, 0.5, 0.0)), None);
    }
}
