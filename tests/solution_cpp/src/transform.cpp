// Between world space and an object's own space. Stage 05.
#include "functions.hpp"
#include "todo.hpp"

// Returns the same ray in object space. [rule 20]
//
// - `ray` is in world space, `object_from_world` is M⁻¹.
// - The origin is a point and moves with the translation; the direction is a vector and does not.
// - The direction is *not* normalised, and the interval stays as it is, so that t means the same
//   point in both spaces.
Ray ray_to_object(const Ray& ray, const Affine& object_from_world) {
    const Mat3& linear = object_from_world.linear;
    const Vec3 origin = linear * ray.origin + object_from_world.translation;
    return {origin, linear * ray.direction, ray.t_min, ray.t_max};
}

// Returns the world-space normal N along A⁻ᵀ N′, a unit vector. [rule 20]
//
// - `normal` is N′, a unit normal in object space; `object_from_world` is M⁻¹, whose linear part
//   is A⁻¹.
// - A N′ would be right for rotations and uniform scaling only.
// - An outward normal stays outward, even if M mirrors.
Vec3 normal_to_world(const Vec3& normal, const Affine& object_from_world) {
    return normalized(transposed(object_from_world.linear) * normal);
}
