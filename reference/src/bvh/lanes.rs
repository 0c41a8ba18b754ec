//! The instructions that a walk is made of: eight boxes at once where the machine has registers for them.
//!
//! One source is compiled for each: lane by lane the same operations of IEEE 754, none of them fused, so that every path visits the same nodes and finds
//! the same bits. NEON needs no path of its own: it is part of every 64-bit ARM processor, so that the portable path uses it there.
#![allow(unsafe_code, reason = "functions for some processors alone are unsafe to call; here it is known which")]

/// What to run.
pub(super) trait Work {
    /// Runs it; to be inlined always, so that it is made of the instructions of whoever calls it.
    fn run(self);
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
            Path::Portable => work.run(),
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
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512vl,avx512bw,avx512dq")]
fn avx512(work: impl Work) {
    work.run();
}
