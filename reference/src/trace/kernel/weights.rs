//! The weights of spawned rays. [rule 7] [rule 8]

use cases::Effect;

use super::Kernel;
use crate::light::material::Material;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{MirrorWeight, RuleSource, TransmitWeight};
use crate::trace::simulated::EffectSource;

impl<T: Real, R: RuleSource, E: EffectSource> Kernel<'_, T, R, E> {
    /// Returns the weight of the reflected ray, or 0 if none is cast. [rule 7]
    pub(super) fn mirror_weight(&self, material: &Material<T>, is_inside: bool) -> Vec3<T> {
        match self.rules.get().mirror_weight {
            _ if !self.simulates(Effect::Reflection) => Vec3::ZERO,
            MirrorWeight::Ks => material.ks,
            _ if material.kr == Vec3::ZERO => Vec3::ZERO,
            MirrorWeight::Kr | MirrorWeight::Schlick => material.kr,
            MirrorWeight::Squared => material.kr * material.kr,
            MirrorWeight::One => Vec3::ONE,
            MirrorWeight::OnlyOutside => {
                if is_inside {
                    Vec3::ZERO
                } else {
                    material.kr
                }
            }
        }
    }

    /// Returns kr + kt of the effects that are simulated.
    pub(super) fn weight_sent_on(&self, material: &Material<T>, is_inside: bool, t: T) -> Vec3<T> {
        let kt = if self.simulates(Effect::Refraction) {
            self.transmit_weight(material, is_inside, t)
        } else {
            Vec3::ZERO
        };
        self.mirror_weight(material, is_inside) + kt
    }

    /// Returns the weight of the transmitted ray. The ray that hit the surface did so at `t`.
    /// [rule 8]
    pub(super) fn transmit_weight(&self, material: &Material<T>, is_inside: bool, t: T) -> Vec3<T> {
        let when_inside = |inside: Vec3<T>, outside: Vec3<T>| {
            if is_inside { inside } else { outside }
        };
        match self.rules.get().transmit_weight {
            TransmitWeight::Kt => material.kt,
            TransmitWeight::Kr => material.kr,
            TransmitWeight::OnEntry => when_inside(Vec3::ONE, material.kt),
            TransmitWeight::NoWayOut => when_inside(Vec3::ZERO, material.kt),
            TransmitWeight::ByLength => when_inside(material.kt.map(|k| k.pow(t)), Vec3::ONE),
            TransmitWeight::One => Vec3::ONE,
            TransmitWeight::OneMinusKr => Vec3::ONE - material.kr,
        }
    }

    /// Returns the weight of the reflected ray for this cosine of the angle of incidence. [rule 7]
    #[inline(always)]
    pub(super) fn by_angle(&self, kr: Vec3<T>, cosine: T) -> Vec3<T> {
        if self.rules.get().mirror_weight != MirrorWeight::Schlick || kr == Vec3::ZERO {
            return kr;
        }
        let rest = (T::ONE - cosine).greatest(T::ZERO);
        kr + (Vec3::ONE - kr) * (rest * rest * rest * rest * rest)
    }
}
