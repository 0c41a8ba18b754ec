//! Packets of rays that leave one point in nearly one direction, so that one search serves all of
//! them.

use crate::bvh::Pyramid;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::shapes::Shear;

/// The greatest number of rays in a packet: those through 4 × 4 pixels.
///
/// Twice as many would share more of the way down a tree, but in a fine mesh more triangles would
/// be near only some of the rays.
pub const MOST: usize = 16;

/// Rays from one point, whose directions are all longest along one axis, and go the same way along
/// it.
///
/// A point of a ray at some depth along that axis is offset across it by depth times slope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet<'a, T> {
    /// The rays, at least one.
    pub rays: &'a [Ray<T>],
    /// The shear of the first ray.
    pub shear: Shear<T>,
    /// The slopes of all rays: for both axes across, how far each ray goes along it per step along
    /// the third axis. Beyond the last ray, the slopes of the first one are repeated.
    pub across: [[T; MOST]; 2],
    /// 1 over the component of each direction along the third axis.
    pub scale: [T; MOST],
    /// Two axes across the rays, and the one that they run along.
    pub axes: [usize; 3],
    /// The slopes of `across`, rounded to f32; NaN beyond the last ray.
    pub slopes: [[f32; MOST]; 2],
    /// 1 where the rays go up the third axis, −1 where they go down.
    pub sign: f64,
}

impl<'a, T: Real> Packet<'a, T> {
    /// Returns the packet of these rays; `None` where they have too little in common.
    ///
    /// A packet needs one origin, directions that are longest along one axis and go the same way
    /// along it, and intervals that do not begin behind the origin. No rays, and more than
    /// [`MOST`], give `None` as well.
    #[inline(always)]
    pub(crate) fn of(rays: &'a [Ray<T>]) -> Option<Self> {
        let first = rays.first().filter(|_| rays.len() <= MOST)?;
        let shear = Shear::of(first);
        let axes = shear.axes();
        let sign = first.direction[axes[2]].f64().signum();
        let [x, y] = shear.slopes();
        let (mut across, mut slopes) = ([[x; MOST], [y; MOST]], [[f32::NAN; MOST]; 2]);
        let mut scale = [shear.scale(); MOST];
        let mut is_one = true;
        for (lane, ray) in rays.iter().enumerate() {
            let shear = Shear::of(ray);
            let along = ray.direction[axes[2]];
            is_one &=
                ray.origin == first.origin && shear.axes() == axes && along.f64() * sign > 0.0;
            is_one &= along.is_safe() && ray.is_before(T::ZERO);
            [across[0][lane], across[1][lane]] = shear.slopes();
            scale[lane] = shear.scale();
            (slopes[0][lane], slopes[1][lane]) =
                (across[0][lane].f64() as f32, across[1][lane].f64() as f32);
        }
        is_one.then_some(Self { rays, shear, across, scale, axes, slopes, sign })
    }

    /// Returns the pyramid that holds all rays, as a tree of boxes needs it.
    #[inline(always)]
    pub(crate) fn pyramid(&self) -> Pyramid<'_, T, MOST> {
        Pyramid { origin: self.origin(), axes: self.axes, slopes: &self.slopes, sign: self.sign }
    }

    /// Returns the point that all rays leave.
    #[inline(always)]
    pub(crate) fn origin(&self) -> Vec3<T> {
        self.rays[0].origin
    }

    /// Returns a bit for each ray.
    #[inline(always)]
    pub(crate) fn all(&self) -> u32 {
        (1 << self.rays.len()) - 1
    }

    /// Returns how far along the third axis a ray has come at `t`.
    #[inline(always)]
    pub(crate) fn depth(&self, lane: usize, t: T) -> f64 {
        t.f64() * self.rays[lane].direction[self.axes[2]].abs().f64()
    }
}
