//! The triangles of a mesh, four side by side.

use rayon::prelude::*;

use crate::lanes::{Four, LaneTests, TriangleRay};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::shapes::Triangle;

/// The triangles of a mesh, each with corners of its own, so that those of a leaf lie in one place.
#[derive(Clone, Debug)]
pub(crate) enum Triangles {
    /// Single precision, where it holds every coordinate exactly, as those of most files are.
    Single(Vec<Four<f32>>),
    Double(Vec<Four<f64>>),
}

impl Triangles {
    /// Returns the triangles with these numbers, in that order.
    pub(crate) fn of<T: Real>(
        numbers: &[u32],
        triangle: impl Fn(&u32) -> Triangle<T> + Sync,
    ) -> Self {
        let is_single = |x: T| f64::from(x.f64() as f32) == x.f64();
        let fits = |n: &u32| {
            triangle(n).corners.iter().all(|c| is_single(c.x) && is_single(c.y) && is_single(c.z))
        };
        match numbers.par_iter().all(fits) {
            true => Self::Single(in_fours(numbers, triangle, |x| x.f64() as f32)),
            false => Self::Double(in_fours(numbers, triangle, |x| x.f64())),
        }
    }

    /// Returns the triangle with that number.
    #[inline(always)]
    pub(crate) fn get<T: Real>(&self, n: u32) -> Triangle<T> {
        match self {
            Self::Single(fours) => one(&fours[n as usize / 4], n as usize % 4),
            Self::Double(fours) => one(&fours[n as usize / 4], n as usize % 4),
        }
    }

    /// Returns a bit for each of the four triangles from `first` on, a multiple of four, that the
    /// ray does not certainly miss.
    #[inline(always)]
    pub(crate) fn left<P: LaneTests>(&self, first: u32, ray: &TriangleRay) -> u32 {
        match self {
            Self::Single(fours) => P::singles(&fours[first as usize / 4], ray),
            Self::Double(fours) => P::doubles(&fours[first as usize / 4], ray),
        }
    }

    /// Returns the slopes and depths of the corners, as seen from `origin`, of the four triangles
    /// from `first` on, a multiple of four.
    #[inline(always)]
    pub(crate) fn slopes(&self, first: u32, origin: [f64; 3], axes: [usize; 3]) -> Slopes {
        match self {
            Self::Single(fours) => slopes(&fours[first as usize / 4], origin, axes),
            Self::Double(fours) => slopes(&fours[first as usize / 4], origin, axes),
        }
    }

    /// Prefetches the four triangles from `first` on, a multiple of four.
    #[inline(always)]
    pub(crate) fn fetch<P: LaneTests>(&self, first: u32) {
        match self {
            Self::Single(fours) => P::fetch(&fours[first as usize / 4]),
            Self::Double(fours) => P::fetch(&fours[first as usize / 4]),
        }
    }

    /// Returns the bytes that the triangles take.
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Self::Single(fours) => size_of_val(&**fours),
            Self::Double(fours) => size_of_val(&**fours),
        }
    }
}

/// The slopes of four triangles as seen from a point: how far their corners lie along two axes
/// across per step along a third one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slopes {
    /// The least and the greatest slope along the first axis, then along the second.
    pub span: [[[f64; 4]; 2]; 2],
    /// The least and the greatest step along the third axis.
    pub depth: [[f64; 4]; 2],
}

#[inline(always)]
#[allow(
    clippy::needless_range_loop,
    reason = "many lists side by side, which the compiler takes lane by lane"
)]
fn slopes<S: Real>(four: &Four<S>, origin: [f64; 3], [x, y, z]: [usize; 3]) -> Slopes {
    let nothing = [[f64::INFINITY; 4], [-f64::INFINITY; 4]];
    let mut all = Slopes { span: [nothing; 2], depth: nothing };
    for corner in four {
        for lane in 0..4 {
            let depth = corner[z][lane].f64() - origin[z];
            let inverse = 1.0 / depth;
            widen(&mut all.depth, lane, depth);
            widen(&mut all.span[0], lane, (corner[x][lane].f64() - origin[x]) * inverse);
            widen(&mut all.span[1], lane, (corner[y][lane].f64() - origin[y]) * inverse);
        }
    }
    all
}

#[inline(always)]
fn widen([least, most]: &mut [[f64; 4]; 2], lane: usize, x: f64) {
    least[lane] = if x < least[lane] { x } else { least[lane] };
    most[lane] = if x > most[lane] { x } else { most[lane] };
}

#[inline(always)]
fn one<S: Real, T: Real>(four: &Four<S>, lane: usize) -> Triangle<T> {
    let corner = |[x, y, z]: &[[S; 4]; 3]| {
        Vec3::new(T::of(x[lane].f64()), T::of(y[lane].f64()), T::of(z[lane].f64()))
    };
    Triangle { corners: [corner(&four[0]), corner(&four[1]), corner(&four[2])] }
}

fn in_fours<T: Real, S: Real>(
    numbers: &[u32],
    triangle: impl Fn(&u32) -> Triangle<T> + Sync,
    stored: impl Fn(T) -> S + Sync,
) -> Vec<Four<S>> {
    let four = |numbers: &[u32]| {
        let mut four = [[[S::ZERO; 4]; 3]; 3];
        for (lane, n) in numbers.iter().enumerate() {
            for (corner, of) in four.iter_mut().zip(triangle(n).corners) {
                for (axis, x) in corner.iter_mut().zip([of.x, of.y, of.z]) {
                    axis[lane] = stored(x);
                }
            }
        }
        four
    };
    numbers.par_chunks(4).map(four).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks how one triangle with the coordinate `x` is stored.
    fn check(x: f64, is_single: bool) {
        let corners = [[x, 0.0, -0.0], [1.0, 2.5, 0.0], [0.0, 1.0, f64::from(f32::MIN_POSITIVE)]]
            .map(|[x, y, z]| Vec3::new(x, y, z));
        let triangles = Triangles::of(&[0], |_| Triangle { corners });
        assert_eq!(matches!(triangles, Triangles::Single(_)), is_single, "{x}");
        let bits = |corners: [Vec3<f64>; 3]| corners.map(|c| [c.x, c.y, c.z].map(f64::to_bits));
        assert_eq!(bits(triangles.get(0).corners), bits(corners), "{x}");
    }

    #[test]
    fn corners_keep_every_bit() {
        check(0.5, true);
        check(16_777_216.0, true);
        check(16_777_217.0, false);
        check(0.1, false);
        check(1e300, false);
        check(1e-300, false);
    }
}
