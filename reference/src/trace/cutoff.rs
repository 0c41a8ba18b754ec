//! Bounds on how much darker a picture is because some rays are not cast. [rule 13]
//!
//! For each surface i, let Lᵢ be the greatest light that its points can emit or reflect directly,
//! and ρᵢ its kr + kt. Let L be the greatest Lᵢ or the background, whichever is more, and ρ the
//! greatest ρᵢ. All of this holds channel by channel, except for rounding.
//!
//! **What a ray returns.** Let B be the least number that is at least the background and satisfies
//! Lᵢ + ρᵢ B ≤ B for every surface. Then no ray returns more than B, whatever the depth. The proof
//! is by induction over the depth that is left. A ray that spawns no rays returns the background or
//! at most Lᵢ ≤ B. Any other ray returns at most Lᵢ + ρᵢ B ≤ B, because its spawned rays return at
//! most B.
//!
//! - Where ρᵢ < 1, the condition is B ≥ Lᵢ / (1 − ρᵢ).
//! - Where ρᵢ = 1 and Lᵢ = 0, such as for a perfect mirror or clear glass, it is true for every B:
//!   the surface returns a mean of what its rays return, and no mean exceeds the greatest term.
//! - Where ρᵢ = 1 and Lᵢ > 0, or ρᵢ > 1, no B satisfies it: light can grow with each level.
//!
//! **What rays left out are worth.** Rays that are left out, with weights (the products of kr and
//! kt along their paths) that add up to w, make a pixel at most w B darker. The weights of all rays
//! of depth n add up to at most ρⁿ, and rays of depth `max_depth` + 1 are the first that are left
//! out.
//! For ρ = 1 this bound does not fall with the depth, but it is finite where B is.
//!
//! **What the next levels are worth.** Where B is infinite, a deeper picture still has a bound.
//! Following the left-out rays through n more levels adds at most w ρᵏ L on the k-th of them, for k
//! from 0 to n − 1, and so at most w L (1 + ρ + … + ρⁿ⁻¹), which is n w L for ρ = 1. A mirror with
//! kr = 1 that glows shows that no less will do: each level adds its glow once more.

use cases::glam::DVec3;
use cases::{Effect, Effects, Light, Material, Scene};

use crate::rules::{Attenuation, Rules};
use crate::trace::render::Stats;

/// The bounds L, ρ and B of a scene, channel by channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// L: the greatest light of a point without spawned rays, or of the background. It is infinite
    /// where a light may grow without bound, or where some kt is above 1.
    pub own: DVec3,
    /// ρ: the greatest kr + kt.
    pub sent_on: DVec3,
    /// B: the most that a ray returns at any depth. It is infinite where light can grow with each
    /// level.
    pub light: DVec3,
}

impl Limits {
    /// Returns the bounds of a scene by rules that a course may choose, where `effects` are
    /// simulated. Materials that no object uses do not count.
    pub fn of(scene: &Scene, rules: &Rules, effects: Effects) -> Self {
        let used = || scene.objects.iter().map(|object| &scene.materials[object.material]);
        let surfaces = || used().map(|one| (own_light(scene, rules, one), sent_on(one, effects)));
        let own = surfaces().map(|(own, _)| own).fold(scene.background, DVec3::max);
        let most_sent_on = surfaces().map(|(_, sent_on)| sent_on).fold(DVec3::ZERO, DVec3::max);
        let light = surfaces().map(kept).fold(scene.background, DVec3::max);
        let amplifies =
            used().fold(DVec3::ZERO, |most, material| most.max(material.kt)).cmpgt(DVec3::ONE);
        let unless_amplified = |bound| DVec3::select(amplifies, DVec3::INFINITY, bound);
        Self { own: unless_amplified(own), sent_on: most_sent_on, light: unless_amplified(light) }
    }

    /// Returns the most by which a pixel is darker without rays of this weight: weight · B. The
    /// weight is the mean over the eye rays of the pixel.
    pub fn of_weight(&self, weight: DVec3) -> DVec3 {
        product(weight, self.light)
    }

    /// Returns the most by which a pixel of a picture with these figures is darker for rays and
    /// light that were left out; `None` if there is no bound.
    pub fn of_picture(&self, stats: &Stats) -> Option<f64> {
        let most = self.of_weight(stats.left_out.into()) + DVec3::from(stats.faint_light);
        Some(most.max_element()).filter(|most| most.is_finite())
    }

    /// Returns the most by which a pixel gets brighter where rays of this weight, which were left
    /// out, are followed through `n` more levels: weight · min(B, L (1 + ρ + … + ρⁿ⁻¹)).
    pub fn of_levels(&self, weight: DVec3, n: u32) -> DVec3 {
        let sum = |rho: f64| {
            let n = f64::from(n);
            if rho == 1.0 { n } else { (cases::maths::pow(rho, n) - 1.0) / (rho - 1.0) }
        };
        let levels = DVec3::from_array(self.sent_on.to_array().map(sum));
        product(weight, self.light.min(product(levels, self.own)))
    }

    /// Returns the most by which limiting the depth of a picture to `max_depth` darkens it:
    /// ρ^(max_depth + 1) · B.
    pub fn of_depth(&self, max_depth: u32) -> DVec3 {
        let power = |rho: f64| cases::maths::pow(rho, f64::from(max_depth) + 1.0);
        self.of_weight(DVec3::from_array(self.sent_on.to_array().map(power)))
    }
}

/// Returns the product, in which 0 times infinity is 0.
fn product(a: DVec3, b: DVec3) -> DVec3 {
    let is_zero = a.cmpeq(DVec3::ZERO) | b.cmpeq(DVec3::ZERO);
    DVec3::select(is_zero, DVec3::ZERO, a * b)
}

/// Returns the least B with own + sent_on · B ≤ B, which is infinite if there is none.
fn kept((own, sent_on): (DVec3, DVec3)) -> DVec3 {
    let fades = sent_on.cmplt(DVec3::ONE);
    let only_passes_on = sent_on.cmpeq(DVec3::ONE) & own.cmpeq(DVec3::ZERO);
    let endless = DVec3::select(only_passes_on, DVec3::ZERO, DVec3::INFINITY);
    DVec3::select(fades, own / (DVec3::ONE - sent_on), endless)
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
