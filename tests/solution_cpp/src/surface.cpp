// The surface that a ray hit, as shading and new rays need it. Given: nothing to write here.
#include "surface.hpp"

#include "functions.hpp"

Vec3 Surface::reflected_direction() const {
    return is_smooth() ? smooth_reflect(direction, n_geom, n_shading) : reflect(direction, n_geom);
}

std::optional<Vec3> Surface::refracted_direction(double eta_i, double eta_t) const {
    return is_smooth() ? smooth_refract(direction, n_geom, n_shading, eta_i, eta_t)
                       : refract(direction, n_geom, eta_i, eta_t);
}

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Facing facing = facing_normal(ray.direction, hit.n_geom);
    const Vec3 n_shading = facing.inside ? -hit.n_shading : hit.n_shading;
    const Material& material = scene.materials[scene.objects[hit.object].material];
    return {hit.point, ray.direction, facing.normal, n_shading, facing.inside, material};
}
