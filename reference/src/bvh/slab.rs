//! A tree's own space, and a ray brought into it.
//!
//! Boxes lie in single precision around the tree's middle, scaled by a power of two so that all of
//! them lie within −1 ≤ x ≤ 1: neither the size of the things nor how far from the origin they lie
//! matters to the tests.
//!
//! **No box hides a hit.** With u = 2⁻²⁴, half a last place of 1, a hit lies at r(t) within its
//! thing's box, but for what the test of the thing itself loses: the `pad` of a [`Slab`], by which
//! every box grows. What is left is what the test of the box loses. The ray is moved to where it
//! enters the root, by f64, to which the pad belongs too, and by its direction as it is; from there
//! its coordinates stay below 1.3, its direction's greatest component lies between 1 and 2, and so
//! all of its way within the root is τ < 2.6. Then a coordinate on the ray at τ is off by
//! - u for its start and u for the pad in it, rounded to f32;
//! - u/8 where a component of its direction below 2⁻³⁰ is taken for that, so that nothing is
//!   divided by 0;
//! - 7.5u for the three roundings of (plane − start) · inverse, where planes are less than 2.5
//!   away;
//! - u for the plane itself, rounded to f32:
//!
//! less than 11u in all. Boxes grow by [`PAD`] = 32u, so that τ of their entry comes out at least
//! 10u too small, more than the 4u that are lost in the limit's τ, and that of their exit too
//! great. (After Ize, Robust BVH ray traversal, 2013, with one bound for all boxes instead of one a
//! box.)

use std::ops::Range;

use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::{Real, exponent, scaled};
use crate::vec3::Vec3;

/// By how much boxes grow: 32 roundings of 1.
pub(super) const PAD: f64 = 32.0 / 16_777_216.0;
/// Boxes that would have to grow by more than this share of the tree are all entered.
pub(super) const BLIND: f64 = 0.125;
/// More than this of 1/direction is taken for this where the ray enters the tree, so that nothing
/// is infinite.
const FINITE: f64 = 1e300;
/// More than this of 1/direction is taken for this within the tree.
const MOST: f64 = 1_073_741_824.0;
/// Rays whose direction is shorter or longer enter every box: with others all that is worked out of
/// it is a number.
const SIZES: Range<f64> = 1e-290..1e290;
/// The bits that hold the exponent.
const EXPONENT: u64 = 0x7ff << 52;
/// Those of a power of two and of its inverse, added.
const ONES: u64 = 2046 << 52;

/// Three coordinates, and one more that makes them a register.
type Four = [f64; 4];

/// Where a tree lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    middle: Four,
    scale: f64,
    /// The greatest coordinate of its things.
    farthest: f64,
    /// What the test of a thing loses, in this space, for every unit of the greatest coordinate in
    /// play.
    loss: f64,
}

impl Space {
    /// The space of a tree over these things.
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

    /// The same over things whose tests lose `loss` times as much, as they would in world space.
    pub(super) fn with_loss(self, loss: f64) -> Self {
        Self { loss: self.loss * loss, ..self }
    }

    /// A point within it, and what the tests of things that are asked from there lose, see
    /// [`Slab::new`].
    #[inline(always)]
    pub(super) fn point<T: Real>(&self, point: Vec3<T>) -> (Four, f64) {
        let point = four(point);
        let pad = more(greatest(point), self.farthest) * self.loss;
        (each(|axis| (point[axis] - self.middle[axis]) * self.scale), pad)
    }

    /// How long a unit is within it.
    #[inline(always)]
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A box within it, grown by [`PAD`]; all of the space where the box has no numbers.
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

/// A ray in a tree's space: a start within it and a direction, for τ ≥ 0. Only the first three
/// numbers of each count.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    /// For each axis the number of the plane that is met first, that of x from below being 0, from
    /// above 1, then y and z.
    pub(super) near: [usize; 3],
    /// The start, moved by the pad away from the plane that is met first.
    pub(super) from_near: [f32; 4],
    /// The same for the plane that is met last.
    pub(super) from_far: [f32; 4],
    /// 1/direction, finite.
    pub(super) inverse: [f32; 4],
    /// τ = t · rate − base.
    rate: f64,
    base: f64,
}

impl Slab {
    /// The ray in that space; `None` where it misses all of it.
    ///
    /// A test loses up to 256 last places of the greatest coordinate in play. Where that is much of
    /// the tree, or where numbers leave their range, the ray enters every box.
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
            from_near: single(each(|axis| start[axis] + side[axis])),
            from_far: single(each(|axis| start[axis] - side[axis])),
            inverse: single(each(|axis| less(inverse[axis].abs(), MOST).copysign(inverse[axis]))),
            rate,
            base,
        })
    }

    /// Enters every box.
    #[cold]
    fn blind() -> Self {
        Self {
            near: [0, 2, 4],
            from_near: [8.0; 4],
            from_far: [-8.0; 4],
            inverse: [1.0; 4],
            rate: 0.0,
            base: -64.0,
        }
    }

    /// The τ of a limit of t.
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

/// The greatest of the first three, whatever their signs.
#[inline(always)]
fn greatest(v: Four) -> f64 {
    more(more(v[0].abs(), v[1].abs()), v[2].abs())
}

/// The greater; where one is NaN, the second.
#[inline(always)]
fn more(p: f64, q: f64) -> f64 {
    if p > q { p } else { q }
}

/// The lesser; where one is NaN, the second.
#[inline(always)]
fn less(p: f64, q: f64) -> f64 {
    if p < q { p } else { q }
}
