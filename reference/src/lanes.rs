//! Tests of eight boxes or four triangles at once, for each instruction set that a processor may
//! have.
//!
//! One source is compiled for each set. Lane by lane, all of them do the same operations of IEEE
//! 754, none of them fused, so every path visits the same nodes and finds the same bits. NEON needs
//! no path of its own: it is part of every 64-bit ARM processor, so the portable path uses it
//! there.
// A function that is compiled for one kind of processor is unsafe to call on another. This file
// detects the kind that it runs on.
#![allow(unsafe_code)]

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

/// Eight numbers side by side.
pub(crate) type Eight = [f32; 8];

/// The tests of several boxes, triangles or points at once.
pub(crate) trait LaneTests {
    /// Returns the τ, at least 0, at which the ray enters each box. Also returns a bit for each box
    /// that it leaves no earlier, and enters no later than `reach`.
    ///
    /// The planes come axis by axis: first those that the ray crosses first, then those that it
    /// crosses last.
    fn boxes(planes: [[&Eight; 2]; 3], ray: &BoxRay, reach: f32) -> (Eight, u32);

    /// Returns a bit for each triangle that the ray does not certainly miss.
    fn singles(corners: &Four<f32>, ray: &TriangleRay) -> u32;

    /// Returns a bit for each triangle, with corners in double precision, that the ray does not
    /// certainly miss.
    fn doubles(corners: &Four<f64>, ray: &TriangleRay) -> u32;

    /// Returns a bit for each of eight points (x, y) of a plane that lies between `least` and
    /// `most`, both included. NaN gives no bit.
    fn within(points: [&Eight; 2], least: [f32; 2], most: [f32; 2]) -> u32;

    /// Prefetches memory that is soon to be read. This affects nothing but time.
    #[inline(always)]
    fn fetch<A>(_soon: &A) {}
}

/// Four triangles side by side: for each corner and axis, the coordinate of each of the four.
pub(crate) type Four<S> = [[[S; 4]; 3]; 3];

/// A ray for the test of boxes: a start, moved outwards by what rounding may lose, and the inverse
/// of the direction.
///
/// Only the first three numbers of each array count; a fourth fills the register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    /// The start, moved away from the plane of each axis that the ray crosses first.
    pub from_near: [f32; 4],
    /// The start, moved away from the plane of each axis that the ray crosses last.
    pub from_far: [f32; 4],
    /// 1/direction, finite.
    pub inverse: [f32; 4],
}

/// A ray for the test of triangles, which misses nearly all of them by far:
/// [`crate::shapes::Shear`] in f64.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleRay {
    /// The origin of the ray.
    pub origin: [f64; 3],
    /// Two axes across the ray, and the axis that it mostly runs along.
    pub axes: [usize; 3],
    /// The shear of the first two axes per step along the third.
    pub shear: [f64; 2],
    /// The error bound of every area.
    pub doubt: f64,
}

/// A computation that is compiled for each instruction set.
pub(crate) trait LaneTask {
    /// Runs the computation. Implementations are always inlined, so that they are compiled with the
    /// instructions of their caller.
    fn run<P: LaneTests>(self);
}

struct Portable;

impl LaneTests for Portable {
    #[inline(always)]
    fn within([x, y]: [&Eight; 2], least: [f32; 2], most: [f32; 2]) -> u32 {
        (0..8).fold(0, |all, lane| {
            let is_within = |at: f32, n: usize| least[n] <= at && at <= most[n];
            all | u32::from(is_within(x[lane], 0) && is_within(y[lane], 1)) << lane
        })
    }

    #[inline(always)]
    fn boxes(planes: [[&Eight; 2]; 3], ray: &BoxRay, reach: f32) -> (Eight, u32) {
        let (mut enter, mut leave) = ([0.0; 8], [reach; 8]);
        for (axis, [near, far]) in planes.into_iter().enumerate() {
            for lane in 0..8 {
                let t = (near[lane] - ray.from_near[axis]) * ray.inverse[axis];
                enter[lane] = if t > enter[lane] { t } else { enter[lane] };
                let t = (far[lane] - ray.from_far[axis]) * ray.inverse[axis];
                leave[lane] = if t < leave[lane] { t } else { leave[lane] };
            }
        }
        let bit = |lane: usize| u32::from(enter[lane] <= leave[lane]) << lane;
        (enter, (0..8).fold(0, |entered, lane| entered | bit(lane)))
    }

    #[inline(always)]
    fn singles(corners: &Four<f32>, ray: &TriangleRay) -> u32 {
        (0..4).fold(0, |left, n| {
            left | one(corners.map(|corner| corner.map(|axis| f64::from(axis[n]))), ray) << n
        })
    }

    #[inline(always)]
    fn doubles(corners: &Four<f64>, ray: &TriangleRay) -> u32 {
        (0..4).fold(0, |left, n| {
            left | one(corners.map(|corner| corner.map(|axis| axis[n])), ray) << n
        })
    }
}

/// Returns 1 for a triangle that the ray does not certainly miss, else 0.
#[inline(always)]
fn one(corners: [[f64; 3]; 3], ray: &TriangleRay) -> u32 {
    let [x, y, z] = ray.axes;
    let [a, b, c] = corners.map(|corner| {
        let from = |axis: usize| corner[axis] - ray.origin[axis];
        [from(x) - ray.shear[0] * from(z), from(y) - ray.shear[1] * from(z)]
    });
    let area = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let [u, v, w] = [area(b, c), area(c, a), area(a, b)];
    let is_far = |sign: f64| sign * u > ray.doubt || sign * v > ray.doubt || sign * w > ray.doubt;
    u32::from(!(is_far(1.0) && is_far(-1.0)))
}

#[cfg(target_arch = "x86_64")]
struct Wide;

#[cfg(target_arch = "x86_64")]
impl LaneTests for Wide {
    #[inline(always)]
    fn within([x, y]: [&Eight; 2], least: [f32; 2], most: [f32; 2]) -> u32 {
        // SAFETY: as for boxes.
        let within = unsafe {
            let (x, y) = (_mm256_loadu_ps(x.as_ptr()), _mm256_loadu_ps(y.as_ptr()));
            let from_x = _mm256_cmp_ps::<_CMP_GE_OQ>(x, _mm256_set1_ps(least[0]));
            let to_x = _mm256_cmp_ps::<_CMP_LE_OQ>(x, _mm256_set1_ps(most[0]));
            let from_y = _mm256_cmp_ps::<_CMP_GE_OQ>(y, _mm256_set1_ps(least[1]));
            let to_y = _mm256_cmp_ps::<_CMP_LE_OQ>(y, _mm256_set1_ps(most[1]));
            _mm256_movemask_ps(_mm256_and_ps(
                _mm256_and_ps(from_x, to_x),
                _mm256_and_ps(from_y, to_y),
            ))
        };
        within.cast_unsigned()
    }

    #[inline(always)]
    fn fetch<A>(soon: &A) {
        for line in 0..size_of::<A>().div_ceil(64) {
            let line = std::ptr::from_ref(soon).cast::<i8>().wrapping_add(64 * line);
            // SAFETY: fetching reads nothing, whatever the address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(line) };
        }
    }

    #[inline(always)]
    fn boxes(planes: [[&Eight; 2]; 3], ray: &BoxRay, reach: f32) -> (Eight, u32) {
        let mut all = [0.0; 8];
        // SAFETY: `Lanes` runs this where the processor has AVX2; what is read and written is as
        // long as a register.
        let entered = unsafe {
            let (mut enter, mut leave) = (_mm256_setzero_ps(), _mm256_set1_ps(reach));
            for (axis, [near, far]) in planes.into_iter().enumerate() {
                let inverse = _mm256_set1_ps(ray.inverse[axis]);
                let t = |planes: &Eight, from| {
                    _mm256_mul_ps(
                        _mm256_sub_ps(_mm256_loadu_ps(planes.as_ptr()), _mm256_set1_ps(from)),
                        inverse,
                    )
                };
                enter = _mm256_max_ps(t(near, ray.from_near[axis]), enter);
                leave = _mm256_min_ps(t(far, ray.from_far[axis]), leave);
            }
            _mm256_storeu_ps(all.as_mut_ptr(), enter);
            _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave))
        };
        (all, entered.cast_unsigned())
    }

    #[inline(always)]
    fn singles(corners: &Four<f32>, ray: &TriangleRay) -> u32 {
        // SAFETY: as for boxes.
        unsafe { singles(corners, ray) }
    }

    #[inline(always)]
    fn doubles(corners: &Four<f64>, ray: &TriangleRay) -> u32 {
        // SAFETY: as for boxes.
        unsafe { doubles(corners, ray) }
    }
}

#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn singles(corners: &Four<f32>, ray: &TriangleRay) -> u32 {
    // SAFETY: what is read is as long as a register.
    let load = |corner: usize, axis: usize| {
        _mm256_cvtps_pd(unsafe { _mm_loadu_ps(corners[corner][axis].as_ptr()) })
    };
    let [x, y, z] = ray.axes;
    let a = seen(load(0, x), load(0, y), load(0, z), ray);
    let b = seen(load(1, x), load(1, y), load(1, z), ray);
    let c = seen(load(2, x), load(2, y), load(2, z), ray);
    not_missed(a, b, c, ray.doubt)
}

#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn doubles(corners: &Four<f64>, ray: &TriangleRay) -> u32 {
    // SAFETY: what is read is as long as a register.
    let load =
        |corner: usize, axis: usize| unsafe { _mm256_loadu_pd(corners[corner][axis].as_ptr()) };
    let [x, y, z] = ray.axes;
    let a = seen(load(0, x), load(0, y), load(0, z), ray);
    let b = seen(load(1, x), load(1, y), load(1, z), ray);
    let c = seen(load(2, x), load(2, y), load(2, z), ray);
    not_missed(a, b, c, ray.doubt)
}

/// Returns four corners as seen along the ray: x and y across it.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn seen(x: __m256d, y: __m256d, z: __m256d, ray: &TriangleRay) -> (__m256d, __m256d) {
    let ([at_x, at_y, at_z], [shear_x, shear_y]) = (ray.axes, ray.shear);
    let along = _mm256_sub_pd(z, _mm256_set1_pd(ray.origin[at_z]));
    let x = _mm256_sub_pd(x, _mm256_set1_pd(ray.origin[at_x]));
    let y = _mm256_sub_pd(y, _mm256_set1_pd(ray.origin[at_y]));
    let sheared_x = _mm256_sub_pd(x, _mm256_mul_pd(_mm256_set1_pd(shear_x), along));
    let sheared_y = _mm256_sub_pd(y, _mm256_mul_pd(_mm256_set1_pd(shear_y), along));
    (sheared_x, sheared_y)
}

/// Returns twice the signed areas of four triangles with a corner at 0.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn area(p: (__m256d, __m256d), q: (__m256d, __m256d)) -> __m256d {
    _mm256_sub_pd(_mm256_mul_pd(p.0, q.1), _mm256_mul_pd(p.1, q.0))
}

/// Returns a bit for each of four triangles whose areas do not prove that the ray misses it.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn not_missed(
    a: (__m256d, __m256d),
    b: (__m256d, __m256d),
    c: (__m256d, __m256d),
    doubt: f64,
) -> u32 {
    let (u, v, w) = (area(b, c), area(c, a), area(a, b));
    let most = _mm256_max_pd(_mm256_max_pd(u, v), w);
    let least = _mm256_min_pd(_mm256_min_pd(u, v), w);
    let is_above = _mm256_cmp_pd::<_CMP_GT_OQ>(most, _mm256_set1_pd(doubt));
    let is_below = _mm256_cmp_pd::<_CMP_LT_OQ>(least, _mm256_set1_pd(-doubt));
    !_mm256_movemask_pd(_mm256_and_pd(is_above, is_below)).cast_unsigned() & 0b1111
}

/// An instruction set that this processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lanes(Path);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Path {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Lanes {
    /// Returns the widest instruction set that this processor has.
    pub fn best() -> Self {
        *Self::all().last().unwrap_or(&Self(Path::Portable))
    }

    /// Returns all instruction sets that this processor has, narrowest first. The first one is
    /// portable.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self(Path::Portable)];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                all.push(Self(Path::Avx2));
            }
            let has_avx512 =
                is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl");
            if has_avx512
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
            {
                all.push(Self(Path::Avx512));
            }
        }
        all
    }

    /// Runs `work` with this instruction set.
    #[inline(always)]
    pub(crate) fn run(self, work: impl LaneTask) {
        match self.0 {
            Path::Portable => work.run::<Portable>(),
            // SAFETY: only `all` makes this path, where the processor has the instructions.
            #[cfg(target_arch = "x86_64")]
            Path::Avx2 => unsafe { avx2(work) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Path::Avx512 => unsafe { avx512(work) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(work: impl LaneTask) {
    work.run::<Wide>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512vl,avx512bw,avx512dq")]
fn avx512(work: impl LaneTask) {
    work.run::<Wide>();
}
