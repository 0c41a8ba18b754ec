// Direct light: emission, ambient, diffuse and specular. Stage 01.
#include <algorithm>
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Returns the normal turned against the ray, and whether the ray is inside the object. [rule 11]
//
// - `direction` is the ray's, `normal` the outward unit normal, both in the same frame.
// - The ray is inside, about to leave, iff d·N > 0. The normal is then negated. At d·N = 0 the ray
//   counts as outside.
Facing facing_normal(const Vec3& direction, const Vec3& normal) {
    const bool inside = dot(direction, normal) > 0.0;
    return {inside ? -normal : normal, inside};
}

// Returns the ambient part of one light: ka Ia, multiplied by kt if the point is seen from
// `inside` its object. [rule 3] [rule 12]
Vec3 ambient(const Material& material, const Light& light, bool inside) {
    const Vec3 outside = material.ka * light.ambient;
    return inside ? material.kt * outside : outside;
}

// Returns the diffuse and specular part of one light: `arriving` B [kd (N·L) + ks (N·H)₊^ns].
// [rule 3]
//
// - `arriving` is S A I, the light that arrives after shadows and distance.
// - `normal` N is turned against the ray, `to_viewer` is −d, and `to_light` is L. They are unit
//   vectors in world space.
// - B is 1 if N·L > 0, else 0: the light is then behind the surface, and there is no highlight
//   either.
// - H is the unit vector along L + V (V = −d). If L + V = 0, there is no specular part.
// - (N·H)₊ is N·H, or 0 if that is negative. A power 0⁰ is 1.
// - `to_light` may be the zero vector (see the function `to_light`). The result is then black.
Vec3 light_term(const Material& material, const Vec3& arriving, const Vec3& normal,
                const Vec3& to_viewer, const Vec3& to_light) {
    const double n_dot_l = dot(normal, to_light);
    if (n_dot_l <= 0.0) {
        return BLACK;
    }
    Vec3 share = material.kd * n_dot_l;
    const Vec3 between = to_light + to_viewer;
    if (length(between) > 0.0) {
        const double n_dot_h = dot(normal, normalized(between));
        share += material.ks * std::pow(std::max(n_dot_h, 0.0), material.ns);
    }
    return arriving * share;
}

// Returns the light that the surface sends to the viewer without further rays except shadow rays.
// [rule 3]
//
// - `at` is in world space. Use its normal `n_shading`, which is already turned against the ray.
//   The viewer lies along −d.
// - The light is the sum of ke and, for each light of the scene, its ambient part and its diffuse
//   and specular part.
// - The light that arrives is S A I: S is `unblocked_share(scene, light, point)`, which is 1 until
//   a scene has shadows (stage 02), A is `distance_attenuation`, and I is the light's colour.
Vec3 shade(const Scene& scene, const Surface& at) {
    Vec3 colour = at.material.ke;
    for (const Light& light : scene.lights) {
        const ToLight to = to_light(light, at.point);
        const Vec3 arriving = unblocked_share(scene, light, at.point) *
                              distance_attenuation(light, to.t) * light.colour;
        colour += ambient(at.material, light, at.inside);
        colour += light_term(at.material, arriving, at.n_shading, -at.direction, to.direction);
    }
    return colour;
}
