//! Packets: rays that leave one point in nearly one direction, and so can be searched for together.

use crate::ray::Ray;
use crate::real::Real;
use crate::shapes::Shear;
use crate::vec3::Vec3;

/// Most rays of a packet: those through 4 × 4 pixels. Twice as many share more of the way down a
/// tree, but a fine mesh has more triangles for each that only some of them come near.
pub const MOST: usize = 16;

/// Rays from one point, all longest along one axis and the same way. What lies on a ray at a depth
/// along that axis lies beside it by depth times slope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet<'a, T> {
    /// The rays, at least one.
    pub rays: &'a [Ray<T>],
    /// The first ray as triangles need it.
    pub shear: Shear<T>,
    /// What differs in the others: for both axes across, how far each ray goes along them for each
    /// step along the third; beyond the rays as the first.
    pub across: [[T; MOST]; 2],
    /// 1 over the direction of each along the third.
    pub scale: [T; MOST],
    /// Two axes across the rays, and the one that they run along.
    pub axes: [usize; 3],
    /// The same as `across`, rounded; NaN beyond the rays.
    pub slopes: [[f32; MOST]; 2],
    /// 1 where the rays go up the third axis, −1 where they go down.
    pub sign: f64,
}

impl<'a, T: Real> Packet<'a, T> {
    /// `None` where the rays have not enough in common: different origins, directions along
    /// different axes, an interval that begins behind the origin; nor where there are none, or too
    /// many.
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

    /// The point that all rays leave.
    #[inline(always)]
    pub(crate) fn origin(&self) -> Vec3<T> {
        self.rays[0].origin
    }

    /// A bit for each ray.
    #[inline(always)]
    pub(crate) fn all(&self) -> u32 {
        (1 << self.rays.len()) - 1
    }

    /// How far along the third axis a ray has come at `t`.
    #[inline(always)]
    pub(crate) fn depth(&self, lane: usize, t: T) -> f64 {
        t.f64() * self.rays[lane].direction[self.axes[2]].abs().f64()
    }
}
