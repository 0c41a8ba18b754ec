// The plane and the square. Stage 01.
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Returns the hit of `ray` with the plane N·X = `k`, or nothing. [rule 15]
//
// - `normal` is N, a unit vector. It is also the normal of the hit, whichever side the ray comes
//   from. [rule 11]
// - The ray's direction may have any length but zero and must not be normalised. [rule 20]
// - t counts iff `ray.contains` it. [rule 2]
// - If N·d = 0, the ray is parallel and misses, even if it lies in the plane. Only an exact 0 is
//   parallel: a nearly parallel ray hits far away.
std::optional<SurfaceHit> intersect_plane(const Ray& ray, const Vec3& normal, double k) {
    const double n_dot_d = dot(normal, ray.direction);
    if (n_dot_d == 0.0) {
        return std::nullopt;
    }
    const double t = (k - dot(normal, ray.origin)) / n_dot_d;
    if (!ray.contains(t)) {
        return std::nullopt;
    }
    return SurfaceHit{t, normal};
}

// Returns the hit of `ray` with the unit square |x| ≤ 0.5, |y| ≤ 0.5, z = 0, or nothing. [rule 15]
//
// - The ray and the hit are in the square's frame. The direction may have any length but zero.
//   [rule 20]
// - The edges belong to the square. A ray in the plane of the square misses it.
// - The normal is (0, 0, 1), whichever side the ray comes from. [rule 11]
std::optional<SurfaceHit> intersect_square(const Ray& ray) {
    const std::optional<SurfaceHit> hit = intersect_plane(ray, {0.0, 0.0, 1.0}, 0.0);
    if (!hit) {
        return std::nullopt;
    }
    const Vec3 q = ray.at(hit->t);
    if (std::abs(q.x) > 0.5 || std::abs(q.y) > 0.5) {
        return std::nullopt;
    }
    return hit;
}
