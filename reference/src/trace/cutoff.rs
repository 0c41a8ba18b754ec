//! Bounds on how much darker a picture is because some rays are not cast. [rule 13]
//!
//! Let L be the greatest light that a point can emit or reflect directly, or that comes from the
//! background, and ρ the greatest kr + kt of any surface. A ray returns at most L + ρ (L + ρ (L +
//! …)) = L / (1 − ρ) for ρ < 1. Leaving out rays whose weights (the products of kr and kt along
//! their paths) add up to w therefore makes a pixel at most w L / (1 − ρ) darker. The weights of
//! all rays of depth n add up to at most ρⁿ, and rays of depth max_depth + 1 are the first that are
//! left out. All of this holds channel by channel, except for rounding. Where ρ ≥ 1 energy need not
//! fade, and there is no bound.

use cases::glam::DVec3;
use cases::{Effect, Effects, Light, Material, Scene};

use crate::rules::{Attenuation, Rules};

/// The bounds L and ρ of a scene, channel by channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// L: the greatest light of a point without spawned rays, or of the background. It is infinite
    /// where a light may grow without bound, or where some kt is above 1.
    pub own: DVec3,
    /// ρ: the greatest kr + kt.
    pub sent_on: DVec3,
}

impl Limits {
    /// Returns the bounds of a scene by rules that a course may choose, where `effects` are
    /// simulated. Materials that no object uses do not count.
    pub fn of(scene: &Scene, rules: &Rules, effects: Effects) -> Self {
        let used = || scene.objects.iter().map(|object| &scene.materials[object.material]);
        let own = used()
            .map(|material| own_light(scene, rules, material))
            .fold(scene.background, DVec3::max);
        let sent_on =
            used().map(|material| sent_on(material, effects)).fold(DVec3::ZERO, DVec3::max);
        let amplifies =
            used().fold(DVec3::ZERO, |most, material| most.max(material.kt)).cmpgt(DVec3::ONE);
        Self { own: DVec3::select(amplifies, DVec3::INFINITY, own), sent_on }
    }

    /// Returns L / (1 − ρ), the most that a ray returns; infinite where ρ ≥ 1.
    pub fn light(&self) -> DVec3 {
        let finite = self.own / (DVec3::ONE - self.sent_on);
        DVec3::select(self.sent_on.cmplt(DVec3::ONE), finite, DVec3::INFINITY)
    }

    /// Returns the most by which a pixel is darker without rays of this weight: weight · L / (1 −
    /// ρ). The weight is the mean over the eye rays of the pixel.
    pub fn of_weight(&self, weight: DVec3) -> DVec3 {
        DVec3::select(weight.cmpeq(DVec3::ZERO), DVec3::ZERO, weight * self.light())
    }

    /// Returns the most by which limiting the depth of a picture to `max_depth` darkens it:
    /// ρ^(max_depth + 1) · L / (1 − ρ).
    pub fn of_depth(&self, max_depth: u32) -> DVec3 {
        let power = |rho: f64| cases::maths::pow(rho, f64::from(max_depth) + 1.0);
        self.of_weight(DVec3::from_array(self.sent_on.to_array().map(power)))
    }
}

/// Returns ke + Σ_j (ka Ia_j + I_j (kd + ks)), since cosines, shadows and attenuation are at most
/// 1. [rule 3] [rule 4]
fn own_light(scene: &Scene, rules: &Rules, material: &Material) -> DVec3 {
    let of_light = |light: &Light| {
        let has_limit = matches!(rules.attenuation, Attenuation::Clamped | Attenuation::Absent);
        let grows = !has_limit && matches!(light, Light::Point { .. });
        let direct = light.colour() * (material.kd + material.ks);
        let direct = if grows {
            DVec3::select(direct.cmpgt(DVec3::ZERO), DVec3::INFINITY, direct)
        } else {
            direct
        };
        material.ka * light.ambient() + direct
    };
    material.ke + scene.lights.iter().map(of_light).sum::<DVec3>()
}

fn sent_on(material: &Material, effects: Effects) -> DVec3 {
    let part = |effect, colour| if effects.has(effect) { colour } else { DVec3::ZERO };
    part(Effect::Reflection, material.kr) + part(Effect::Refraction, material.kt)
}
