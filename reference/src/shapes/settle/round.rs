//! Cylinder and cone in two words.

use super::line::{Line, greatest, times};
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::two::Two;
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;

/// The exponent that the greatest coordinate is scaled to. The discriminant has the fourth power of
/// coordinates.
const ROOM: i32 = 150;

/// A cylinder or cone, and a ray's line.
pub(in crate::shapes) struct Coil {
    line: Line,
    radii: [f64; 2],
    ends: [f64; 2],
}

impl Coil {
    /// Returns the surface with these radii at these values of z, and the line of `ray`, in units
    /// of their own.
    ///
    /// `None` where the ray has no direction, or something is not finite.
    #[cold]
    #[inline(never)]
    pub(in crate::shapes) fn new<T: Real>(
        radii: &[T; 2],
        ends: &[T; 2],
        ray: &impl ExactRay,
    ) -> Option<Self> {
        let lengths = [radii[0], radii[1], ends[0], ends[1]].map(T::f64);
        let line = Line::new(ray, greatest(&lengths), ROOM)?;
        let [bottom, top, z_min, z_max] = lengths.map(|x| line.length(x));
        Some(Self { line, radii: [bottom, top], ends: [z_min, z_max] })
    }

    /// Returns where the line intersects the side between both ends, in ascending order.
    pub(in crate::shapes) fn side(&self) -> Vec<Two> {
        let (o, d) = (self.line.origin, self.line.direction);
        let [bottom, top] = self.radii;
        let slope = Two::sum(top, -bottom) / Two::sum(self.ends[1], -self.ends[0]);
        let (rise, growth) = (slope * (o.z - Two::of(self.ends[0])), slope * d.z);
        let (radius, thick) = (Two::of(bottom) + rise, bottom.abs() + rise.f64().abs());
        let plane = |x: Two, y: Two| x * d.x + y * d.y;
        let (dd, oo) = (plane(d.x, d.y), o.x * o.x + o.y * o.y);
        let (gg, rr) = (growth * growth, radius * radius);
        let b = radius * growth - plane(o.x, o.y);
        // b² − a c, multiplied out: with each of its three roots come the magnitudes of its terms
        let (left, right) = (o.x * d.y, o.y * d.x);
        let across = (left - right, (left.abs() + right.abs()).f64());
        let along = |o_x: Two, d_x: Two| {
            let (p, q) = (radius * d_x, growth * o_x);
            (p - q, thick * d_x.f64().abs() + q.f64().abs())
        };
        let (x, y) = (along(o.x, d.x), along(o.y, d.y));
        let terms: f64 =
            [x, y, across].iter().map(|(root, terms)| 2.0 * root.f64().abs() * terms).sum();
        let disc = (x.0 * x.0 + y.0 * y.0 - across.0 * across.0).certain(terms);
        let a = (dd - gg).certain((dd + gg).f64());
        let c = (oo - rr).certain(oo.f64() + thick * thick);
        let of_b = thick * growth.f64().abs() + ((o.x * d.x).abs() + (o.y * d.y).abs()).f64();
        let middle = Middle { a, b, terms: [(dd + gg).f64(), of_b] };
        let roots = roots::ascending(a, b, c, disc).into_iter().flatten().enumerate();
        roots.filter(|(n, t)| self.is_between(&middle, *n, *t)).map(|(_, t)| t).collect()
    }

    /// Returns whether the root `t`, the first or the second one, is between both ends, which
    /// belong to the surface.
    fn is_between(&self, middle: &Middle, n: usize, t: Two) -> bool {
        let [above_lower, above_upper] = [0, 1].map(|end| {
            let (d_z, way) = (self.line.direction.z, self.way(end));
            match middle.is_after(n, way, d_z, self.beyond(end)) {
                Some(is_after) => Two::of(if is_after == (d_z > Two::ZERO) { 1.0 } else { -1.0 }),
                None => {
                    let (o_z, rise) = (self.line.origin.z.abs().f64(), t * d_z);
                    (rise - way).certain(o_z + self.ends[end].abs() + rise.f64().abs())
                }
            }
        });
        above_lower >= Two::ZERO && above_upper <= Two::ZERO
    }

    /// Returns the way from the origin to an end, along the axis.
    fn way(&self, end: usize) -> Two {
        Two::of(self.ends[end]) - self.line.origin.z
    }

    /// Returns the point of the side at the root nearest to `t`, in units of the scene; `None`
    /// where there is no root.
    #[cold]
    #[inline(never)]
    pub(in crate::shapes) fn on_side<T: Real>(&self, t: T) -> Option<Vec3<T>> {
        let distance = |root: &Two| (self.t::<T>(*root) - t).abs().f64();
        let root = self.side().into_iter().min_by(|p, q| distance(p).total_cmp(&distance(q)))?;
        let (o, d) = (self.line.origin, self.line.direction);
        let at = times((o + d * root).f64(), -self.line.lengths);
        Some(Vec3::new(T::of(at.x), T::of(at.y), T::of(at.z)))
    }

    /// Returns d_z² times how far beyond the rim of an end the line passes the plane of that end,
    /// as a difference of squares; 0 where it passes through the rim, or as near to it as rounding.
    fn beyond(&self, end: usize) -> Two {
        let (o, d, radius) = (self.line.origin, self.line.direction, Two::of(self.radii[end]));
        let way = self.way(end);
        let at = |o_x: Two, d_x: Two| {
            let (p, q) = (o_x * d.z, way * d_x);
            (p + q, (p.abs() + q.abs()).f64())
        };
        let (x, y, reach) = (at(o.x, d.x), at(o.y, d.y), radius * d.z);
        let beyond = x.0 * x.0 + y.0 * y.0 - reach * reach;
        let terms = 2.0 * (x.0.f64().abs() * x.1 + y.0.f64().abs() * y.1) + (reach * reach).f64();
        beyond.certain(terms)
    }

    /// Returns where the line intersects the disc at the lower end, 0, or the upper one, 1. The rim
    /// belongs to the disc.
    pub(in crate::shapes) fn cap(&self, end: usize) -> Option<Two> {
        let d_z = self.line.direction.z;
        let is_within = d_z != Two::ZERO && self.beyond(end) <= Two::ZERO;
        is_within.then(|| self.way(end) / d_z)
    }

    /// Returns the parameter along the ray as given.
    pub(in crate::shapes) fn t<T: Real>(&self, t: Two) -> T {
        self.line.t(t)
    }
}

/// The middle b / a between the roots of a t² − 2 b t + c, with the magnitudes of the terms of a
/// and b.
struct Middle {
    a: Two,
    b: Two,
    terms: [f64; 2],
}

impl Middle {
    /// Returns whether the root with that number comes after t = `way` / `d_z`, where d_z² times
    /// the polynomial is `there`; `None` where that is in doubt.
    ///
    /// The sign of the polynomial says whether this t is between the roots. If it is not, both
    /// roots are on the side of their middle. This holds where a line nearly runs along the side
    /// and a root loses all of its digits.
    fn is_after(&self, root: usize, way: Two, d_z: Two, there: Two) -> Option<bool> {
        let zero = Two::ZERO;
        if d_z == zero || self.a == zero || there == zero {
            return None;
        }
        if (there < zero) != (self.a < zero) {
            return Some(root == 1);
        }
        let to_middle = self.b * d_z - self.a * way;
        let terms = self.terms[1] * d_z.f64().abs() + self.terms[0] * way.f64().abs();
        let to_middle = to_middle.certain(terms);
        (to_middle != zero).then(|| ((to_middle > zero) == (d_z > zero)) == (self.a > zero))
    }
}
