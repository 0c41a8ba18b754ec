//! The recursion: adds up the light that comes from a surface, from its mirror image and from
//! behind it. Given: nothing to write here.
//!
//! Only the effects that the scene lists are simulated, so a scene without mirrors never calls the
//! functions of that stage.

use cases::ray_tree::{self, Met, RayKind};
use cases::{Effect, Hit, Light, Ray, Scene};
use glam::DVec3;

use crate::nearest::nearest_hit;
use crate::reflection::{goes_on, reflected_light};
use crate::refraction::refracted_light;
use crate::shade::shade;
use crate::shadow::shadow_attenuation;
use crate::surface::Surface;

/// The path that led to a ray.
#[derive(Clone, Copy)]
pub struct Path {
    /// The kind of the ray.
    pub kind: RayKind,
    /// Number of rays before it; the eye ray has depth 0. [rule 13]
    pub depth: u32,
    /// Product of the kr and kt along the path: the factor with which the ray's light enters the
    /// pixel. [rule 13]
    pub weight: DVec3,
}

impl Path {
    /// The path of an eye ray.
    pub const EYE: Self = Self { kind: RayKind::Eye, depth: 0, weight: DVec3::ONE };

    /// Returns the path of a ray that this one spawns. Its light is multiplied by `factor` (kr or
    /// kt).
    pub fn extended(&self, kind: RayKind, factor: DVec3) -> Self {
        Self { kind, depth: self.depth + 1, weight: self.weight * factor }
    }
}

/// Returns the colour along `ray`: that of the nearest surface, or the background. [rule 2]
pub fn trace(scene: &Scene, ray: &Ray, path: &Path) -> DVec3 {
    ray_tree::enter(path.kind, path.depth, ray);
    let colour = match nearest_hit(scene, ray) {
        Some(hit) => light_from(scene, ray, &hit, path),
        None => scene.background,
    };
    ray_tree::leave(colour)
}

/// Returns the direct light at `hit`, and the light of the rays that it spawns. [rule 3] [rule 7]
/// [rule 8]
fn light_from(scene: &Scene, ray: &Ray, hit: &Hit, path: &Path) -> DVec3 {
    let at = Surface::new(scene, ray, hit);
    let direct = shade(scene, &at);
    ray_tree::hit(|| met(scene, hit, &at, direct));
    let mut colour = direct;
    if spawns(scene, Effect::Reflection, at.material.kr, path) {
        colour += reflected_light(scene, &at, path);
    }
    if spawns(scene, Effect::Refraction, at.material.kt, path) {
        colour += refracted_light(scene, &at, path);
    }
    colour
}

/// Returns whether a ray of this kind is simulated, adds any light, and may still be cast.
/// [rule 13]
fn spawns(scene: &Scene, effect: Effect, factor: DVec3, path: &Path) -> bool {
    let threshold =
        if scene.effects.has(Effect::AdaptiveDepth) { scene.render.threshold } else { 0.0 };
    scene.effects.has(effect)
        && factor.max_element() > 0.0
        && goes_on(path.depth, scene.render.max_depth, path.weight, threshold)
}

/// Returns S_j, the share of `light` that reaches `point`; all of it in a scene that simulates no
/// shadows. [rule 5] [rule 6]
pub fn unblocked_share(scene: &Scene, light: &Light, point: DVec3) -> DVec3 {
    if scene.effects.has(Effect::Shadows) {
        shadow_attenuation(scene, light, point)
    } else {
        DVec3::ONE
    }
}

fn met(scene: &Scene, hit: &Hit, at: &Surface, direct: DVec3) -> Met {
    Met {
        object: scene.objects[hit.object].name.clone(),
        t: hit.t,
        point: at.point,
        normal: at.n_shading,
        inside: at.inside,
        direct,
    }
}
