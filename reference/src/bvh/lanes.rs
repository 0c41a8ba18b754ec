//! The instructions that a walk is made of: eight boxes at once where the machine has registers for them.
//!
//! One source is compiled for each: lane by lane the same operations of IEEE 754, none of them fused, so that every path visits the same nodes and finds
//! the same bits. NEON needs no path of its own: it is part of every 64-bit ARM processor, so that the portable path uses it there.
#![allow(unsafe_code, reason = "functions for some processors alone are unsafe to call; here it is known which")]

use super::slab::Slab;

/// Numbers side by side.
pub(super) type Eight = [f32; 8];

/// Eight boxes against a ray.
pub(super) trait Test {
    /// At which τ from 0 on the ray enters each box, and a bit for each that it leaves no earlier, and enters no later than `reach`. The planes come axis
    /// by axis, those met first, then those met last.
    fn boxes(planes: [[&Eight; 2]; 3], ray: &Slab, reach: f32) -> (Eight, u32);
}

/// What to run.
pub(super) trait Work {
    /// Runs it; to be inlined always, so that it is made of the instructions of whoever calls it.
    fn run<P: Test>(self);
}

struct Portable;

impl Test for Portable {
    #[inline(always)]
    fn boxes(planes: [[&Eight; 2]; 3], ray: &Slab, reach: f32) -> (Eight, u32) {
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
}

#[cfg(target_arch = "x86_64")]
struct Wide;

#[cfg(target_arch = "x86_64")]
impl Test for Wide {
    #[inline(always)]
    fn boxes(planes: [[&Eight; 2]; 3], ray: &Slab, reach: f32) -> (Eight, u32) {
        use std::arch::x86_64::*;
        let mut all = [0.0; 8];
        // SAFETY: `Lanes` runs this where the processor has AVX2; what is read and written is as long as a register.
        let entered = unsafe {
            let (mut enter, mut leave) = (_mm256_setzero_ps(), _mm256_set1_ps(reach));
            for (axis, [near, far]) in planes.into_iter().enumerate() {
                let inverse = _mm256_set1_ps(ray.inverse[axis]);
                let t = |planes: &Eight, from| {
                    _mm256_mul_ps(_mm256_sub_ps(_mm256_loadu_ps(planes.as_ptr()), _mm256_set1_ps(from)), inverse)
                };
                enter = _mm256_max_ps(t(near, ray.from_near[axis]), enter);
                leave = _mm256_min_ps(t(far, ray.from_far[axis]), leave);
            }
            _mm256_storeu_ps(all.as_mut_ptr(), enter);
            _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave))
        };
        (all, entered.cast_unsigned())
    }
}

/// A set of instructions that this processor has.
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
    /// The widest that this processor has.
    pub fn best() -> Self {
        *Self::all().last().unwrap_or(&Self(Path::Portable))
    }

    /// All that this processor has, narrowest first.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self(Path::Portable)];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                all.push(Self(Path::Avx2));
            }
            let has_avx512 = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl");
            if has_avx512 && is_x86_feature_detected!("avx512dq") && is_x86_feature_detected!("avx512bw") {
                all.push(Self(Path::Avx512));
            }
        }
        all
    }

    /// Runs `work` by these instructions.
    #[inline(always)]
    pub(super) fn run(self, work: impl Work) {
        match self.0 {
            Path::Portable => work.run::<Portable>(),
            // SAFETY: `all` alone makes this path, where the processor has the instructions.
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
fn avx2(work: impl Work) {
    work.run::<Wide>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512vl,avx512bw,avx512dq")]
fn avx512(work: impl Work) {
    work.run::<Wide>();
}
