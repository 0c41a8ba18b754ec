// The box. Stage 01.
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Returns the nearest hit of `ray` with the surface of the box `min` ≤ X ≤ `max`, or nothing.
// [rule 15]
//
// - `ray`, corners and hit are in the same frame. The direction may have any length but zero and
//   must not be normalised; some of its components may be 0. [rule 20]
// - A ray that starts inside hits the side through which it leaves. [rule 2]
// - The sides belong to the box: a ray that runs within a side hits the box where it reaches the
//   side.
// - `normal` is one of ±x, ±y, ±z and points outwards, even if the ray starts inside. [rule 11]
std::optional<SurfaceHit> intersect_box(const Ray& ray, const Vec3& min, const Vec3& max) {
    // The ray is in the box while it is between the two sides of each of the three pairs: from the
    // last entry to the first exit.
    const Vec3 axes[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double entry = -INFINITE, exit = INFINITE;
    Vec3 entry_normal, exit_normal;
    for (int axis = 0; axis < 3; ++axis) {
        const double p = ray.origin[axis], d = ray.direction[axis];
        if (d == 0.0) {
            if (p < min[axis] || max[axis] < p) {
                return std::nullopt;
            }
            continue;
        }
        const double near = ((d > 0.0 ? min : max)[axis] - p) / d;
        const double far = ((d > 0.0 ? max : min)[axis] - p) / d;
        const Vec3 along = d > 0.0 ? axes[axis] : -axes[axis];
        if (near > entry) {
            entry = near;
            entry_normal = -along;
        }
        if (far < exit) {
            exit = far;
            exit_normal = along;
        }
    }
    if (entry > exit) {
        return std::nullopt;
    }
    if (ray.contains(entry)) {
        return SurfaceHit{entry, entry_normal};
    }
    if (ray.contains(exit)) {
        return SurfaceHit{exit, exit_normal};
    }
    return std::nullopt;
}
