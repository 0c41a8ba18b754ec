//! Cylinder and cone: both have a radius that changes linearly along z.

use super::hit::ShapeHit;
use super::settle::Coil;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::two::Two;
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;
use crate::rays::ray::Ray;
use crate::rules::{ConeNormal, Lids, Quadratic, Robustness, RoundSide, RuleSource};

const SIDE: u32 = 0;
const BOTTOM: u32 = 1;
const TOP: u32 = 2;

/// The result of a formula that one word leaves open.
struct Doubt;

/// The surface x² + y² = r(z)², z_min ≤ z ≤ z_max, with r linear between its values at the ends.
#[derive(Clone, Copy, Debug)]
pub struct Round<T> {
    /// The radius r(z_min).
    pub bottom_radius: T,
    /// The radius r(z_max); the two radii are not both 0.
    pub top_radius: T,
    /// The lower end.
    pub z_min: T,
    /// The upper end, above `z_min`.
    pub z_max: T,
    /// Whether discs close both ends.
    pub is_capped: bool,
}

impl<T: Real> Round<T> {
    /// Returns dr/dz.
    pub(super) fn slope(&self) -> T {
        (self.top_radius - self.bottom_radius) / (self.z_max - self.z_min)
    }

    /// Returns r(z).
    pub(super) fn radius(&self, z: T) -> T {
        self.bottom_radius + self.slope() * (z - self.z_min)
    }

    /// Returns z of a cap; `None` for the side.
    pub(super) fn cap_height(&self, part: u32) -> Option<T> {
        match part {
            BOTTOM => Some(self.z_min),
            TOP => Some(self.z_max),
            _ => None,
        }
    }

    /// Returns the first hit in the ray's interval; `None` for a miss. On a rim, the hit is on the
    /// side. The ends belong to the surface.
    #[inline(always)]
    pub fn intersect<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        self.first(rules, ray).map(|(t, part)| ShapeHit::with(t, part))
    }

    /// Returns t of the first hit, and its part.
    #[inline(never)]
    fn first<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<(T, u32)> {
        let style = &rules.get().style;
        let is_own =
            style.quadratic == Quadratic::NearestPoint || style.quadratic == Quadratic::Geometric;
        let is_own = is_own && rules.get().has_right_rounds();
        if style.robustness == Robustness::Certified && is_own {
            return self.certified(ray).unwrap_or_else(|Doubt| self.settled(ray, ray));
        }
        let caps = self.caps().map(|(part, z, radius)| (part, cap(ray, z, radius)));
        let is_capped = match rules.get().lids {
            Lids::AsGiven => self.is_capped,
            Lids::Never => false,
            Lids::Always => true,
        };
        Self::nearest(self.side(rules, ray), caps, is_capped)
    }

    /// Returns part, z and radius of both ends.
    fn caps(&self) -> [(u32, T, T); 2] {
        [(BOTTOM, self.z_min, self.bottom_radius), (TOP, self.z_max, self.top_radius)]
    }

    /// Returns the nearest of the hits on the side and, if they are closed, on the ends.
    fn nearest(side: Option<T>, caps: [(u32, Option<T>); 2], is_capped: bool) -> Option<(T, u32)> {
        let mut hit = side.map(|t| (t, SIDE));
        for (part, t) in caps.into_iter().filter(|_| is_capped) {
            let cap = t.map(|t| (t, part));
            hit = match (hit, cap) {
                (Some(side), Some(cap)) if cap.0 < side.0 => Some(cap),
                (side, cap) => side.or(cap),
            };
        }
        hit
    }

    /// Returns the first hit, if rounding cannot change it; otherwise the error is [`Doubt`].
    fn certified(&self, ray: &Ray<T>) -> Result<Option<(T, u32)>, Doubt> {
        let side = self.certified_side(ray)?;
        let [bottom, top] = self.caps();
        let cap = |(part, z, radius)| {
            Ok((part, if self.is_capped { certified_cap(ray, z, radius)? } else { None }))
        };
        Ok(Self::nearest(side, [cap(bottom)?, cap(top)?], self.is_capped))
    }

    /// Returns the first hit in the interval of `ray`, computed in two words from `exact`. On a
    /// rim, where even these cannot separate side and end, the hit is on the side.
    #[cold]
    #[inline(never)]
    pub(super) fn settled(&self, ray: &Ray<T>, exact: &impl ExactRay) -> Option<(T, u32)> {
        let coil = self.coil(exact)?;
        let counts = |t: &Two| ray.contains(coil.t(*t));
        let mut first = coil.side().into_iter().find(counts).map(|t| (t, SIDE));
        for (end, part) in [(0, BOTTOM), (1, TOP)].into_iter().filter(|_| self.is_capped) {
            let Some(t) = coil.cap(end).filter(counts) else { continue };
            let is_nearer = |(best, _): (Two, u32)| {
                (best - t).certain(best.f64().abs() + t.f64().abs()) > Two::ZERO
            };
            first = if first.is_none_or(is_nearer) { Some((t, part)) } else { first };
        }
        first.map(|(t, part)| (coil.t(t), part))
    }

    /// Returns t of the first hit on the side.
    ///
    /// Let h = ‖(x, y)‖² + R², with R the magnitudes of the terms of r at the origin, and l the
    /// length of (d_x, d_y) and of the growth of r, squared. With u half a ulp, r is off by 6u R
    /// and its growth by 4u of itself, so the discriminant by 38u h l at most, c by 14u h and a by
    /// 10u l. The formula demands twice that, and more where few digits would be left; otherwise
    /// the second step is taken. It is also taken where z is as near to an end as it may be off.
    #[inline(always)]
    fn certified_side(&self, ray: &Ray<T>) -> Result<Option<T>, Doubt> {
        let (o, d) = (ray.origin, ray.direction);
        let slope = self.slope();
        let (rise, growth) = (slope * (o.z - self.z_min), slope * d.z);
        let (radius, most) = (self.bottom_radius + rise, self.bottom_radius + rise.abs());
        let (dd, gg, oo) = (d.x * d.x + d.y * d.y, growth * growth, o.x * o.x + o.y * o.y);
        let (h, l) = (oo + most * most, dd + gg);
        let (a, b, c) = (dd - gg, radius * growth - (o.x * d.x + o.y * d.y), oo - radius * radius);
        let disc = self.discriminant(ray, radius, growth);
        let doubt = h * l * (T::of(40.0) * T::ULP);
        if !(h.is_safe() && l.is_safe()) {
            return Err(Doubt);
        }
        if disc < -doubt {
            return Ok(None);
        }
        let c_doubt = h * (T::of(16.0) * T::ULP);
        let (is_flat, leaves) = (a > l * T::of(1.0 / 64.0), b < T::ZERO);
        if is_flat && c > c_doubt && leaves && disc > doubt && ray.is_before(T::ZERO) {
            return Ok(None);
        }
        let has_digits = c.abs() > h * T::of(0.25) || (is_flat && c < -c_doubt && !leaves);
        if !(disc > doubt * T::MARGIN && (is_flat || a < -l * T::of(1.0 / 64.0)) && has_digits) {
            return Err(Doubt);
        }
        let Some(roots) = roots::ascending(a, b, c, disc) else { return Ok(None) };
        let root = (roots[1] - roots[0]) * a.abs() * T::HALF;
        let share = doubt / (root * (b.abs() + root)) + T::of(512.0) * T::ULP; // of t
        for t in roots.into_iter().filter(|t| ray.contains(*t)) {
            let z = o.z + t * d.z;
            let doubt = (t * d.z).abs() * share + o.z.abs() * T::ULP;
            let (above, below) = (z - self.z_min, self.z_max - z);
            if !(above.abs() > doubt && below.abs() > doubt) {
                return Err(Doubt);
            }
            if above > T::ZERO && below > T::ZERO {
                return Ok(Some(t));
            }
        }
        Ok(None)
    }

    /// Returns b² − a c, multiplied out: the fourth powers cancel on paper.
    #[inline(always)]
    pub(super) fn discriminant(&self, ray: &Ray<T>, radius: T, growth: T) -> T {
        let (o, d) = (ray.origin, ray.direction);
        let across = o.x * d.y - o.y * d.x;
        let (x, y) = (radius * d.x - growth * o.x, radius * d.y - growth * o.y);
        x * x + y * y - across * across
    }

    /// Returns t of the first hit on the side, as students compute it.
    fn side<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<T> {
        let (o, d) = (ray.origin, ray.direction);
        let (radius, slope) = (self.radius(o.z), self.slope());
        let growth = slope * d.z; // of the radius along the ray
        let a = d.x * d.x + d.y * d.y - growth * growth;
        let b = radius * growth - (o.x * d.x + o.y * d.y);
        let c = o.x * o.x + o.y * o.y - radius * radius;
        let roots = match rules.get().style.quadratic {
            Quadratic::NearestPoint | Quadratic::Geometric => {
                roots::ascending(a, b, c, self.discriminant(ray, radius, growth))?
            }
            Quadratic::Textbook => roots::textbook(a, b, c)?,
            Quadratic::Stable => roots::ascending(a, b, c, b * b - a * c)?,
        };
        let is_on = |t: &T| {
            let z = o.z + *t * d.z;
            let is_between = self.z_min <= z && z <= self.z_max;
            (is_between || rules.get().round_side == RoundSide::Endless) && ray.contains(*t)
        };
        let n_roots = if rules.get().round_side == RoundSide::NearOnly { 1 } else { 2 };
        roots.into_iter().take(n_roots).find(is_on)
    }

    /// Returns the point of the side at the hit of the ray at `t`, however far away the origin is.
    ///
    /// Where the origin is 64 times as far from the axis as the hit, or more, the point that t
    /// alone gives has too few digits: it is computed in two words.
    #[inline(always)]
    pub(super) fn on_side(&self, ray: &Ray<T>, t: T) -> Vec3<T> {
        let point = if self.is_far(ray, t) { self.exact_point(ray, t) } else { None };
        point.unwrap_or_else(|| ray.at(t))
    }

    /// Returns whether the point of a hit along the ray has too few digits.
    #[inline(always)]
    pub(super) fn is_far(&self, ray: &Ray<T>, t: T) -> bool {
        let (o, at) = (ray.origin, ray.at(t));
        let (oo, rr) = (o.x * o.x + o.y * o.y, at.x * at.x + at.y * at.y);
        !(rr.is_safe() && oo < rr * T::of(4096.0))
    }

    /// Returns the point of the side at the hit of the ray at `t`, computed in two words; `None`
    /// for a ray that does not hit it.
    pub(super) fn exact_point(&self, ray: &impl ExactRay, t: T) -> Option<Vec3<T>> {
        self.coil(ray)?.on_side(t)
    }

    /// Returns this surface and the line of the ray in two words; `None` for a ray without
    /// direction.
    fn coil(&self, ray: &impl ExactRay) -> Option<Coil> {
        Coil::new(&[self.bottom_radius, self.top_radius], &[self.z_min, self.z_max], ray)
    }

    /// Returns the outward unit normal at `point` of a part. The tip of a cone has none: the result
    /// there is the outward direction along the axis.
    pub fn normal<R: RuleSource>(&self, rules: R, point: Vec3<T>, part: u32) -> Vec3<T> {
        let up = Vec3::axis(2);
        match part {
            BOTTOM => -up,
            TOP => up,
            _ => {
                let rise = match rules.get().cone_normal {
                    ConeNormal::OfSide => -self.slope() * self.radius(point.z),
                    ConeNormal::Horizontal => T::ZERO,
                };
                let out = Vec3::new(point.x, point.y, rise);
                match out.dot(out) > T::ZERO {
                    true => out.normalised(),
                    false if self.slope() > T::ZERO => -up,
                    false => up,
                }
            }
        }
    }

    /// Returns the least box around the surface, in object space.
    pub fn bounds(&self) -> Bounds<T> {
        let radius = self.bottom_radius.greatest(self.top_radius);
        Bounds {
            min: Vec3::new(-radius, -radius, self.z_min),
            max: Vec3::new(radius, radius, self.z_max),
        }
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

/// Returns t on an end, if rounding cannot change whether it is within the rim; otherwise the error
/// is [`Doubt`].
///
/// With u half a ulp, a coordinate there is off by 4u of the magnitudes of its terms, so the
/// comparison by 12u of their squares and the radius's.
fn certified_cap<T: Real>(ray: &Ray<T>, z: T, radius: T) -> Result<Option<T>, Doubt> {
    let (o, d) = (ray.origin, ray.direction);
    let t = (z - o.z) / d.z;
    if d.z == T::ZERO || !ray.contains(t) {
        return Ok(None);
    }
    let (x, y) = (o.x + d.x * t, o.y + d.y * t);
    let (most_x, most_y) = (o.x.abs() + (d.x * t).abs(), o.y.abs() + (d.y * t).abs());
    let most = most_x * most_x + most_y * most_y + radius * radius;
    let (beyond, doubt) = (x * x + y * y - radius * radius, most * (T::of(12.0) * T::ULP));
    match most.is_safe() && beyond.abs() > doubt {
        true => Ok((beyond < T::ZERO).then_some(t)),
        false => Err(Doubt),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    fn check(
        round: Round<f64>,
        origin: [f64; 3],
        direction: [f64; 3],
        expected: Option<(f64, [f64; 3])>,
    ) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
        let found = round
            .intersect(Lecture, &ray)
            .map(|m| (m.t, round.normal(Lecture, ray.at(m.t), m.part)));
        let (Some((t, n)), Some((wanted_t, wanted_n))) = (found, expected) else {
            assert_eq!(
                found.is_some(),
                expected.is_some(),
                "from {origin:?} along {direction:?}: {found:?}"
            );
            return;
        };
        let error = (t - wanted_t).abs() + (n - vec(wanted_n)).length();
        assert!(
            error < 1e-15,
            "from {origin:?} along {direction:?}: {t} {n:?} is not {wanted_t} {wanted_n:?}"
        );
    }

    #[test]
    fn a_cylinder_worked_out_on_paper() {
        let open =
            Round { bottom_radius: 1.0, top_radius: 1.0, z_min: 0.0, z_max: 2.0, is_capped: false };
        let capped = Round { is_capped: true, ..open };
        check(open, [-3.0, 0.0, 1.0], [1.0, 0.0, 0.0], Some((2.0, [-1.0, 0.0, 0.0])));
        check(open, [-3.0, 0.6, 1.0], [1.0, 0.0, 0.0], Some((2.2, [-0.8, 0.6, 0.0])));
        // from inside, still outwards
        check(open, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [1.0, 0.0, 0.0])));
        check(open, [-3.0, 0.0, 2.5], [1.0, 0.0, 0.0], None);
        check(open, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], None); // through both open ends
        // the rim belongs to it
        check(open, [-2.0, 0.0, 3.0], [1.0, 0.0, -1.0], Some((1.0, [-1.0, 0.0, 0.0])));
        // in by the end, out by the side
        check(open, [-1.5, 0.0, 3.0], [1.0, 0.0, -1.0], Some((2.5, [1.0, 0.0, 0.0])));
        check(capped, [0.5, 0.0, 5.0], [0.0, 0.0, -1.0], Some((3.0, [0.0, 0.0, 1.0])));
        check(capped, [0.5, 0.0, 1.0], [0.0, 0.0, -1.0], Some((1.0, [0.0, 0.0, -1.0])));
    }

    #[test]
    fn a_far_cylinder_keeps_the_digits_of_its_normal() {
        let cylinder =
            Round { bottom_radius: 1.0, top_radius: 1.0, z_min: 0.0, z_max: 2.0, is_capped: false };
        let ray = Ray::all_of(Vec3::new(-1e8, 0.6, 1.0), Vec3::axis(0));
        let hit = cylinder.intersect(Lecture, &ray).expect("a hit");
        let at = cylinder.on_side(&ray, hit.t);
        assert!((at - Vec3::new(-0.8, 0.6, 1.0)).length() < 1e-15, "{at:?}");
    }

    #[test]
    fn a_cone_worked_out_on_paper() {
        let cone =
            Round { bottom_radius: 1.0, top_radius: 0.0, z_min: 0.0, z_max: 1.0, is_capped: true };
        let h = 0.5f64.sqrt();
        check(cone, [-2.0, 0.0, 0.5], [1.0, 0.0, 0.0], Some((1.5, [-h, 0.0, h])));
        check(cone, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0], Some((1.0, [0.0, 0.0, -1.0])));
        check(cone, [0.0, 0.0, 3.0], [0.0, 0.0, -1.0], Some((2.0, [0.0, 0.0, 1.0]))); // the tip
        check(cone, [-2.0, 0.0, 1.5], [1.0, 0.0, 0.0], None); // the other nappe is no part of it
        check(cone, [-0.5, 0.0, -1.0], [1.0, 0.0, 1.0], Some((1.0, [0.0, 0.0, -1.0])));
        let open = Round { is_capped: false, ..cone };
        // along the near side's slant: a = 0
        check(open, [-1.0, 0.0, -0.5], [1.0, 0.0, 1.0], Some((1.25, [h, 0.0, h])));
    }
}
