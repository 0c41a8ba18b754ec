//! Direct light: emission, ambient, diffuse and specular. Stage 01.

use cases::{Light, Material, Scene};
use glam::DVec3;

use crate::light::{distance_attenuation, to_light};
use crate::surface::Surface;
use crate::trace::unblocked_share;

/// Returns the normal turned against the ray, and whether the ray is inside the object. [rule 11]
///
/// - `direction` is the ray's, `normal` the outward unit normal, both in the same frame.
/// - The ray is inside, about to leave, iff d·N > 0. The normal is then negated. At d·N = 0 the ray
///   counts as outside.
pub fn facing_normal(direction: DVec3, normal: DVec3) -> (DVec3, bool) {
    let inside = direction.dot(normal) > 0.0;
    (if inside { -normal } else { normal }, inside)
}

/// Returns the ambient part of one light: ka Ia, multiplied by kt if the point is seen from
/// `inside` its object. [rule 3] [rule 12]
pub fn ambient(material: &Material, light: &Light, inside: bool) -> DVec3 {
    let outside = material.ka * light.ambient();
    if inside { material.kt * outside } else { outside }
}

/// Returns the diffuse and specular part of one light: `arriving` B [kd (N·L) + ks (N·H)₊^ns].
/// [rule 3]
///
/// - `arriving` is S A I, the light that arrives after shadows and distance.
/// - `normal` N is turned against the ray, `to_viewer` is −d, and `to_light` is L. They are unit
///   vectors in world space.
/// - B is 1 if N·L > 0, else 0: the light is then behind the surface, and there is no highlight
///   either.
/// - H is the unit vector along L + V (V = −d). If L + V = 0, there is no specular part.
/// - (N·H)₊ is N·H, or 0 if that is negative. A power 0⁰ is 1.
/// - `to_light` may be the zero vector (see the function `to_light`). The result is then black.
pub fn light_term(
    material: &Material,
    arriving: DVec3,
    normal: DVec3,
    to_viewer: DVec3,
    to_light: DVec3,
) -> DVec3 {
    let n_dot_l = normal.dot(to_light);
    if n_dot_l <= 0.0 {
        return DVec3::ZERO;
    }
    let diffuse = material.kd * n_dot_l;
    let specular = match (to_light + to_viewer).try_normalize() {
        Some(half) => material.ks * normal.dot(half).max(0.0).powf(material.ns),
        None => DVec3::ZERO,
    };
    arriving * (diffuse + specular)
}

/// Returns the light that the surface sends to the viewer without further rays except shadow rays.
/// [rule 3]
///
/// - `at` is in world space. Use its normal `n_shading`, which is already turned against the ray.
///   The viewer lies along −d.
/// - The light is the sum of ke and, for each light of the scene, its ambient part and its diffuse
///   and specular part.
/// - The light that arrives is S A I: S is `unblocked_share(scene, light, point)`, which is 1 until
///   a scene has shadows (stage 02), A is `distance_attenuation`, and I is the light's colour.
pub fn shade(scene: &Scene, at: &Surface) -> DVec3 {
    let mut colour = at.material.ke;
    for light in &scene.lights {
        let (to_light, t_light) = to_light(light, at.point);
        let arriving = unblocked_share(scene, light, at.point)
            * distance_attenuation(light, t_light)
            * light.colour();
        colour += ambient(at.material, light, at.inside);
        colour += light_term(at.material, arriving, at.n_shading, -at.direction, to_light);
    }
    colour
}
