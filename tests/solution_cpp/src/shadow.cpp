// Shadow rays. Stage 02.
#include "functions.hpp"
#include "object.hpp"
#include "todo.hpp"

// Returns S, the share of `light` that reaches `point`, as a colour. It is (1, 1, 1) if nothing is
// in the way, and black behind an opaque object. [rule 5] [rule 6]
//
// - `point` is in world space, on a surface. The shadow ray starts there, and must not hit that
//   surface at t = 0. [rule 21]
// - Only objects in between count: RAY_EPSILON < t < t_light, which is infinite for a directional
//   light. `Ray::until` gives this interval.
// - Each time the ray crosses a surface, S is multiplied by the kt of that object's material: once
//   through a glass pane, twice through a solid glass ball, wherever the light comes from.
// - A scene whose effects lack `tinted_shadows` has no coloured light of this kind: every surface
//   blocks. `scene.effects.has(Effect::TintedShadows)` says which.
Vec3 shadow_attenuation(const Scene& scene, const Light& light, const Vec3& point) {
    const bool tinted = scene.effects.has(Effect::TintedShadows);
    const ToLight to = to_light(light, point);
    if (to.t == 0.0) {
        return WHITE;
    }
    Vec3 share = WHITE;
    for (std::size_t index = 0; index < scene.objects.size(); ++index) {
        const Vec3 kt = tinted ? scene.materials[scene.objects[index].material].kt : BLACK;
        Ray ray = Ray::until(point, to.direction, to.t);
        while (share != BLACK) {
            const std::optional<Hit> hit = intersect_object(scene, index, ray);
            if (!hit) {
                break;
            }
            share *= kt;
            // The interval is open: this excludes the hit that was just found, and nothing else.
            ray.t_min = hit->t;
        }
    }
    return share;
}
