// The recursion. Only the effects that the scene lists are simulated, so a scene without mirrors
// never calls the functions of that stage. Given: nothing to write here.
#include "trace.hpp"

#include "functions.hpp"

namespace {

// Returns whether a ray of this kind is simulated, adds any light, and may still be cast. [rule 13]
bool spawns(const Scene& scene, Effect effect, const Vec3& factor, const Path& path) {
    const bool is_adaptive = scene.effects.has(Effect::AdaptiveDepth);
    const double threshold = is_adaptive ? scene.render.threshold : 0.0;
    return scene.effects.has(effect) && max_component(factor) > 0.0 &&
           goes_on(path.depth, scene.render.max_depth, path.weight, threshold);
}

// Returns the direct light at `hit`, and the light of the rays that it spawns. [rule 3] [rule 7]
// [rule 8]
Vec3 light_from(const Scene& scene, const Ray& ray, const Hit& hit, const Path& path) {
    const Surface at = surface_at(scene, ray, hit);
    const Vec3 direct = shade(scene, at);
    if (ray_tree::is_recording()) {
        const std::string& name = scene.objects[hit.object].name;
        ray_tree::hit({name, hit.t, at.point, at.n_shading, at.inside, direct});
    }
    Vec3 colour = direct;
    if (spawns(scene, Effect::Reflection, at.material.kr, path)) {
        colour += reflected_light(scene, at, path);
    }
    if (spawns(scene, Effect::Refraction, at.material.kt, path)) {
        colour += refracted_light(scene, at, path);
    }
    return colour;
}

}  // namespace

Vec3 trace(const Scene& scene, const Ray& ray, const Path& path) {
    ray_tree::enter(path.kind, path.depth, ray);
    const std::optional<Hit> hit = nearest_hit(scene, ray);
    return ray_tree::leave(hit ? light_from(scene, ray, *hit, path) : scene.background);
}

Vec3 unblocked_share(const Scene& scene, const Light& light, const Vec3& point) {
    return scene.effects.has(Effect::Shadows) ? shadow_attenuation(scene, light, point) : WHITE;
}
