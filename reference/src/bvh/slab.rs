//! The space of a tree, and rays transformed into it.
//!
//! Boxes lie in single precision around the tree's centre, scaled by a power of two so that all of
//! them lie within −1 ≤ x ≤ 1. Neither the size of the primitives nor their distance from the
//! origin matters to the tests.
//!
//! **No box hides a hit.** Let u = 2⁻²⁴, half a unit in the last place of 1. A hit at r(t) lies
//! within the box of its primitive, except for what the test of the primitive itself loses: the
//! `pad` of a [`TreeRay`], by which every box grows. What remains is the error of the box test. The
//! ray's start is moved to where the ray enters the root. This is computed in f64, the pad
//! included, and along the direction as it is. From there the coordinates stay below 1.3, the
//! greatest component of the direction lies between 1 and 2, and so the whole way within the root
//! is τ < 2.6. A coordinate on the ray at τ is then off by
//!
//! - u for the start and u for the pad in it, rounded to f32;
//! - u/8 where a component of the direction below 2⁻³⁰ is replaced by 2⁻³⁰, so that nothing is
//!   divided by 0;
//! - 7.5u for the three roundings of (plane − start) · inverse, where planes are less than 2.5
//!   away;
//! - u for the plane itself, rounded to f32.
//!
//! This is less than 11u in all. Boxes grow by [`PAD`] = 32u, so that the τ of their entry is
//! computed at least 10u too small, more than the 4u that are lost in the limit's τ, and the τ of
//! their exit too great. (After Ize, Robust BVH ray traversal, 2013, with one bound for all boxes
//! instead of one per box.)

use std::ops::Range;

use crate::lanes::BoxRay;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;

/// The distance by which boxes grow: 32 roundings of 1.
pub(super) const PAD: f64 = 32.0 / 16_777_216.0;
/// If boxes would have to grow by more than this share of the tree, a ray enters all of them.
pub(super) const BLIND: f64 = 0.125;
/// The bound of 1/direction where the ray enters the tree: greater magnitudes are replaced by it,
/// so that nothing is infinite.
const FINITE: f64 = 1e300;
/// The bound of 1/direction within the tree: greater magnitudes are replaced by it.
const MOST: f64 = 1_073_741_824.0;
/// The range of the greatest component of a direction, by magnitude. Outside it a ray enters every
/// box; within it, everything computed from the direction is a number.
const SIZES: Range<f64> = 1e-290..1e290;
/// The bits that hold the exponent.
const EXPONENT: u64 = 0x7ff << 52;
/// The sum of the exponent bits of a power of two and of its inverse.
const ONES: u64 = 2046 << 52;

/// Three coordinates, and a fourth that fills the register.
type Four = [f64; 4];

/// The space of a tree, and the error of the tests of its primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    middle: Four,
    scale: f64,
    /// The greatest magnitude of a coordinate of the primitives.
    farthest: f64,
    /// The error of a primitive's test, in this space, per unit of the greatest coordinate
    /// involved.
    loss: f64,
}

impl Space {
    /// Returns the space of a tree over primitives with these bounds.
    pub(super) fn of<T: Real>(bounds: &[Bounds<T>]) -> Self {
        let all = bounds.iter().fold(Bounds::empty(), |all, one| all.join(*one));
        let (min, max) = (all.min.f64(), all.max.f64());
        let middle = min * 0.5 + max * 0.5;
        let half = (max - middle).max(middle - min).max_element();
        let scale = scaled(1.0, (-exponent(half) - 1).clamp(-1000, 1000));
        let farthest = all.min.abs().greatest(all.max.abs()).max_element().f64();
        Self {
            middle: [middle.x, middle.y, middle.z, 0.0],
            scale,
            farthest,
            loss: 256.0 * T::ULP.f64() * scale,
        }
    }

    /// Returns the space for primitives whose tests lose `loss` times as much as they would in
    /// world space.
    pub(super) fn with_loss(self, loss: f64) -> Self {
        Self { loss: self.loss * loss, ..self }
    }

    /// Returns a point in this space, and what the tests of primitives lose for rays from there,
    /// see [`TreeRay::new`].
    #[inline(always)]
    pub(super) fn point<T: Real>(&self, point: Vec3<T>) -> (Four, f64) {
        let point = four(point);
        let pad = more(greatest(point), self.farthest) * self.loss;
        (each(|axis| (point[axis] - self.middle[axis]) * self.scale), pad)
    }

    /// Returns the length of a unit in this space.
    #[inline(always)]
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns a box in this space, grown by [`PAD`]. An empty box, or one whose coordinates are
    /// not finite, becomes all of the space.
    #[inline]
    pub(super) fn place<T: Real>(&self, bounds: &Bounds<T>) -> ([f32; 3], [f32; 3]) {
        let [min, max] = [four(bounds.min), four(bounds.max)];
        let lo = [0, 1, 2].map(|axis| (min[axis] - self.middle[axis]) * self.scale - PAD);
        let hi = [0, 1, 2].map(|axis| (max[axis] - self.middle[axis]) * self.scale + PAD);
        if (0..3).all(|axis| -2.0 < lo[axis] && lo[axis] < hi[axis] && hi[axis] < 2.0) {
            (lo.map(|x| x as f32), hi.map(|x| x as f32))
        } else {
            ([-2.0; 3], [2.0; 3])
        }
    }
}

/// A ray in the space of a tree: a start within it and a direction, for τ ≥ 0. Only the first three
/// numbers of each array count.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TreeRay {
    /// For each axis, the number of the plane that the ray crosses first. The planes are numbered
    /// from 0: the least x, the greatest x, then those of y and z.
    pub(super) near: [usize; 3],
    /// The start, moved by the pad, and 1/direction.
    pub(super) lanes: BoxRay,
    /// τ = t · rate − base.
    rate: f64,
    base: f64,
}

impl TreeRay {
    /// Returns the ray in that space; `None` where it misses all of it.
    ///
    /// The test of a primitive loses up to 256 units in the last place of the greatest coordinate
    /// involved. Where that is much of the tree, or where numbers leave their range, the ray enters
    /// every box.
    #[inline(always)]
    pub(super) fn new<T: Real>(ray: &Ray<T>, space: &Space) -> Option<Self> {
        let (origin, direction) = (four(ray.origin), four(ray.direction));
        let inverse = each(|axis| 1.0 / direction[axis]);
        let size = greatest(direction);
        let unit = f64::from_bits(size.to_bits() & EXPONENT);
        let per_unit = f64::from_bits(ONES.wrapping_sub(unit.to_bits()));
        let rate = space.scale * unit;
        let pad = more(greatest(origin), space.farthest) * space.loss;
        if !(pad <= BLIND && SIZES.contains(&size) && rate.is_normal()) {
            return Some(Self::blind());
        }
        let origin = each(|axis| (origin[axis] - space.middle[axis]) * space.scale);
        let inverse =
            each(|axis| less((inverse[axis] * unit).abs(), FINITE).copysign(direction[axis]));
        let half = 2.0 * pad + (1.0 + 1.0 / 1024.0);
        let middle = each(|axis| -origin[axis] * inverse[axis]);
        let reach = each(|axis| half * inverse[axis].abs());
        let [near, far] =
            [each(|axis| middle[axis] - reach[axis]), each(|axis| middle[axis] + reach[axis])];
        let base = more(more(near[0], near[1]), more(near[2], ray.t_min.f64() * rate));
        if base > less(less(far[0], far[1]), far[2]) {
            return None;
        }
        let way = base * per_unit;
        let start = each(|axis| origin[axis] + direction[axis] * way);
        if !start[..3].iter().all(|x| x.abs() < 1.5) {
            return Some(Self::blind());
        }
        let side = each(|axis| pad.copysign(direction[axis]));
        let near_of = |axis: usize| 2 * axis + usize::from(direction[axis].is_sign_negative());
        Some(Self {
            near: [near_of(0), near_of(1), near_of(2)],
            lanes: BoxRay {
                from_near: single(each(|axis| start[axis] + side[axis])),
                from_far: single(each(|axis| start[axis] - side[axis])),
                inverse: single(each(|axis| {
                    less(inverse[axis].abs(), MOST).copysign(inverse[axis])
                })),
            },
            rate,
            base,
        })
    }

    /// Returns a ray that enters every box.
    #[cold]
    fn blind() -> Self {
        Self {
            near: [0, 2, 4],
            lanes: BoxRay { from_near: [8.0; 4], from_far: [-8.0; 4], inverse: [1.0; 4] },
            rate: 0.0,
            base: -64.0,
        }
    }

    /// Returns the τ of a limit of t.
    #[inline(always)]
    pub(super) fn reach<T: Real>(&self, limit: T) -> f32 {
        (limit.f64() * self.rate - self.base).min(1e30) as f32
    }
}

#[inline(always)]
fn four<T: Real>(v: Vec3<T>) -> Four {
    [v.x.f64(), v.y.f64(), v.z.f64(), 0.0]
}

#[inline(always)]
fn each(f: impl Fn(usize) -> f64) -> Four {
    [f(0), f(1), f(2), f(3)]
}

#[inline(always)]
fn single(v: Four) -> [f32; 4] {
    [v[0] as f32, v[1] as f32, v[2] as f32, v[3] as f32]
}

/// Returns the greatest magnitude of the first three numbers.
#[inline(always)]
fn greatest(v: Four) -> f64 {
    more(more(v[0].abs(), v[1].abs()), v[2].abs())
}

/// Returns the greater of both; if one is NaN, the second.
#[inline(always)]
fn more(p: f64, q: f64) -> f64 {
    if p > q { p } else { q }
}

/// Returns the lesser of both; if one is NaN, the second.
#[inline(always)]
fn less(p: f64, q: f64) -> f64 {
    if p < q { p } else { q }
}
