// Cylinder and cone, which are not part of the assignment. Given: nothing to write here.
#pragma once

#include <optional>

#include "ray.hpp"
#include "scene.hpp"

// Returns the nearest hit with a cone, whose radius changes linearly from `bottom_radius` at
// `z_min` to `top_radius` at `z_max`. Discs close it if it is `capped`.
std::optional<SurfaceHit> intersect_cone(const Ray& ray, const Cone& cone);
