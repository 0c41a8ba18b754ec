// The surface that a ray hit, as shading and new rays need it. Given: nothing to write here.
#pragma once

#include <optional>

#include "ray.hpp"
#include "scene.hpp"
#include "vec.hpp"

// A point on an object, seen along a ray; all in world space.
struct Surface {
    // Q, the point where the ray hit the object.
    Vec3 point;
    // d, the unit vector along which the ray came; the viewer lies along −d.
    Vec3 direction;
    // Unit normal of the surface itself, turned against the ray. [rule 11]
    Vec3 n_geom;
    // Unit normal for shading, turned along with `n_geom`. It differs from `n_geom` only on smooth
    // meshes. [rule 18]
    Vec3 n_shading;
    // Whether the ray came from inside the object. [rule 11]
    bool inside;
    // The material of the object.
    const Material& material;

    // Returns R, the unit direction of the reflected ray. [rule 7] [rule 19]
    Vec3 reflected_direction() const;

    // Returns T, the unit direction of the refracted ray, or nothing for total internal reflection.
    // [rule 8] [rule 10] [rule 19]
    std::optional<Vec3> refracted_direction(double eta_i, double eta_t) const;

private:
    bool is_smooth() const { return n_shading != n_geom; }
};

// Returns the surface that `ray` hit, with the normals turned against the ray. [rule 11]
Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit);
