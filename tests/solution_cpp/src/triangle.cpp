// The triangle. Stage 01.
#include "functions.hpp"
#include "todo.hpp"

// Returns the hit of `ray` with the triangle `a`, `b`, `c`, or nothing. [rule 16]
//
// - Corners, ray and hit are in the same frame. The direction may have any length but zero and
//   must not be normalised. [rule 20]
// - `normal` is the unit vector along (B − A) × (C − A), whichever side the ray comes from: both
//   sides can be hit. [rule 11]
// - Edges and corners belong to the triangle.
// - A triangle without area is never hit, and neither is one that the ray is parallel to. Both are
//   decided by an exact 0: a tiny triangle is still a triangle.
// - t counts iff `ray.contains` it. [rule 2]
std::optional<SurfaceHit> intersect_triangle(const Ray& ray, const Vec3& a, const Vec3& b,
                                             const Vec3& c) {
    const Vec3 n = cross(b - a, c - a);
    const double n_dot_d = dot(n, ray.direction);
    if (n_dot_d == 0.0) {
        return std::nullopt;
    }
    const double t = dot(n, a - ray.origin) / n_dot_d;
    if (!ray.contains(t)) {
        return std::nullopt;
    }
    // Q is inside if it lies to the left of all three edges, seen from the side to which N points.
    const Vec3 q = ray.at(t);
    const auto is_left_of = [&](const Vec3& from, const Vec3& to) {
        return dot(cross(to - from, q - from), n) >= 0.0;
    };
    if (!is_left_of(a, b) || !is_left_of(b, c) || !is_left_of(c, a)) {
        return std::nullopt;
    }
    return SurfaceHit{t, normalized(n)};
}
