//! Whether the rounding of a moved ray can change a decision, shape by shape.
//!
//! A rounded origin is off by at most `way.blur(o)` along the axes, a rounded direction by
//! `way.blur(d)`: at least 3 `ULP` of their components, so that what the formulas themselves round
//! is less than the bounds have to spare. A comparison with NaN is false, which counts as a doubt.

use super::{Cuboid, Plane, Round, Sphere, Square};
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::vec3::Vec3;
use crate::rays::moved::MovedRay;

/// The error of a point of object space, in units of `ULP` of the size of the shape, beyond which a
/// hit point is computed in two words.
const FAR: f64 = 2048.0;

impl<T: Real> Sphere<T> {
    /// Returns whether the rounded ray is decided as the exact one.
    ///
    /// With k = ‖G‖, f from the centre C to the origin is off by k (‖f‖ + ‖C‖), so c = ‖f‖² − r² by
    /// 3 k (‖f‖² + ‖C‖²), and the point nearest to the centre by k (2‖f‖ + ‖C‖) across the ray, so
    /// (d·d) c − b² by 8 k (d·d) (‖f‖² + r² + ‖C‖²). A ray that starts outside and goes away from
    /// the centre misses: a doubt of the sign of b makes b² too small for a root.
    #[inline(always)]
    pub(super) fn is_clear(&self, moved: &MovedRay<'_, T>) -> bool {
        let (ray, d) = (&moved.ray, moved.ray.direction);
        let f = ray.origin - self.center;
        let (a, b) = (d.dot(d), -f.dot(d));
        let (ff, rr) = (f.dot(f), self.radius * self.radius);
        let (c, size) = (ff - rr, ff + rr);
        let blur = (size + self.center.dot(self.center)) * moved.way.norm();
        let (c_blur, m_blur) = (blur * T::of(4.0), a * blur * T::of(12.0));
        let (m, leaves) = (a * c - b * b, b < T::ZERO);
        let is_left = leaves & (c > c_blur) & ray.is_before(T::ZERO);
        let has_digits = (c.abs() > c_blur * T::MOVED_MARGIN) | (!leaves & (c < -c_blur));
        let is_hit = (m < -m_blur * T::MOVED_MARGIN) & has_digits;
        a.is_safe() & size.is_safe() & (is_left | (m > m_blur) | is_hit)
    }

    /// Returns whether the rounded ray is decided as the exact one, by a bound of c that follows
    /// the axes. It decides most rays that start on the sphere, to either side.
    pub(super) fn is_clear_by_axes(&self, moved: &MovedRay<'_, T>) -> bool {
        let (ray, d) = (&moved.ray, moved.ray.direction);
        let f = ray.origin - self.center;
        let (a, b, ff, rr) = (d.dot(d), -f.dot(d), f.dot(f), self.radius * self.radius);
        let (c, size, blur) = (ff - rr, ff + rr, moved.way.norm());
        let lengths = a * (size + self.center.dot(self.center));
        let off = moved.way.blur(ray.origin);
        let of_origin = (f.abs() * T::of(2.2) + off * T::of(1.2)).dot(off);
        let c_blur = of_origin + size * (T::of(3.0) * T::ULP);
        let is_steep = b * b > lengths * (blur * blur * T::of(16.0));
        let is_left = (b < T::ZERO) & (c > c_blur) & is_steep & ray.is_before(T::ZERO);
        let is_deep = b * b - a * c > lengths * blur * T::of(12.0) * T::MOVED_MARGIN;
        let is_inside = (b > T::ZERO) & (c < -c_blur) & is_deep;
        a.is_safe() & size.is_safe() & (b * b).is_safe() & (is_left | is_inside)
    }

    /// Returns whether the point of a hit along the ray has too few digits.
    #[inline(always)]
    pub(super) fn is_far(&self, moved: &MovedRay<'_, T>) -> bool {
        let f = moved.ray.origin - self.center;
        let (ff, rr) = (f.dot(f), self.radius * self.radius);
        !(ff.is_safe() && rr.is_safe() && ff < rr * reach(moved))
    }
}

/// Returns the square of the distance, in units of the size of a shape, beyond which a point along
/// the rounded ray has too few digits. It is at most that of an exact ray.
#[inline(always)]
fn reach<T: Real>(moved: &MovedRay<'_, T>) -> T {
    let blur = moved.way.norm() * (T::ONE / (T::of(FAR) * T::ULP));
    (T::ONE / (blur * blur)).least(T::of(4096.0))
}

impl<T: Real> Plane<T> {
    /// Returns whether the rounded ray is decided as the exact one.
    #[inline(always)]
    pub(super) fn is_clear(&self, k: T, moved: &MovedRay<'_, T>) -> bool {
        let (o, d, n) = (moved.ray.origin, moved.ray.direction, self.normal.abs());
        let (slope, height) = (self.normal.dot(d), k - self.normal.dot(o));
        let slope_blur = n.dot(moved.way.blur(d)) * T::of(1.75);
        let height_blur = n.dot(moved.way.blur(o)) * T::of(1.75) + k.abs() * (T::TWO * T::ULP);
        let exceeds =
            |share: T| (slope.abs() > slope_blur * share) & (height.abs() > height_blur * share);
        let leaves = (slope < T::ZERO) != (height < T::ZERO) && moved.ray.is_before(T::ZERO);
        slope_blur.is_safe() && (exceeds(T::MOVED_MARGIN) || (leaves && exceeds(T::ONE)))
    }
}

impl Square {
    /// Returns whether the rounded ray is decided as the exact one. `half` is half of a side.
    #[inline(always)]
    pub(super) fn is_clear<T: Real>(self, half: T, moved: &MovedRay<'_, T>) -> bool {
        let (o, d) = (moved.ray.origin, moved.ray.direction);
        let (o_blur, d_blur) = (moved.way.blur(o), moved.way.blur(d));
        if d.z == T::ZERO && d_blur.z == T::ZERO {
            return true;
        }
        let t = -o.z / d.z;
        let is_apart = o.z.abs() > o_blur.z * T::TWO;
        if !(d.z.abs() > d_blur.z * T::MOVED_MARGIN && t.is_finite()) {
            return false;
        }
        if is_apart && t < T::ZERO && moved.ray.is_before(T::ZERO) {
            return true;
        }
        let t_blur = (o_blur.z + t.abs() * d_blur.z) / d.z.abs();
        let beyond = |o: T, d: T, o_blur: T, d_blur: T| {
            let blur = (o_blur + t.abs() * d_blur + d.abs() * t_blur) * T::of(2.5);
            ((o + d * t).abs() - half, blur)
        };
        let (x, x_blur) = beyond(o.x, d.x, o_blur.x, d_blur.x);
        let (y, y_blur) = beyond(o.y, d.y, o_blur.y, d_blur.y);
        let is_inside = (x < -x_blur) & (y < -y_blur);
        x > x_blur || y > y_blur || (is_inside && is_apart)
    }
}

impl<T: Real> Cuboid<T> {
    /// Returns whether the line of the exact ray certainly misses the box. Most lines do.
    ///
    /// With c from the middle of the box to the origin and h half of its size, a line misses if and
    /// only if a component of |c × d| exceeds what h leaves to it. No error is greater than
    /// `o_blur` for c and h, and `d_blur` for d.
    #[inline(always)]
    pub(super) fn is_missed(&self, moved: &MovedRay<'_, T>) -> bool {
        let (o, d) = (moved.ray.origin, moved.ray.direction);
        let length = |v: Vec3<T>| v.x.abs() + v.y.abs() + v.z.abs();
        let (c, h) = (o - (self.min + self.max) * T::HALF, (self.max - self.min) * T::HALF);
        let corners = (length(self.min) + length(self.max)) * (T::of(4.0) * T::ULP);
        let (o_blur, d_blur) =
            (moved.way.norm() * length(o) + corners, moved.way.norm() * length(d));
        let blur = (o_blur * length(d) + d_blur * (length(c) + length(h))) * T::of(3.0);
        let (across, along) = (c.cross(d), d.abs());
        let passes = |n: usize, y: usize, z: usize| {
            across[n].abs() - (h[y] * along[z] + h[z] * along[y]) > blur
        };
        passes(0, 1, 2) | passes(1, 2, 0) | passes(2, 0, 1)
    }

    /// Returns whether the rounded ray is decided as the exact one.
    ///
    /// t of a face is off by the errors of origin and direction over the component of the
    /// direction. Which face is the last to be entered, which the first to be left, and which of
    /// both comes first is certain where the parameters differ by more than that.
    #[inline(always)]
    pub(super) fn is_clear(&self, moved: &MovedRay<'_, T>) -> bool {
        let (o, d) = (moved.ray.origin, moved.ray.direction);
        let (o_blur, d_blur) = (moved.way.blur(o) * T::TWO, moved.way.blur(d) * T::TWO);
        let (mut enter, mut leave) = (Span::at(-T::INFINITY), Span::at(T::INFINITY));
        let mut is_certain = true;
        for axis in 0..3 {
            let (to_min, to_max) = (self.min[axis] - o[axis], self.max[axis] - o[axis]);
            let (o_blur, d_blur, along) = (o_blur[axis], d_blur[axis], d[axis]);
            let leaves =
                (to_min > o_blur) & (along <= -d_blur) | (to_max < -o_blur) & (along >= d_blur);
            if leaves && moved.ray.is_before(T::ZERO) {
                return true;
            }
            if along == T::ZERO && d_blur == T::ZERO {
                if to_min > o_blur || to_max < -o_blur {
                    return true;
                }
                is_certain &= to_min < -o_blur && to_max > o_blur;
                continue;
            }
            is_certain &= along.abs() > d_blur * T::MOVED_MARGIN;
            let span = |way: T| {
                let t = way / along;
                Span { t, blur: (o_blur + t.abs() * d_blur) / along.abs() }
            };
            let (lower, upper) = (span(to_min), span(to_max));
            let (first, last) = if along > T::ZERO { (lower, upper) } else { (upper, lower) };
            is_certain &= first.is_apart(enter) & last.is_apart(leave);
            enter = if first.t > enter.t { first } else { enter };
            leave = if last.t < leave.t { last } else { leave };
        }
        let is_sided = enter.is_apart(Span::at(T::ZERO)) & leave.is_apart(Span::at(T::ZERO));
        is_certain && enter.is_apart(leave) && (is_sided || enter.t > leave.t)
    }
}

/// A parameter of a ray, and how far it may be off.
#[derive(Clone, Copy)]
struct Span<T> {
    t: T,
    blur: T,
}

impl<T: Real> Span<T> {
    fn at(t: T) -> Self {
        Self { t, blur: T::ZERO }
    }

    fn is_apart(self, other: Self) -> bool {
        (self.t - other.t).abs() > self.blur + other.blur
    }
}

impl<T: Real> Round<T> {
    /// Returns whether the point of a hit on the side, along the ray, has too few digits.
    #[inline(always)]
    pub(super) fn is_blurred(&self, moved: &MovedRay<'_, T>, t: T) -> bool {
        let (o, at) = (moved.ray.origin, moved.ray.at(t));
        let rr = at.x * at.x + at.y * at.y;
        let is_near = o.dot(o) < rr * reach(moved); // false for NaN
        self.is_far(&moved.ray, t) || !is_near
    }

    /// Returns whether the rounded ray is decided as the exact one.
    ///
    /// Let O = (x, y, r) at the origin and D = (d_x, d_y, growth of r). The coefficients a, b and c
    /// are products of the two in the form x² + y² − r², so each is off by twice the errors of its
    /// factors times their lengths; the discriminant, of degree 2 in both, by four times that.
    #[inline(always)]
    pub(super) fn is_clear(&self, moved: &MovedRay<'_, T>) -> bool {
        let (o, d, slope) = (moved.ray.origin, moved.ray.direction, self.slope());
        let (o_blur, d_blur) = (moved.way.blur(o), moved.way.blur(d));
        let (growth, rise) = (slope * d.z, slope * (o.z - self.z_min));
        let radius = self.bottom_radius + rise;
        let length = |v: Vec3<T>| v.x.abs() + v.y.abs() + v.z.abs();
        let across = |v: Vec3<T>, z: T| Vec3::new(v.x, v.y, z);
        let (long_o, long_d) =
            (length(across(o, self.bottom_radius.abs() + rise.abs())), length(across(d, growth)));
        let r_blur = slope.abs() * (o_blur.z + self.z_min.abs() * T::ULP)
            + (self.bottom_radius.abs() + rise.abs()) * (T::of(4.0) * T::ULP);
        let off_o = across(o_blur, r_blur);
        let off_d = across(d_blur, slope.abs() * d_blur.z + growth.abs() * (T::of(4.0) * T::ULP));
        let (a, c) =
            (d.x * d.x + d.y * d.y - growth * growth, o.x * o.x + o.y * o.y - radius * radius);
        let b = radius * growth - (o.x * d.x + o.y * d.y);
        let disc = self.discriminant(&moved.ray, radius, growth);
        let a_blur = length(off_d) * long_d * T::of(3.0);
        let b_blur = (length(off_o) * long_d + length(off_d) * long_o) * T::TWO;
        let c_blur = across(o, radius).abs().dot(off_o) * T::of(3.0);
        let disc_blur = b_blur * (long_o * long_d) * T::of(4.0);
        if !(disc_blur.is_safe() && self.are_ends_clear(moved, o_blur, d_blur)) {
            return false;
        }
        let leaves = a > a_blur && b < -b_blur && c > c_blur && moved.ray.is_before(T::ZERO);
        if disc < -disc_blur || leaves {
            return true;
        }
        let digits = T::MOVED_MARGIN;
        if !(disc > disc_blur * digits && a.abs() > a_blur * digits && c.abs() > c_blur) {
            return false;
        }
        let Some(ts) = roots::ascending(a, b, c, disc) else { return false };
        let root = (ts[1] - ts[0]) * a.abs() * T::HALF;
        ts.into_iter().all(|t| {
            let t_blur = (b_blur + disc_blur / root + t.abs() * a_blur) / a.abs();
            let z_blur = (o_blur.z + t.abs() * d_blur.z + d.z.abs() * t_blur) * T::TWO;
            let z = o.z + t * d.z;
            let is_clear = |end: T| (z - end).abs() > z_blur;
            let is_off = z + z_blur < self.z_min || z - z_blur > self.z_max;
            is_off || (is_clear(self.z_min) && is_clear(self.z_max) && t.abs() > t_blur)
        })
    }

    /// Returns whether no rounding changes which discs the ray hits.
    #[inline(always)]
    fn are_ends_clear(&self, moved: &MovedRay<'_, T>, o_blur: Vec3<T>, d_blur: Vec3<T>) -> bool {
        let (o, d) = (moved.ray.origin, moved.ray.direction);
        if !self.is_capped || (d.z == T::ZERO && d_blur.z == T::ZERO) {
            return true;
        }
        let is_steep = d.z.abs() > d_blur.z * T::MOVED_MARGIN; // false for NaN
        if !is_steep {
            return false;
        }
        [(self.z_min, self.bottom_radius), (self.z_max, self.top_radius)].iter().all(|(z, r)| {
            let way = *z - o.z;
            let t = way / d.z;
            let is_apart = way.abs() > o_blur.z * T::TWO;
            if is_apart && t < T::ZERO && moved.ray.is_before(T::ZERO) {
                return true;
            }
            let t_blur = (o_blur.z + t.abs() * d_blur.z) / d.z.abs() * T::TWO;
            let at = |axis: usize| {
                let blur = o_blur[axis] + t.abs() * d_blur[axis] + d[axis].abs() * t_blur;
                (o[axis] + d[axis] * t, blur * T::TWO)
            };
            let ((x, x_blur), (y, y_blur)) = (at(0), at(1));
            let beyond = x * x + y * y - *r * *r;
            let blur = (x.abs() + x_blur) * x_blur + (y.abs() + y_blur) * y_blur;
            let blur = blur * T::of(3.0) + *r * *r * (T::of(4.0) * T::ULP);
            beyond > blur || (beyond < -blur && is_apart)
        })
    }
}
