//! Packets of rays in the space of a tree: a box is tested against the pyramid that contains all
//! rays of a packet.
//!
//! **No box hides a hit.** Let z be the axis that the rays run along, x an axis across it, and o
//! the origin. A ray with slope s passes through the points x − o.x = s (z − o.z). Ahead of the
//! origin, therefore, x − S z ≤ o.x − S o.z with the greatest slope S of all rays. The least slope
//! gives a bound from below in the same way, and both bounds are reversed where the rays go down
//! their axis. A box all of which breaks one of these bounds is missed by every ray.
//!
//! The right side is computed in f64, for the very S that is used: the greatest slope rounded to
//! f32 and then moved up by one place more, so that no slope is beyond it. Within a box, x − S z is
//! least where x is least and S z is greatest. With u = 2⁻²⁴ it is off by u for S z, 2u for the
//! difference and 2u for the planes themselves. A bound whose magnitude is less than 4 is off by 2u
//! for being rounded to f32, and a greater one decides nothing narrowly, as no box reaches so far.
//! This is 7u in all, which the 32u by which boxes grow in `slab` more than cover. Depths are off
//! by less.
//!
//! The error of a primitive's test, the pad of `slab`, counts once for x and |S| ≤ 1 times for z. A
//! third pad is left for what f64 loses here: 256 units in the last place are many.

use std::ops::Range;

use super::node::{Child, OpenChildren};
use super::slab::{BLIND, Space};
use super::{Bvh, VisitCounter};
use crate::lanes::{Eight, LaneTask, LaneTests};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;

/// The pyramid of a packet: rays from one point that all run the same way along one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pyramid<'a, T, const N: usize> {
    /// The point that all rays leave.
    pub origin: Vec3<T>,
    /// Two axes across the rays, and the axis that they run along.
    pub axes: [usize; 3],
    /// For both axes across, how far each ray goes along it per step along the third axis; NaN
    /// beyond the last ray.
    pub slopes: &'a [[f32; N]; 2],
    /// 1 where the rays go up the third axis, −1 where they go down.
    pub sign: f64,
}

/// A visitor of primitives for a packet.
pub(crate) trait VisitPacket<Y> {
    /// Visits the primitives of a leaf. Returns the depth before which a hit can still count, ∞ at
    /// first.
    fn visit<P: LaneTests>(&mut self, tally: &mut Y, primitives: Range<u32>) -> f64;

    /// Prefetches the data of these primitives: they may be visited soon.
    fn fetch<P: LaneTests>(&self, primitives: Range<u32>);
}

impl Bvh {
    /// Calls `visitor` for every leaf whose box the pyramid enters before the limit, nearer boxes
    /// first. Returns false, and visits nothing, where rounding may lose much of the tree.
    #[inline]
    pub(crate) fn walk_packet<T: Real, Y: VisitCounter, const N: usize>(
        &self,
        pyramid: &Pyramid<'_, T, N>,
        tally: &mut Y,
        visitor: impl VisitPacket<Y>,
    ) -> bool {
        let Some(frustum) = Frustum::new(pyramid, &self.space) else { return false };
        if !self.nodes.is_empty() {
            self.lanes.run(Walk { tree: self, frustum, tally, visitor });
        }
        true
    }
}

struct Walk<'a, Y, V> {
    tree: &'a Bvh,
    frustum: Frustum,
    tally: &'a mut Y,
    visitor: V,
}

impl<Y: VisitCounter, V: VisitPacket<Y>> LaneTask for Walk<'_, Y, V> {
    #[inline(always)]
    fn run<P: LaneTests>(self) {
        let Self { tree, frustum, tally, mut visitor } = self;
        let mut reach = frustum.reach(f64::INFINITY);
        let mut open = OpenChildren::new();
        let mut at = Child::ROOT;
        loop {
            let nearest = match at.primitives() {
                None => {
                    tally.node();
                    let node = &tree.nodes[at.node()];
                    let (enter, entered) = frustum.boxes(node.planes(), reach);
                    for child in node.children(entered) {
                        match child.primitives() {
                            None => P::fetch(&tree.nodes[child.node()]),
                            Some(primitives) => visitor.fetch::<P>(primitives),
                        }
                    }
                    node.open(enter, entered, &mut open)
                }
                Some(primitives) => {
                    reach = frustum.reach(visitor.visit::<P>(tally, primitives));
                    None
                }
            };
            match nearest.or_else(|| open.nearest(reach)) {
                Some(child) => at = child,
                None => return,
            }
        }
    }
}

/// One of the four sides of the pyramid.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// The planes of a box of which x and z are tested.
    planes: [usize; 2],
    slope: f32,
    bound: f32,
}

/// The pyramid of a packet in the space of a tree.
#[derive(Clone, Copy, Debug)]
struct Frustum {
    /// The sides beyond which x − slope · z is greater than the bound.
    upper: [Side; 2],
    /// The sides beyond which x − slope · z is less than the bound.
    lower: [Side; 2],
    /// The plane of a box that the rays cross first along their axis.
    near: usize,
    /// 1 or −1: the factor that makes a coordinate along the axis grow along the rays.
    sign: f32,
    /// The coordinate of the origin along the axis, times `sign`.
    start: f64,
    scale: f64,
    slack: f64,
}

impl Frustum {
    /// Returns the pyramid in the space of the tree; `None` where rounding may lose too much of the
    /// tree.
    #[inline(always)]
    fn new<T: Real, const N: usize>(pyramid: &Pyramid<'_, T, N>, space: &Space) -> Option<Self> {
        let (origin, pad) = space.point(pyramid.origin);
        if pad.is_nan() || pad > BLIND {
            return None;
        }
        let slack = 3.0 * pad;
        let [_, _, z] = pyramid.axes;
        let goes_up = pyramid.sign > 0.0;
        let side = |n: usize, is_upper: bool| {
            let (x, slopes) = (pyramid.axes[n], &pyramid.slopes[n]);
            let slope = match is_upper == goes_up {
                true => slopes
                    .iter()
                    .fold(slopes[0], |most, s| if *s > most { *s } else { most })
                    .next_up(),
                false => slopes
                    .iter()
                    .fold(slopes[0], |least, s| if *s < least { *s } else { least })
                    .next_down(),
            };
            let bound =
                origin[x] - f64::from(slope) * origin[z] + if is_upper { slack } else { -slack };
            let planes =
                [2 * x + usize::from(!is_upper), 2 * z + usize::from((slope >= 0.0) == is_upper)];
            Side { planes, slope, bound: bound as f32 }
        };
        Some(Self {
            upper: [side(0, true), side(1, true)],
            lower: [side(0, false), side(1, false)],
            near: 2 * z + usize::from(!goes_up),
            sign: pyramid.sign as f32,
            start: pyramid.sign * origin[z],
            scale: space.scale(),
            slack,
        })
    }

    /// Returns the coordinate along the rays, in the space of the tree, of a depth.
    #[inline(always)]
    fn reach(&self, depth: f64) -> f32 {
        (depth * self.scale + self.start + self.slack).min(1e30) as f32
    }

    /// Returns the coordinate along the rays at which each box begins, and a bit for each box that
    /// the pyramid may enter before `reach`.
    #[inline(always)]
    fn boxes(&self, planes: &[Eight; 6], reach: f32) -> (Eight, u32) {
        let (near, far) = (&planes[self.near], &planes[self.near ^ 1]);
        let start = (self.start - self.slack) as f32;
        let (mut begin, mut is_out) = ([0.0; 8], [false; 8]);
        for lane in 0..8 {
            begin[lane] = near[lane] * self.sign;
            is_out[lane] = (begin[lane] > reach) | (far[lane] * self.sign < start);
        }
        for (upper, lower) in self.upper.iter().zip(&self.lower) {
            let at = |side: &Side, lane: usize| {
                planes[side.planes[0]][lane] - side.slope * planes[side.planes[1]][lane]
            };
            for (lane, is_out) in is_out.iter_mut().enumerate() {
                *is_out |= (at(upper, lane) > upper.bound) | (at(lower, lane) < lower.bound);
            }
        }
        (begin, (0..8).fold(0, |entered, lane| entered | u32::from(!is_out[lane]) << lane))
    }
}
