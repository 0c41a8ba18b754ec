// The direction and distance of a light, and the share of it that arrives. Stage 01.
#include <algorithm>

#include "functions.hpp"
#include "todo.hpp"

// Returns L, the unit vector from `point` to the light, and t_light, the distance to it; in world
// space. [rule 5]
//
// - A directional light stores the direction in which its light *travels*. L points the other way,
//   and t_light is infinite.
// - A light exactly at the point has no direction. The result is the zero vector and 0, so that it
//   adds nothing.
ToLight to_light(const Light& light, const Vec3& point) {
    if (light.kind == Light::Kind::Directional) {
        return {-light.direction, INFINITE};
    }
    const Vec3 way = light.position - point;
    return {normalized_or(way, {0.0, 0.0, 0.0}), length(way)};
}

// Returns A = min(1, 1 / (a r² + b r + c)), the share of the light that arrives at distance `r`.
// [rule 4]
//
// - `r` is at least 0. a, b, c are the light's `quadratic`, `linear` and `constant`; none is
//   negative, and not all are 0.
// - Light is never amplified: if the denominator is less than 1 (even 0), the result is 1.
// - A directional light does not weaken: the result is 1.
double distance_attenuation(const Light& light, double r) {
    if (light.kind == Light::Kind::Directional) {
        return 1.0;
    }
    const Attenuation& of = light.attenuation;
    return std::min(1.0, 1.0 / (of.quadratic * r * r + of.linear * r + of.constant));
}
