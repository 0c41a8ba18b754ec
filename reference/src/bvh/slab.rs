//! A tree's own space, and a ray brought into it.
//!
//! Boxes lie in single precision around the tree's middle, scaled by a power of two so that all of them lie within −1 ≤ x ≤ 1: neither the size of
//! the things nor how far from the origin they lie matters to the tests.
//!
//! **No box hides a hit.** With u = 2⁻²⁴, half a last place of 1, a hit lies at r(t) within its thing's box, but for what the test of the thing itself
//! loses: the `pad` of a [`Slab`], by which every box grows. What is left is what the test of the box loses. The ray is moved to where it enters the
//! root, by f64, to which the pad belongs too; from there its coordinates stay below 1.3, its direction's greatest component lies between 1 and 2, and so
//! all of its way within the root is τ < 2.6. Then a coordinate on the ray at τ is off by
//! - u for its start and u for the pad in it, rounded to f32;
//! - 2.6u for its direction, rounded to f32, and u/8 where a component below 2⁻³⁰ is taken for that, so that nothing is divided by 0;
//! - 7.5u for the three roundings of (plane − start) · inverse, where planes are less than 2.5 away;
//! - u for the plane itself, rounded to f32:
//!
//! less than 14u in all. Boxes grow by [`PAD`] = 32u, so that τ of their entry comes out at least 9u too small, more than the 4u that are lost in the
//! limit's τ, and that of their exit too great. (After Ize, Robust BVH ray traversal, 2013, with one bound for all boxes instead of one a box.)

use glam::DVec3;

use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
use crate::two::{exponent, scaled};
use crate::vec3::Vec3;

/// By how much boxes grow: 32 roundings of 1.
pub(super) const PAD: f64 = 32.0 / 16_777_216.0;
/// Boxes that would have to grow by more than this share of the tree are all entered.
const BLIND: f64 = 0.125;
/// Less than this of a direction is taken for this.
const LEAST: f64 = 1.0 / 1_073_741_824.0;

/// Where a tree lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space<T> {
    middle: DVec3,
    scale: f64,
    all: Bounds<T>,
}

impl<T: Real> Space<T> {
    /// The space of a tree over these things.
    pub(super) fn of(bounds: &[Bounds<T>]) -> Self {
        let all = bounds.iter().fold(Bounds::empty(), |all, one| all.join(*one));
        let (min, max) = (all.min.f64(), all.max.f64());
        let middle = min * 0.5 + max * 0.5;
        let half = (max - middle).max(middle - min).max_element();
        let scale = scaled(1.0, (-exponent(half) - 1).clamp(-1000, 1000));
        Self { middle, scale, all }
    }

    /// A box within it, grown by [`PAD`]; all of the space where the box has no numbers.
    #[inline]
    pub(super) fn place(&self, bounds: &Bounds<T>) -> ([f32; 3], [f32; 3]) {
        let lo = ((bounds.min.f64() - self.middle) * self.scale - PAD).to_array();
        let hi = ((bounds.max.f64() - self.middle) * self.scale + PAD).to_array();
        if (0..3).all(|axis| -2.0 < lo[axis] && lo[axis] < hi[axis] && hi[axis] < 2.0) {
            (lo.map(|x| x as f32), hi.map(|x| x as f32))
        } else {
            ([-2.0; 3], [2.0; 3])
        }
    }
}

/// A ray in a tree's space: a start within it and a direction, for τ ≥ 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    /// For each axis the number of the plane that is met first, that of x from below being 0, from above 1, then y and z.
    pub(super) near: [usize; 3],
    /// The start, moved by the pad away from the plane that is met first.
    pub(super) from_near: [f32; 3],
    /// The same for the plane that is met last.
    pub(super) from_far: [f32; 3],
    /// 1/direction, finite.
    pub(super) inverse: [f32; 3],
    /// τ = t · rate − base.
    rate: f64,
    base: f64,
}

impl Slab {
    /// For a tree over things whose tests lose up to `loss` times what they lose in world space; `None` where the ray misses all of it.
    ///
    /// A test loses up to 256 last places of the greatest coordinate in play. Where that is much of the tree, or where numbers leave their range, the
    /// ray enters every box.
    #[inline(always)]
    pub(super) fn new<T: Real>(ray: &Ray<T>, space: &Space<T>, loss: T) -> Option<Self> {
        let coordinates = ray.origin.abs().greatest(space.all.min.abs().greatest(space.all.max.abs()));
        let pad = coordinates.max_element().f64() * (loss.f64() * 256.0 * T::ULP.f64()) * space.scale;
        let origin = three(ray.origin);
        let origin = [0, 1, 2].map(|axis| (origin[axis] - space.middle[axis]) * space.scale);
        let size = ray.direction.abs().max_element().f64();
        let to_one = f64::from_bits((2046_u64 << 52).wrapping_sub(size.to_bits() & (0x7ff << 52)));
        let rate = space.scale / to_one;
        let direction = three(ray.direction).map(|d| d * to_one);
        let direction = direction.map(|d| if d.abs() < LEAST { LEAST.copysign(d) } else { d });
        let is_sound = pad <= BLIND && (1.0..2.0).contains(&(size * to_one)) && rate.is_normal();
        if !is_sound {
            return Some(Self::blind());
        }
        let half = 1.0 + 2.0 * pad + 1.0 / 1024.0;
        let (mut base, mut leave) = (ray.t_min.f64() * rate, f64::INFINITY);
        for axis in 0..3 {
            let inverse = 1.0 / direction[axis];
            let side = half.copysign(inverse);
            let (near, far) = ((-side - origin[axis]) * inverse, (side - origin[axis]) * inverse);
            base = if near > base { near } else { base };
            leave = if far < leave { far } else { leave };
        }
        if base > leave {
            return None;
        }
        let start = [0, 1, 2].map(|axis| origin[axis] + direction[axis] * base);
        if !start.iter().all(|x| x.abs() < 1.5) {
            return Some(Self::blind());
        }
        let side = |axis: usize| pad.copysign(direction[axis]);
        Some(Self {
            near: [0, 1, 2].map(|axis| 2 * axis + usize::from(direction[axis] < 0.0)),
            from_near: [0, 1, 2].map(|axis| (start[axis] + side(axis)) as f32),
            from_far: [0, 1, 2].map(|axis| (start[axis] - side(axis)) as f32),
            inverse: direction.map(|d| 1.0 / d as f32),
            rate,
            base,
        })
    }

    /// Enters every box.
    #[cold]
    fn blind() -> Self {
        Self { near: [0, 2, 4], from_near: [8.0; 3], from_far: [-8.0; 3], inverse: [1.0; 3], rate: 0.0, base: -64.0 }
    }

    /// The τ of a limit of t.
    #[inline(always)]
    pub(super) fn reach<T: Real>(&self, limit: T) -> f32 {
        (limit.f64() * self.rate - self.base).min(1e30) as f32
    }
}

#[inline(always)]
fn three<T: Real>(v: Vec3<T>) -> [f64; 3] {
    [v.x.f64(), v.y.f64(), v.z.f64()]
}
