// Light through glass and water. Stage 04.
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Index of refraction of the air around every object. [rule 9]
constexpr double AIR_INDEX = 1.0003;

// Returns (η_i, η_t): the index on the side of the ray, and on the other side. [rule 9]
//
// - A ray that enters comes from air and goes into a material of that `index`. A ray that leaves
//   (`inside`) goes the other way.
Indices indices(bool inside, double index) {
    return inside ? Indices{index, AIR_INDEX} : Indices{AIR_INDEX, index};
}

// Returns T, the direction of the refracted ray, a unit vector, or nothing for total internal
// reflection. [rule 8] [rule 10]
//
// - `direction` d and `normal` N are unit vectors in the same frame; d points towards the surface,
//   and N is turned against it (d·N ≤ 0).
// - η_i sin θ_i = η_t sin θ_t; T lies in the plane of d and N, on the other side of the surface.
// - No ray is transmitted beyond the critical angle; exactly at it one is, along the surface.
// - If both indices are equal, T = d.
std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double eta_i, double eta_t) {
    const double eta_ratio = eta_i / eta_t;
    const double cos_i = -dot(direction, normal);
    const double cos_t_squared = 1.0 - eta_ratio * eta_ratio * (1.0 - cos_i * cos_i);
    if (cos_t_squared < 0.0) {
        return std::nullopt;
    }
    return eta_ratio * direction + (eta_ratio * cos_i - std::sqrt(cos_t_squared)) * normal;
}

// Returns the light that comes through the surface to the viewer: kt · trace(Q, T), or black if no
// ray is transmitted. [rule 8]
//
// - `at` is in world space: its point is Q, `at.inside` says on which side the ray is, and
//   `at.refracted_direction(eta_i, eta_t)` is T. Products are channel by channel.
// - `path` is that of the ray that hit the surface; the refracted ray's is
//   `path.extended(RayKind::Refracted, kt)`.
// - The function is called only if kt is not black and the ray `goes_on`.
Vec3 refracted_light(const Scene& scene, const Surface& at, const Path& path) {
    const Vec3& kt = at.material.kt;
    const Indices eta = indices(at.inside, at.material.index);
    const std::optional<Vec3> direction = at.refracted_direction(eta.eta_i, eta.eta_t);
    if (!direction) {
        return BLACK;
    }
    const Ray ray{at.point, *direction};
    return kt * trace(scene, ray, path.extended(RayKind::Refracted, kt));
}
