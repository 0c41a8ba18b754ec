//! A mesh asked by packets of rays.

use std::ops::Range;

use super::Mesh;
use crate::bvh::{Tally, Test, VisitTogether};
use crate::packet::{MOST, Packet};
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::Lecture;
use crate::shapes::{Look, Meeting, Shear};
use crate::triangles::Slopes;
use crate::vec3::Vec3;

/// Bounds of slopes grow by this share of themselves and of 1: four roundings to f32, where two are
/// lost.
const ROOM: f64 = 1.0 / 4_194_304.0;
/// Fewer rays than this are asked one by one.
const FEW: u32 = 3;
/// Corners less far ahead than this, in scene units, are not taken to slopes.
const AHEAD: f64 = 1e-100;

impl<T: Real> Mesh<T> {
    /// What [`Mesh::meet`] gives for each of some rays, [`MOST`] at most, by the rules of the
    /// lecture: told to `found` by the ray's place among them. They are searched for together where
    /// they have one origin and nearly one direction, else one by one.
    #[inline]
    pub(crate) fn meet_together<Y: Tally>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
        mut found: impl FnMut(usize, Meeting<T>),
    ) {
        let mut best = [None; MOST];
        if !self.is_met_by(rays, tally, &mut best) {
            for (ray, best) in rays.iter().zip(&mut best) {
                *best = self.meet(Lecture, ray, tally);
            }
        }
        for (lane, met) in best.iter().enumerate() {
            if let Some(met) = met {
                found(lane, *met);
            }
        }
    }

    /// Whether the rays can be searched for together.
    #[inline(always)]
    fn is_met_by<Y: Tally>(
        &self,
        rays: &[Ray<T>],
        tally: &mut Y,
        best: &mut [Option<Meeting<T>>; MOST],
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
        tree.walk_together(&packet, tally, first)
    }
}

/// Looks for the first meeting of each ray.
struct FirstOfEach<'a, T> {
    mesh: &'a Mesh<T>,
    packet: &'a Packet<'a, T>,
    origin: [f64; 3],
    /// That of the first ray, with the doubt of all.
    shear: Shear<T>,
    best: &'a mut [Option<Meeting<T>>; MOST],
    /// How far along their axis the best lie.
    depths: [f64; MOST],
    /// A bit for each ray that has met nothing yet.
    left: u32,
    /// The greatest depth of all best, ∞ where a ray has met nothing.
    limit: f64,
}

impl<T: Real, Y: Tally> VisitTogether<Y> for FirstOfEach<'_, T> {
    #[inline(always)]
    fn visit<P: Test>(&mut self, tally: &mut Y, things: Range<u32>) -> f64 {
        let mut is_nearer = false;
        let slopes = self.mesh.triangles.slopes(things.start, self.origin, self.packet.axes);
        for (n, lane) in things.zip(0..) {
            tally.thing();
            let near = self.near::<P>(&slopes, lane);
            is_nearer |= match near.count_ones() {
                0 => false,
                1..FEW => self.ask_each(n, near),
                _ => self.ask_all(n, near),
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
    fn fetch<P: Test>(&self, things: Range<u32>) {
        self.mesh.triangles.fetch::<P>(things.start);
    }
}

impl<T: Real> FirstOfEach<'_, T> {
    /// Whether any of the rays `near` meets the triangle before all others so far.
    #[inline(always)]
    fn ask_each(&mut self, n: u32, mut near: u32) -> bool {
        let triangle = self.mesh.triangles.get(n);
        let mut is_nearer = false;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % MOST;
            near &= near - 1;
            let [x, y] = &self.packet.across;
            let shear = self.shear.of_other([x[lane], y[lane]], self.packet.scale[lane]);
            if let Some(met) = triangle.meet(Lecture, &self.packet.rays[lane], &shear, n) {
                is_nearer |= self.take(lane, met);
            }
        }
        is_nearer
    }

    /// The same for many: one look along all rays at once leaves few to be asked alone.
    #[allow(
        clippy::needless_range_loop,
        reason = "many lists side by side, which the compiler takes lane by lane"
    )]
    #[inline(always)]
    fn ask_all(&mut self, n: u32, near: u32) -> bool {
        let (packet, origin, [x, y, z]) = (self.packet, self.packet.origin(), self.packet.axes);
        let [a, b, c] = self.mesh.triangles.get(n).corners;
        let (a, b, c) = (a - origin, b - origin, c - origin);
        let corners = [[a[x], a[y], a[z]], [b[x], b[y], b[z]], [c[x], c[y], c[z]]];
        let mut found = [[T::ZERO; MOST]; 4];
        let (mut sure, mut missed) = (0_u64, 0_u64);
        for lane in 0..MOST {
            let look = Look::along(
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
        let mut met = near & sure;
        let mut is_nearer = false;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % MOST;
            met &= met - 1;
            let [t, u, v, w] = &found;
            if packet.rays[lane].contains(t[lane]) {
                let weights = Vec3::new(u[lane], v[lane], w[lane]);
                is_nearer |= self.take(lane, Meeting { t: t[lane], part: n, weights });
            }
        }
        self.ask_each(n, near & !sure) || is_nearer
    }

    /// Takes what a ray has met, if it is the first so far; whether it is.
    #[inline(always)]
    fn take(&mut self, lane: usize, met: Meeting<T>) -> bool {
        let best = &mut self.best[lane];
        let is_first =
            best.is_none_or(|b| met.t < b.t || (met.t == b.t && self.mesh.is_earlier(met, b)));
        if is_first {
            *best = Some(met);
            self.depths[lane] = self.packet.depth(lane, met.t);
            self.left &= !(1 << lane);
        }
        is_first
    }

    /// A bit for each ray that may meet one of four triangles: whose slopes lie between those of
    /// the corners.
    #[inline(always)]
    fn near<P: Test>(&self, slopes: &Slopes, lane: usize) -> u32 {
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
        // a loop, as closures would not be made of the same instructions
        for (n, (x, y)) in x.as_chunks().0.iter().zip(y.as_chunks().0).enumerate() {
            near |= P::within([x, y], least, most) << (8 * n);
        }
        near
    }
}
