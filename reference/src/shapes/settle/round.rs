//! Cylinder and cone in two words.

use super::line::{Line, greatest};
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::two::Two;
use crate::rays::ray::Ray;

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
        ray: &Ray<T>,
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
        let (rise, growth) = (slope * Two::sum(o.z, -self.ends[0]), slope * Two::of(d.z));
        let (radius, thick) = (Two::of(bottom) + rise, bottom.abs() + rise.f64().abs());
        let plane = |x: f64, y: f64| Two::product(x, d.x) + Two::product(y, d.y);
        let (dd, oo) = (plane(d.x, d.y), Two::product(o.x, o.x) + Two::product(o.y, o.y));
        let (gg, rr) = (growth * growth, radius * radius);
        let b = radius * growth - plane(o.x, o.y);
        // b² − a c, multiplied out: with each of its three roots come the magnitudes of its terms
        let (left, right) = (Two::product(o.x, d.y), Two::product(o.y, d.x));
        let across = (left - right, (left.abs() + right.abs()).f64());
        let along = |o_x: f64, d_x: f64| {
            let (p, q) = (radius * Two::of(d_x), growth * Two::of(o_x));
            (p - q, thick * d_x.abs() + q.f64().abs())
        };
        let (x, y) = (along(o.x, d.x), along(o.y, d.y));
        let terms: f64 =
            [x, y, across].iter().map(|(root, terms)| 2.0 * root.f64().abs() * terms).sum();
        let disc = (x.0 * x.0 + y.0 * y.0 - across.0 * across.0).certain(terms);
        let a = (dd - gg).certain((dd + gg).f64());
        let c = (oo - rr).certain(oo.f64() + thick * thick);
        let roots = roots::ascending(a, b, c, disc);
        roots.into_iter().flatten().filter(|t| self.is_between(*t)).collect()
    }

    /// Returns whether the line at `t` is between both ends, which belong to the surface.
    fn is_between(&self, t: Two) -> bool {
        let way = t * Two::of(self.line.direction.z);
        let above = |end: f64| {
            let height = Two::sum(self.line.origin.z, -end) + way;
            height.certain(self.line.origin.z.abs() + end.abs() + way.f64().abs())
        };
        above(self.ends[0]) >= Two::ZERO && above(self.ends[1]) <= Two::ZERO
    }

    /// Returns where the line intersects the disc at the lower end, 0, or the upper one, 1. The rim
    /// belongs to the disc.
    pub(in crate::shapes) fn cap(&self, end: usize) -> Option<Two> {
        let (o, d, radius) = (self.line.origin, self.line.direction, self.radii[end]);
        let way = Two::sum(self.ends[end], -o.z);
        let at = |o_x: f64, d_x: f64| {
            let (p, q) = (Two::product(o_x, d.z), way * Two::of(d_x));
            (p + q, (p.abs() + q.abs()).f64())
        };
        let (x, y, reach) = (at(o.x, d.x), at(o.y, d.y), Two::product(radius, d.z));
        let beyond = x.0 * x.0 + y.0 * y.0 - reach * reach;
        let terms = 2.0 * (x.0.f64().abs() * x.1 + y.0.f64().abs() * y.1) + (reach * reach).f64();
        let is_within = d.z != 0.0 && beyond.certain(terms) <= Two::ZERO;
        is_within.then(|| way / Two::of(d.z))
    }

    /// Returns the parameter along the ray as given.
    pub(in crate::shapes) fn t<T: Real>(&self, t: Two) -> T {
        self.line.t(t)
    }
}
