//! Searches of a mesh for packets of rays.

use std::ops::Range;

use super::Mesh;
use crate::bvh::{VisitCounter, VisitPacket};
use crate::lanes::LaneTests;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::Lecture;
use crate::shapes::{FirstStep, ShapeHit, Shear};
use crate::world::packet::{MOST, Packet};
use crate::world::triangles::Slopes;

/// The share of themselves and of 1 by which bounds of slopes grow: four roundings to f32, where
/// two are lost.
const ROOM: f64 = 1.0 / 4_194_304.0;
/// Fewer rays than this are tested one by one.
const FEW: u32 = 3;
/// If corners are less far ahead than this, in scene units, no slopes are taken of them.
const AHEAD: f64 = 1e-100;

impl<T: Real> Mesh<T> {
    /// Calls `found` with the index and the hit of each ray that hits, as [`Mesh::intersect`]
    /// returns it by the rules of the lecture.
    ///
    /// There are at most [`MOST`] rays. One search serves all of them where they have one origin
    /// and nearly one direction; otherwise they are searched for one by one.
    #[inline]
    pub(crate) fn intersect_packet<Y: VisitCounter>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
        mut found: impl FnMut(usize, ShapeHit<T>),
    ) {
        let mut best = [None; MOST];
        if !self.intersect_as_packet(rays, tally, &mut best) {
            for (ray, best) in rays.iter().zip(&mut best) {
                *best = self.intersect(Lecture, ray, tally);
            }
        }
        for (lane, hit) in best.iter().enumerate() {
            if let Some(hit) = hit {
                found(lane, *hit);
            }
        }
    }

    /// Searches for the first hits of all rays at once. Returns whether that is possible for these
    /// rays.
    #[inline(always)]
    fn intersect_as_packet<Y: VisitCounter>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
        best: &mut [Option<ShapeHit<T>>; MOST],
    ) -> bool {
        let (Some(tree), Some(packet)) = (&self.tree, Packet::of(rays)) else { return false };
        let shear = packet.shear.within(&rays[0], self.bounds);
        if !shear.is_bounded() {
            return false;
        }
        let (left, limit) = (packet.all(), f64::INFINITY);
        let Vec3 { x, y, z } = packet.origin();
        let origin = [x.f64(), y.f64(), z.f64()];
        let first = FirstOfEach {
            mesh: self,
            packet: &packet,
            origin,
            shear,
            best,
            depths: [0.0; MOST],
            left,
            limit,
        };
        tree.walk_packet(&packet.pyramid(), tally, first)
    }
}

/// A visitor that finds the first hit of each ray.
struct FirstOfEach<'a, T> {
    mesh: &'a Mesh<T>,
    packet: &'a Packet<'a, T>,
    origin: [f64; 3],
    /// The shear of the first ray, with an error bound that holds for all rays.
    shear: Shear<T>,
    best: &'a mut [Option<ShapeHit<T>>; MOST],
    /// The depths of the best hits along the axis of the packet.
    depths: [f64; MOST],
    /// A bit for each ray without a hit so far.
    left: u32,
    /// The greatest depth of all best hits, ∞ while a ray has no hit.
    limit: f64,
}

impl<T: Real, Y: VisitCounter> VisitPacket<Y> for FirstOfEach<'_, T> {
    #[inline(always)]
    fn visit<P: LaneTests>(&mut self, tally: &mut Y, primitives: Range<u32>) -> f64 {
        let mut is_nearer = false;
        let slopes = self.mesh.triangles.slopes(primitives.start, self.origin, self.packet.axes);
        for (n, lane) in primitives.zip(0..) {
            tally.primitive();
            let near = self.near::<P>(&slopes, lane);
            is_nearer |= match near.count_ones() {
                0 => false,
                1..FEW => self.intersect_each(n, near),
                _ => self.intersect_all(n, near),
            };
        }
        if is_nearer && self.left == 0 {
            self.limit = self
                .depths
                .iter()
                .fold(0.0, |most, depth| if *depth > most { *depth } else { most });
        }
        self.limit
    }

    #[inline(always)]
    fn fetch<P: LaneTests>(&self, primitives: Range<u32>) {
        self.mesh.triangles.fetch::<P>(primitives.start);
    }
}

impl<T: Real> FirstOfEach<'_, T> {
    /// Tests the rays `near` one by one. Returns whether any of them hits the triangle before all
    /// others so far.
    #[inline(always)]
    fn intersect_each(&mut self, n: u32, mut near: u32) -> bool {
        let triangle = self.mesh.triangles.get(n);
        let mut is_nearer = false;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % MOST;
            near &= near - 1;
            let [x, y] = &self.packet.across;
            let shear = self.shear.of_other([x[lane], y[lane]], self.packet.scale[lane]);
            if let Some(hit) = triangle.intersect(Lecture, &self.packet.rays[lane], &shear, n) {
                is_nearer |= self.take(lane, hit);
            }
        }
        is_nearer
    }

    /// Tests many rays, and returns what [`Self::intersect_each`] returns: one look along all rays
    /// at once leaves few to be tested alone.
    #[allow(
        clippy::needless_range_loop,
        reason = "many lists side by side, which the compiler takes lane by lane"
    )]
    #[inline(always)]
    fn intersect_all(&mut self, n: u32, near: u32) -> bool {
        let (packet, origin, [x, y, z]) = (self.packet, self.packet.origin(), self.packet.axes);
        let [a, b, c] = self.mesh.triangles.get(n).corners;
        let (a, b, c) = (a - origin, b - origin, c - origin);
        let corners = [[a[x], a[y], a[z]], [b[x], b[y], b[z]], [c[x], c[y], c[z]]];
        let mut found = [[T::ZERO; MOST]; 4];
        let (mut sure, mut missed) = (0_u64, 0_u64);
        for lane in 0..MOST {
            let look = FirstStep::along(
                [packet.across[0][lane], packet.across[1][lane]],
                packet.scale[lane],
                corners,
            );
            sure |= if look.is_sure { 1 << lane } else { 0 };
            missed |= if look.is_missed { 1 << lane } else { 0 };
            found[0][lane] = look.t;
            found[1][lane] = look.weights.x;
            found[2][lane] = look.weights.y;
            found[3][lane] = look.weights.z;
        }
        let (near, sure) = (near & !(missed as u32), sure as u32);
        let mut hit = near & sure;
        let mut is_nearer = false;
        while hit != 0 {
            let lane = hit.trailing_zeros() as usize % MOST;
            hit &= hit - 1;
            let [t, u, v, w] = &found;
            if packet.rays[lane].contains(t[lane]) {
                let weights = Vec3::new(u[lane], v[lane], w[lane]);
                is_nearer |= self.take(lane, ShapeHit { t: t[lane], part: n, weights });
            }
        }
        self.intersect_each(n, near & !sure) || is_nearer
    }

    /// Keeps a hit of a ray if it is the first so far. Returns whether it is.
    #[inline(always)]
    fn take(&mut self, lane: usize, hit: ShapeHit<T>) -> bool {
        let best = &mut self.best[lane];
        let is_first =
            best.is_none_or(|b| hit.t < b.t || (hit.t == b.t && self.mesh.is_earlier(hit, b)));
        if is_first {
            *best = Some(hit);
            self.depths[lane] = self.packet.depth(lane, hit.t);
            self.left &= !(1 << lane);
        }
        is_first
    }

    /// Returns a bit for each ray that may hit the triangle `lane` of four: its slopes lie between
    /// those of the corners.
    #[inline(always)]
    fn near<P: LaneTests>(&self, slopes: &Slopes, lane: usize) -> u32 {
        let [least, most] = &slopes.depth;
        let ahead = if self.packet.sign > 0.0 { least[lane] } else { -most[lane] };
        if ahead < AHEAD {
            return self.packet.all();
        }
        let below = |slope: f64| (slope - (slope.abs() + 1.0) * ROOM) as f32;
        let above = |slope: f64| (slope + (slope.abs() + 1.0) * ROOM) as f32;
        let [[x0, x1], [y0, y1]] = &slopes.span;
        let (least, most) =
            ([below(x0[lane]), below(y0[lane])], [above(x1[lane]), above(y1[lane])]);
        let [x, y] = &self.packet.slopes;
        let mut near = 0;
        // A loop, because a closure would not be compiled with the same instructions.
        for (n, (x, y)) in x.as_chunks().0.iter().zip(y.as_chunks().0).enumerate() {
            near |= P::within([x, y], least, most) << (8 * n);
        }
        near
    }
}
