//! How far a ray that is not cast can matter. [rule 13]
//!
//! Let L be the greatest light that a point can send out by itself or that comes from the
//! background, and ρ the greatest kr + kt of any surface. What a ray brings back is at most L + ρ
//! (L + ρ (L + …)) = L / (1 − ρ) for ρ < 1, so that leaving out rays whose weights (the products of
//! kr and kt along their paths) sum up to w makes a pixel at most w L / (1 − ρ) darker. The weights
//! of all rays of depth n sum up to ρⁿ at most, and those of depth max_depth + 1 are the first that
//! are left out. All of it holds channel by channel, and but for rounding. Where ρ ≥ 1 energy need
//! not fade, and there is no bound.

use cases::glam::DVec3;
use cases::{Effect, Effects, Light, Material, Scene};

use crate::rules::{Attenuation, Rules};

/// L and ρ of a scene, channel by channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// L: the greatest light of a point by itself or of the background; infinite where a light may
    /// grow without end.
    pub own: DVec3,
    /// ρ: the greatest kr + kt.
    pub sent_on: DVec3,
}

impl Limits {
    /// Those of a scene by rules that a course may choose, where `effects` are simulated. What no
    /// object is made of does not count.
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

    /// L / (1 − ρ): no ray brings back more.
    pub fn light(&self) -> DVec3 {
        let finite = self.own / (DVec3::ONE - self.sent_on);
        DVec3::select(self.sent_on.cmplt(DVec3::ONE), finite, DVec3::INFINITY)
    }

    /// By how much a pixel can be darker that has left out rays of this weight, the mean over the
    /// rays of the pixel: weight · L / (1 − ρ).
    pub fn of_weight(&self, weight: DVec3) -> DVec3 {
        DVec3::select(weight.cmpeq(DVec3::ZERO), DVec3::ZERO, weight * self.light())
    }

    /// By how much a picture of this greatest depth can be darker than one without end:
    /// ρ^(max_depth + 1) · L / (1 − ρ).
    pub fn of_depth(&self, max_depth: u32) -> DVec3 {
        let power = |rho: f64| cases::maths::pow(rho, f64::from(max_depth) + 1.0);
        self.of_weight(DVec3::from_array(self.sent_on.to_array().map(power)))
    }
}

/// ke + Σ_j (ka Ia_j + I_j (kd + ks)): cosines, shadows and attenuation are 1 at most. [rule 3]
/// [rule 4]
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
