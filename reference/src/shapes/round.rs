//! Cylinder and cone: both are a radius that goes linearly along z.

use super::Meeting;
use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
use crate::roots;
use crate::rules::{Quadratic, RuleSource};
use crate::vec3::Vec3;

const SIDE: u32 = 0;
const BOTTOM: u32 = 1;
const TOP: u32 = 2;

/// x² + y² = r(z)², z_min ≤ z ≤ z_max, r linear between its values at the ends.
#[derive(Clone, Copy, Debug)]
pub struct Round<T> {
    /// r(z_min).
    pub bottom_radius: T,
    /// r(z_max); not both are 0.
    pub top_radius: T,
    /// Lower end.
    pub z_min: T,
    /// Upper end, above `z_min`.
    pub z_max: T,
    /// Whether discs close both ends.
    pub is_capped: bool,
}

impl<T: Real> Round<T> {
    /// dr/dz.
    fn slope(&self) -> T {
        (self.top_radius - self.bottom_radius) / (self.z_max - self.z_min)
    }

    /// r(z).
    pub(super) fn radius(&self, z: T) -> T {
        self.bottom_radius + self.slope() * (z - self.z_min)
    }

    /// z of a cap; `None` for the side.
    pub(super) fn cap_height(&self, part: u32) -> Option<T> {
        match part {
            BOTTOM => Some(self.z_min),
            TOP => Some(self.z_max),
            _ => None,
        }
    }

    /// The first meeting in the ray's interval; on a rim the side is met. The ends belong to it.
    pub fn meet<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        let mut met = self.side(rules, ray);
        if self.is_capped {
            for (part, z, radius) in [(BOTTOM, self.z_min, self.bottom_radius), (TOP, self.z_max, self.top_radius)] {
                let cap = cap(ray, z, radius).map(|t| Meeting::with(t, part));
                met = match (met, cap) {
                    (Some(side), Some(cap)) if cap.t < side.t => Some(cap),
                    (side, cap) => side.or(cap),
                };
            }
        }
        met
    }

    fn side<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        let (o, d) = (ray.origin, ray.direction);
        let (radius, slope) = (self.radius(o.z), self.slope());
        let growth = slope * d.z; // of the radius along the ray
        let a = d.x * d.x + d.y * d.y - growth * growth;
        let b = radius * growth - (o.x * d.x + o.y * d.y);
        let c = o.x * o.x + o.y * o.y - radius * radius;
        let roots = match rules.get().style.quadratic {
            Quadratic::NearestPoint | Quadratic::Geometric => {
                let across = o.x * d.y - o.y * d.x;
                let (x, y) = (radius * d.x - growth * o.x, radius * d.y - growth * o.y);
                let disc = x * x + y * y - across * across; // b² − a c, multiplied out: the fourth powers cancel on paper
                roots::ascending(a, b, c, disc)?
            }
            Quadratic::Textbook => roots::textbook(a, b, c)?,
            Quadratic::Stable => roots::ascending(a, b, c, b * b - a * c)?,
        };
        let is_on = |t: &T| {
            let z = o.z + *t * d.z;
            self.z_min <= z && z <= self.z_max && ray.contains(*t)
        };
        roots.into_iter().find(is_on).map(|t| Meeting::with(t, SIDE))
    }

    /// The outward unit normal at `point`. At the tip of a cone, where there is none, that along the axis.
    pub fn normal(&self, point: Vec3<T>, part: u32) -> Vec3<T> {
        let up = Vec3::axis(2);
        match part {
            BOTTOM => -up,
            TOP => up,
            _ => {
                let out = Vec3::new(point.x, point.y, -self.slope() * self.radius(point.z));
                match out.dot(out) > T::ZERO {
                    true => out.normalised(),
                    false if self.slope() > T::ZERO => -up,
                    false => up,
                }
            }
        }
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        let radius = self.bottom_radius.greatest(self.top_radius);
        Bounds { min: Vec3::new(-radius, -radius, self.z_min), max: Vec3::new(radius, radius, self.z_max) }
    }
}

fn cap<T: Real>(ray: &Ray<T>, z: T, radius: T) -> Option<T> {
    if ray.direction.z == T::ZERO {
        return None;
    }
    let t = (z - ray.origin.z) / ray.direction.z;
    let at = ray.at(t);
    (at.x * at.x + at.y * at.y <= radius * radius && ray.contains(t)).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    fn check(round: Round<f64>, origin: [f64; 3], direction: [f64; 3], expected: Option<(f64, [f64; 3])>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
        let found = round.meet(Lecture, &ray).map(|m| (m.t, round.normal(ray.at(m.t), m.part)));
        let (Some((t, n)), Some((wanted_t, wanted_n))) = (found, expected) else {
            assert_eq!(found.is_some(), expected.is_some(), "from {origin:?} along {direction:?}: {found:?}");
            return;
        };
        let error = (t - wanted_t).abs() + (n - vec(wanted_n)).length();
        assert!(error < 1e-15, "from {origin:?} along {direction:?}: {t} {n:?} is not {wanted_t} {wanted_n:?}");
    }

    #[test]
    fn a_cylinder_worked_out_on_paper() {
        let open = Round { bottom_radius: 1.0, top_radius: 1.0, z_min: 0.0, z_max: 2.0, is_capped: false };
        let capped = Round { is_capped: true, ..open };
        check(open, [-3.0, 0.0, 1.0], [1.0, 0.0, 0.0], Some((2.0, [-1.0, 0.0, 0.0])));
        check(open, [-3.0, 0.6, 1.0], [1.0, 0.0, 0.0], Some((2.2, [-0.8, 0.6, 0.0])));
        check(open, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [1.0, 0.0, 0.0]))); // from inside, still outwards
        check(open, [-3.0, 0.0, 2.5], [1.0, 0.0, 0.0], None);
        check(open, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], None); // through both open ends
        check(open, [-2.0, 0.0, 3.0], [1.0, 0.0, -1.0], Some((1.0, [-1.0, 0.0, 0.0]))); // the rim belongs to it
        check(open, [-1.5, 0.0, 3.0], [1.0, 0.0, -1.0], Some((2.5, [1.0, 0.0, 0.0]))); // in by the end, out by the side
        check(capped, [0.5, 0.0, 5.0], [0.0, 0.0, -1.0], Some((3.0, [0.0, 0.0, 1.0])));
        check(capped, [0.5, 0.0, 1.0], [0.0, 0.0, -1.0], Some((1.0, [0.0, 0.0, -1.0])));
    }

    #[test]
    fn a_cone_worked_out_on_paper() {
        let cone = Round { bottom_radius: 1.0, top_radius: 0.0, z_min: 0.0, z_max: 1.0, is_capped: true };
        let h = 0.5f64.sqrt();
        check(cone, [-2.0, 0.0, 0.5], [1.0, 0.0, 0.0], Some((1.5, [-h, 0.0, h])));
        check(cone, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0], Some((1.0, [0.0, 0.0, -1.0])));
        check(cone, [0.0, 0.0, 3.0], [0.0, 0.0, -1.0], Some((2.0, [0.0, 0.0, 1.0]))); // the tip
        check(cone, [-2.0, 0.0, 1.5], [1.0, 0.0, 0.0], None); // the other nappe is no part of it
        check(cone, [-0.5, 0.0, -1.0], [1.0, 0.0, 1.0], Some((1.0, [0.0, 0.0, -1.0])));
        let open = Round { is_capped: false, ..cone };
        check(open, [-1.0, 0.0, -0.5], [1.0, 0.0, 1.0], Some((1.25, [h, 0.0, h]))); // along the near side's slant: a = 0
    }
}
