// The recursion: adds up the light that comes from a surface, from its mirror image and from behind
// it. Given: nothing to write here.
#pragma once

#include "ray.hpp"
#include "ray_tree.hpp"
#include "scene.hpp"
#include "vec.hpp"

// The path that led to a ray.
struct Path {
    RayKind kind = RayKind::Eye;
    // Number of rays before it; the eye ray has depth 0. [rule 13]
    unsigned depth = 0;
    // Product of the kr and kt along the path: the factor with which the ray's light enters the
    // pixel. [rule 13]
    Vec3 weight = WHITE;

    // Returns the path of a ray that this one spawns. Its light is multiplied by `factor` (kr or
    // kt).
    Path extended(RayKind spawned, const Vec3& factor) const {
        return {spawned, depth + 1, weight * factor};
    }
};

// Returns the colour along `ray`: that of the nearest surface, or the background. [rule 2]
Vec3 trace(const Scene& scene, const Ray& ray, const Path& path);

// Returns S, the share of `light` that reaches `point`; all of it in a scene that simulates no
// shadows. [rule 5] [rule 6]
Vec3 unblocked_share(const Scene& scene, const Light& light, const Vec3& point);
