// The functions that you write, each below the name of its file, which holds its contract. Given:
// nothing to write here.
#pragma once

#include <array>
#include <optional>

#include "ray.hpp"
#include "scene.hpp"
#include "surface.hpp"
#include "trace.hpp"
#include "vec.hpp"

// L, the unit vector to a light, and t_light, the distance to it. [rule 5]
struct ToLight {
    Vec3 direction;
    double t = 0.0;
};

// A normal turned against the ray, and whether the ray is inside the object. [rule 11]
struct Facing {
    Vec3 normal;
    bool inside = false;
};

// The index of refraction on the side of the ray, and on the other side. [rule 9]
struct Indices {
    double eta_i = 1.0;
    double eta_t = 1.0;
};

// camera.cpp
Ray eye_ray(const Camera& camera, unsigned width, unsigned height, unsigned i, unsigned j);

// sphere.cpp, plane.cpp, cuboid.cpp, triangle.cpp
std::optional<SurfaceHit> intersect_sphere(const Ray& ray, const Vec3& center, double radius);
std::optional<SurfaceHit> intersect_plane(const Ray& ray, const Vec3& normal, double k);
std::optional<SurfaceHit> intersect_square(const Ray& ray);
std::optional<SurfaceHit> intersect_box(const Ray& ray, const Vec3& min, const Vec3& max);
std::optional<SurfaceHit> intersect_triangle(const Ray& ray, const Vec3& a, const Vec3& b,
                                             const Vec3& c);

// nearest.cpp
std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray);

// light.cpp
ToLight to_light(const Light& light, const Vec3& point);
double distance_attenuation(const Light& light, double r);

// shade.cpp
Facing facing_normal(const Vec3& direction, const Vec3& normal);
Vec3 ambient(const Material& material, const Light& light, bool inside);
Vec3 light_term(const Material& material, const Vec3& arriving, const Vec3& normal,
                const Vec3& to_viewer, const Vec3& to_light);
Vec3 shade(const Scene& scene, const Surface& at);

// shadow.cpp
Vec3 shadow_attenuation(const Scene& scene, const Light& light, const Vec3& point);

// reflection.cpp
Vec3 reflect(const Vec3& direction, const Vec3& normal);
bool goes_on(unsigned depth, unsigned max_depth, const Vec3& weight, double threshold);
Vec3 reflected_light(const Scene& scene, const Surface& at, const Path& path);

// refraction.cpp
Indices indices(bool inside, double index);
std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double eta_i, double eta_t);
Vec3 refracted_light(const Scene& scene, const Surface& at, const Path& path);

// transform.cpp
Ray ray_to_object(const Ray& ray, const Affine& object_from_world);
Vec3 normal_to_world(const Vec3& normal, const Affine& object_from_world);

// smooth.cpp
Vec3 barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q);
Vec3 interpolate_normal(const Vec3& weights, const std::array<Vec3, 3>& normals);
Vec3 smooth_reflect(const Vec3& direction, const Vec3& n_geom, const Vec3& n_shading);
std::optional<Vec3> smooth_refract(const Vec3& direction, const Vec3& n_geom, const Vec3& n_shading,
                                   double eta_i, double eta_t);
