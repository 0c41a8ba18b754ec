// Rays and hits. Given: nothing to write here.
#pragma once

#include <cstddef>
#include <limits>

#include "vec.hpp"

// Lower end of a ray's interval. An intersection at this parameter or below does not count, because
// a new ray starts on a surface only up to rounding. [rule 2] [rule 21]
constexpr double RAY_EPSILON = 1e-6;

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// A ray r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]
//
// Eye, shadow, reflected and refracted rays have unit directions. In object space, the direction of
// a ray has the length that the matrix gives it. [rule 20]
//
// `Ray{origin, direction}` is the ray over RAY_EPSILON < t < ∞.
struct Ray {
    Vec3 origin;
    // The direction, which is never the zero vector.
    Vec3 direction;
    // Open lower end of the interval.
    double t_min = RAY_EPSILON;
    // Open upper end of the interval; may be infinite.
    double t_max = INFINITE;

    // Returns the ray over RAY_EPSILON < t < `t_max`, such as a shadow ray to its light. [rule 5]
    static Ray until(const Vec3& origin, const Vec3& direction, double t_max) {
        return {origin, direction, RAY_EPSILON, t_max};
    }

    // Returns the point at parameter `t`.
    Vec3 at(double t) const { return origin + t * direction; }

    // Returns whether a hit at `t` counts: strictly inside the interval; never for NaN. [rule 2]
    bool contains(double t) const { return t_min < t && t < t_max; }
};

// The intersection of a ray with a single shape, in the frame of the ray. A miss is an empty
// std::optional.
struct SurfaceHit {
    // Parameter along the ray as given, whose direction is not normalised. [rule 20]
    double t = 0.0;
    // Unit normal, which points outwards even if the ray comes from inside. [rule 11]
    Vec3 normal;
};

// The nearest hit of a ray in a scene, in world space. A miss is an empty std::optional.
struct Hit {
    // Parameter along the ray.
    double t = 0.0;
    // The point of the hit.
    Vec3 point;
    // Outward unit normal of the surface itself. [rule 19]
    Vec3 n_geom;
    // Unit normal for shading: interpolated on a mesh that has vertex normals, else `n_geom`.
    // [rule 18]
    Vec3 n_shading;
    // Index into the objects of the scene.
    std::size_t object = 0;
};
