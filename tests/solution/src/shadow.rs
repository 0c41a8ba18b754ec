//! Shadow rays. Stage 02.

use cases::{Effect, Light, Ray, Scene};
use glam::DVec3;

use crate::light::to_light;
use crate::object::intersect_object;

/// Returns S, the share of `light` that reaches `point`, as a colour. It is (1, 1, 1) if nothing is
/// in the way, and black behind an opaque object. [rule 5] [rule 6]
///
/// - `point` is in world space, on a surface. The shadow ray starts there, and must not hit that
///   surface at t = 0. [rule 21]
/// - Only objects in between count: RAY_EPSILON < t < t_light, which is infinite for a directional
///   light. `Ray::until` gives this interval.
/// - Each time the ray crosses a surface, S is multiplied by the kt of that object's material: once
///   through a glass pane, twice through a solid glass ball, wherever the light comes from.
/// - A scene whose effects lack `tinted_shadows` has no coloured light of this kind: every surface
///   blocks.
pub fn shadow_attenuation(scene: &Scene, light: &Light, point: DVec3) -> DVec3 {
    let tinted = scene.effects.has(Effect::TintedShadows);
    let (direction, t_light) = to_light(light, point);
    if t_light == 0.0 {
        return DVec3::ONE;
    }
    let mut share = DVec3::ONE;
    for (index, object) in scene.objects.iter().enumerate() {
        let kt = if tinted { scene.materials[object.material].kt } else { DVec3::ZERO };
        let mut ray = Ray::until(point, direction, t_light);
        while share != DVec3::ZERO
            && let Some(hit) = intersect_object(scene, index, &ray)
        {
            share *= kt;
            // The interval is open: this excludes the hit that was just found, and nothing else.
            ray.t_min = hit.t;
        }
    }
    share
}
