// The sphere. Stage 01.
#include <algorithm>
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Returns the nearest hit of `ray` with the sphere ‖X − `center`‖ = `radius`, or nothing. [rule 14]
//
// - `ray`, `center` and the hit are in the same frame. The ray's direction may have any length but
//   zero; it must *not* be normalised, because `t` must hold for the ray as given. [rule 20]
// - A root counts iff `ray.contains` it. The nearer one is tried first. If it does not count (it
//   lies behind, or the ray starts inside), the farther one is tried. [rule 2]
// - `normal` is a unit vector and points outwards, even if the ray starts inside. [rule 11]
// - A grazing ray (double root) is one hit.
std::optional<SurfaceHit> intersect_sphere(const Ray& ray, const Vec3& center, double radius) {
    // The roots of a t² + 2 half_b t + c.
    const Vec3 from_center = ray.origin - center;
    const double a = dot(ray.direction, ray.direction);
    const double half_b = dot(from_center, ray.direction);
    const double c = dot(from_center, from_center) - radius * radius;
    const double discriminant = half_b * half_b - a * c;
    if (discriminant < 0.0) {
        return std::nullopt;
    }
    // Only one of −b ± √D is computed, the one that does not cancel. The other root follows from
    // their product c / a.
    const double root = std::sqrt(discriminant);
    const double q = half_b < 0.0 ? root - half_b : -root - half_b;
    const double one = q / a, two = q == 0.0 ? one : c / q;
    for (const double t : {std::min(one, two), std::max(one, two)}) {
        if (ray.contains(t)) {
            return SurfaceHit{t, normalized(ray.at(t) - center)};
        }
    }
    return std::nullopt;
}
