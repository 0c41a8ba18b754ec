// One object: takes the ray to object space, intersects it with the object's shape, and brings the
// hit back. Given: nothing to write here.
#pragma once

#include <cstddef>
#include <optional>

#include "ray.hpp"
#include "scene.hpp"

// Returns the nearest hit of `ray` with the object of that index, or nothing, all in world space.
std::optional<Hit> intersect_object(const Scene& scene, std::size_t index, const Ray& ray);

// Returns the nearest hit of a world-space `ray` with an `object` that is no mesh, or nothing.
std::optional<SurfaceHit> intersect_transformed(const Object& object, const Ray& ray);
