// Cylinder and cone, which are not part of the assignment. Given: nothing to write here.
#include "round.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

// Returns the roots of a t² + 2 `half_b` t + c, the lesser first. They are infinite if there are
// none, so that they lie in no interval.
//
// The root that would cancel is computed from the product of the two, which is c / a.
std::pair<double, double> roots(double a, double half_b, double c) {
    const double discriminant = half_b * half_b - a * c;
    if (discriminant < 0.0) {
        return {INFINITE, INFINITE};
    }
    const double root = std::sqrt(discriminant);
    const double q = half_b < 0.0 ? root - half_b : -root - half_b;
    const auto finite = [](double t) { return std::isnan(t) ? INFINITE : t; };
    return std::minmax(finite(q / a), finite(c / q));
}

// Intersects x² + y² = (r₀ + slope · (z − z₀))², a quadratic equation in t.
std::optional<SurfaceHit> intersect_side(const Ray& ray, const Cone& cone) {
    const double slope = (cone.top_radius - cone.bottom_radius) / (cone.z_max - cone.z_min);
    const auto radius_at = [&](double z) { return cone.bottom_radius + slope * (z - cone.z_min); };
    const Vec3& p = ray.origin;
    const Vec3& d = ray.direction;
    const double r = radius_at(p.z), dr = slope * d.z;
    const auto [near, far] = roots(d.x * d.x + d.y * d.y - dr * dr, p.x * d.x + p.y * d.y - r * dr,
                                   p.x * p.x + p.y * p.y - r * r);
    for (const double t : {near, far}) {
        const Vec3 q = ray.at(t);
        if (ray.contains(t) && cone.z_min <= q.z && q.z <= cone.z_max) {
            const Vec3 tip = {0.0, 0.0, slope < 0.0 ? 1.0 : -1.0};
            return SurfaceHit{t, normalized_or({q.x, q.y, -slope * radius_at(q.z)}, tip)};
        }
    }
    return std::nullopt;
}

std::optional<SurfaceHit> intersect_cap(const Ray& ray, double radius, double z,
                                        const Vec3& normal) {
    const double t = (z - ray.origin.z) / ray.direction.z;
    const Vec3 q = ray.at(t);
    if (radius > 0.0 && ray.contains(t) && q.x * q.x + q.y * q.y <= radius * radius) {
        return SurfaceHit{t, normal};
    }
    return std::nullopt;
}

}  // namespace

std::optional<SurfaceHit> intersect_cone(const Ray& ray, const Cone& cone) {
    std::optional<SurfaceHit> nearest = intersect_side(ray, cone);
    if (!cone.capped) {
        return nearest;
    }
    for (const auto& cap : {intersect_cap(ray, cone.bottom_radius, cone.z_min, {0.0, 0.0, -1.0}),
                            intersect_cap(ray, cone.top_radius, cone.z_max, {0.0, 0.0, 1.0})}) {
        if (cap && (!nearest || cap->t < nearest->t)) {
            nearest = cap;
        }
    }
    return nearest;
}
