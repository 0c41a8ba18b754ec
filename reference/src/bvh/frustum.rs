//! A packet of rays in a tree's space: the pyramid that holds them all, asked where one ray would
//! be.
//!
//! **No box hides a hit.** Let z be the axis that the rays run along, x one across it, o the
//! origin. A ray with slope s passes the points x − o.x = s (z − o.z), so that, ahead of the
//! origin, with the greatest slope S of all rays, x − S z ≤ o.x − S o.z; below by the least slope
//! likewise, and both the other way round where the rays go down their axis. A box all of which
//! breaks one of these is missed by every ray. The bound on the right is worked out in f64, for the
//! very S that is used: the greatest slope rounded to f32 and then moved up by one place more, so
//! that none is beyond it. Of a box, x − S z is least where x is, and where S z is greatest. With u
//! = 2⁻²⁴ it is off by u for S z, 2u for the difference and 2u for the planes themselves; a bound
//! that amounts to less than 4 by 2u for being rounded to f32, and a greater one decides nothing
//! narrowly, as no box reaches so far: 7u in all, which the 32u by which boxes grow in `slab` more
//! than cover. Depths are off by less.
//!
//! What the test of a thing loses, the pad of `slab`, counts once for x and |S| ≤ 1 times for z. A
//! third is left for what f64 loses here: 256 last places are many.

use std::ops::Range;

use super::lanes::{Eight, Test, Work};
use super::node::{Child, Open};
use super::slab::{BLIND, Space};
use super::{Bvh, Tally};
use crate::packet::Packet;
use crate::real::Real;

/// Visits things for a packet.
pub(crate) trait VisitTogether<Y> {
    /// Visits the things of a leaf; the depth before which something may still be met, ∞ at first.
    fn visit<P: Test>(&mut self, tally: &mut Y, things: Range<u32>) -> f64;

    /// Has what is needed of them fetched from memory: they may be visited soon.
    fn fetch<P: Test>(&self, things: Range<u32>);
}

impl Bvh {
    /// Has `visitor` visit every thing whose box the pyramid of the packet enters before the limit,
    /// nearer boxes first; whether it could: not where rounding may lose much of the tree.
    #[inline]
    pub(crate) fn walk_together<T: Real, Y: Tally>(
        &self,
        packet: &Packet<'_, T>,
        tally: &mut Y,
        visitor: impl VisitTogether<Y>,
    ) -> bool {
        let Some(frustum) = Frustum::new(packet, &self.space) else { return false };
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

impl<Y: Tally, V: VisitTogether<Y>> Work for Walk<'_, Y, V> {
    #[inline(always)]
    fn run<P: Test>(self) {
        let Self { tree, frustum, tally, mut visitor } = self;
        let mut reach = frustum.reach(f64::INFINITY);
        let mut open = Open::new();
        let mut at = Child::ROOT;
        loop {
            let nearest = match at.things() {
                None => {
                    tally.node();
                    let node = &tree.nodes[at.node()];
                    let (enter, entered) = frustum.boxes(node.planes(), reach);
                    for child in node.children(entered) {
                        match child.things() {
                            None => P::fetch(&tree.nodes[child.node()]),
                            Some(things) => visitor.fetch::<P>(things),
                        }
                    }
                    node.open(enter, entered, &mut open)
                }
                Some(things) => {
                    reach = frustum.reach(visitor.visit::<P>(tally, things));
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
    /// The planes of a box whose x and z are asked.
    planes: [usize; 2],
    slope: f32,
    bound: f32,
}

/// What holds all rays of a packet.
#[derive(Clone, Copy, Debug)]
struct Frustum {
    /// Beyond these x − slope · z is greater than the bound.
    upper: [Side; 2],
    /// Beyond these it is less.
    lower: [Side; 2],
    /// The plane of a box that is met first along the axis.
    near: usize,
    /// 1 or −1, which makes of its coordinate one that grows along the rays.
    sign: f32,
    /// Such a coordinate, of the origin.
    start: f64,
    scale: f64,
    slack: f64,
}

impl Frustum {
    /// `None` where rounding may lose too much of the tree.
    #[inline(always)]
    fn new<T: Real>(packet: &Packet<'_, T>, space: &Space) -> Option<Self> {
        let (origin, pad) = space.point(packet.origin());
        if pad.is_nan() || pad > BLIND {
            return None;
        }
        let slack = 3.0 * pad;
        let [_, _, z] = packet.axes;
        let goes_up = packet.sign > 0.0;
        let side = |n: usize, is_upper: bool| {
            let (x, slopes) = (packet.axes[n], &packet.slopes[n]);
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
            sign: packet.sign as f32,
            start: packet.sign * origin[z],
            scale: space.scale(),
            slack,
        })
    }

    /// Where in the tree a depth lies.
    #[inline(always)]
    fn reach(&self, depth: f64) -> f32 {
        (depth * self.scale + self.start + self.slack).min(1e30) as f32
    }

    /// At which coordinate along the rays each box begins, and a bit for each that the pyramid may
    /// enter, before `reach`.
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
