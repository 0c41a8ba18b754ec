//! Materials, in the precision of a render.

use super::lights::Light;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;

/// The coefficients by which a surface reflects and transmits light. [rule 3]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the letters of rule 3, as in `cases::Material`")]
pub struct Material<T> {
    pub ke: Vec3<T>,
    pub ka: Vec3<T>,
    pub kd: Vec3<T>,
    pub ks: Vec3<T>,
    pub kt: Vec3<T>,
    pub kr: Vec3<T>,
    pub ns: T,
    pub index: T,
}

/// The lights of which a material reflects something: those with a channel in which neither the
/// light nor kd + ks is 0. [rule 3]
///
/// A red lamp adds nothing to a blue surface, so that its shadow ray would change nothing. The
/// lights are found once for a scene: products at each hit cost up to 2 % of the instructions of a
/// picture that has no such lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReflectedLights(u64);

impl ReflectedLights {
    /// Returns the lights that `material` reflects. Only the first 64 lights are examined.
    pub fn of<T: Real>(material: &Material<T>, lights: &[Light<T>]) -> Self {
        let gives = |light: &Light<T>| {
            let (kd, ks) = (material.kd, material.ks);
            (0..3).any(|c| light.colour[c] != T::ZERO && (kd[c] != T::ZERO || ks[c] != T::ZERO))
        };
        let first = lights.iter().take(64).enumerate();
        Self(first.fold(0, |bits, (j, light)| bits | u64::from(gives(light)) << j))
    }

    /// Returns whether the light with the index `j` is one of them, which is assumed of those that
    /// were not examined.
    #[inline(always)]
    pub fn has(self, j: usize) -> bool {
        j >= 64 || self.0 >> j & 1 == 1
    }
}

impl<T: Real> Material<T> {
    /// Returns the material in the precision `T`.
    pub fn of(m: &cases::Material) -> Self {
        Self {
            ke: Vec3::of(m.ke),
            ka: Vec3::of(m.ka),
            kd: Vec3::of(m.kd),
            ks: Vec3::of(m.ks),
            kt: Vec3::of(m.kt),
            kr: Vec3::of(m.kr),
            ns: T::of(m.ns),
            index: T::of(m.index),
        }
    }
}

/// The greatest exponent of a highlight for which (N·H)₊^ns is certainly less than 2, although
/// rounding may make N·H a little greater than 1.
const MOST_NS: f64 = 1e5;

impl<T: Real> Material<T> {
    /// Returns whether the material reflects at most kd + ks of a light, except for a factor of 2
    /// for rounding, and tints shadows with at most 1. It is false for a negative coefficient.
    pub fn only_weakens(&self) -> bool {
        let least = self.kd.min_element().least(self.ks.min_element()).least(self.kt.min_element());
        least >= T::ZERO && self.kt.max_element() <= T::ONE && self.ns <= T::of(MOST_NS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(kd: [f64; 3], ks: [f64; 3]) -> Material<f64> {
        let vector = |[x, y, z]: [f64; 3]| Vec3::new(x, y, z);
        let zero = Vec3::ZERO;
        let (kd, ks) = (vector(kd), vector(ks));
        Material { ke: zero, ka: zero, kd, ks, kt: zero, kr: zero, ns: 1.0, index: 1.0 }
    }

    fn light(colour: [f64; 3]) -> Light<f64> {
        Light::of(&cases::Light::Directional {
            direction: -glam::DVec3::Y,
            colour: colour.into(),
            ambient: glam::DVec3::ONE,
        })
    }

    #[test]
    fn a_light_counts_where_it_shares_a_channel_with_kd_or_ks() {
        let lights = [light([1.0, 0.0, 0.0]), light([0.0; 3]), light([0.0, 1e-300, 0.0])];
        let table = [
            (material([0.0, 0.0, 1.0], [0.0; 3]), [false, false, false]),
            (material([0.5, 0.0, 0.0], [0.0; 3]), [true, false, false]),
            (material([0.0; 3], [0.0, 1e-300, 0.0]), [false, false, true]),
            (material([1.0; 3], [1.0; 3]), [true, false, true]),
            (material([0.0; 3], [0.0; 3]), [false, false, false]),
        ];
        for (material, expected) in table {
            let found = ReflectedLights::of(&material, &lights);
            assert_eq!([0, 1, 2].map(|j| found.has(j)), expected, "{material:?}");
        }
    }

    #[test]
    fn lights_beyond_the_64th_are_assumed_to_count() {
        let lights = vec![light([0.0; 3]); 70];
        let found = ReflectedLights::of(&material([1.0; 3], [1.0; 3]), &lights);
        assert_eq!([63, 64, 69].map(|j| found.has(j)), [false, true, true]);
    }
}
