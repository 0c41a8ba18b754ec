// One object. Given: nothing to write here.
#include "object.hpp"

#include <array>

#include "functions.hpp"
#include "round.hpp"

namespace {

// A hit with its two unit normals, both outwards; they differ only on smooth meshes. [rule 18]
struct TwoNormals {
    double t;
    Vec3 n_geom;
    Vec3 n_shading;
};

// Tests every triangle in turn. Of two hits at equal t, the earlier triangle's counts. [rule 2]
// [rule 16]
std::optional<TwoNormals> intersect_mesh(const Mesh& mesh, bool smooth, const Ray& ray) {
    std::optional<SurfaceHit> nearest;
    std::array<std::size_t, 3> corners{};
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::optional<SurfaceHit> hit =
            intersect_triangle(ray, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
        if (hit && (!nearest || hit->t < nearest->t)) {
            nearest = hit;
            corners = {a, b, c};
        }
    }
    if (!nearest) {
        return std::nullopt;
    }
    TwoNormals hit = {nearest->t, nearest->normal, nearest->normal};
    if (mesh.normals && smooth) {
        const auto [a, b, c] = corners;
        const std::vector<Vec3>& v = mesh.vertices;
        const std::vector<Vec3>& n = *mesh.normals;
        const Vec3 weights = barycentric(v[a], v[b], v[c], ray.at(nearest->t));
        hit.n_shading = interpolate_normal(weights, {n[a], n[b], n[c]});
    }
    return hit;
}

// Intersects a ray with a shape; both are in object space.
struct InObject {
    const std::vector<Mesh>& meshes;
    bool smooth;
    const Ray& ray;

    static std::optional<TwoNormals> both(const std::optional<SurfaceHit>& hit) {
        if (!hit) {
            return std::nullopt;
        }
        return TwoNormals{hit->t, hit->normal, hit->normal};
    }

    std::optional<TwoNormals> operator()(const Sphere& sphere) const {
        return both(intersect_sphere(ray, sphere.center, sphere.radius));
    }
    std::optional<TwoNormals> operator()(const Plane& plane) const {
        return both(intersect_plane(ray, plane.normal, plane.k));
    }
    std::optional<TwoNormals> operator()(const Square&) const {
        return both(intersect_square(ray));
    }
    std::optional<TwoNormals> operator()(const Box& box) const {
        return both(intersect_box(ray, box.min, box.max));
    }
    std::optional<TwoNormals> operator()(const Cone& cone) const {
        return both(intersect_cone(ray, cone));
    }
    std::optional<TwoNormals> operator()(const MeshShape& shape) const {
        return intersect_mesh(meshes[shape.mesh], smooth, ray);
    }
};

// Intersects a world-space ray with an object. If the object's matrix is the identity, world space
// is object space, so that stages 1 to 4 need no transform. [rule 20]
std::optional<TwoNormals> in_world(const Object& object, const std::vector<Mesh>& meshes,
                                   bool smooth, const Ray& ray) {
    if (object.is_untransformed) {
        return std::visit(InObject{meshes, smooth, ray}, object.shape);
    }
    const Ray inner = ray_to_object(ray, object.object_from_world);
    std::optional<TwoNormals> hit = std::visit(InObject{meshes, smooth, inner}, object.shape);
    if (hit) {
        const bool has_two = hit->n_shading != hit->n_geom;
        hit->n_geom = normal_to_world(hit->n_geom, object.object_from_world);
        hit->n_shading = has_two ? normal_to_world(hit->n_shading, object.object_from_world)
                                 : hit->n_geom;
    }
    return hit;
}

}  // namespace

std::optional<Hit> intersect_object(const Scene& scene, std::size_t index, const Ray& ray) {
    const bool smooth = scene.effects.has(Effect::SmoothNormals);
    const auto hit = in_world(scene.objects[index], scene.meshes, smooth, ray);
    if (!hit) {
        return std::nullopt;
    }
    return Hit{hit->t, ray.at(hit->t), hit->n_geom, hit->n_shading, index};
}

std::optional<SurfaceHit> intersect_transformed(const Object& object, const Ray& ray) {
    const auto hit = in_world(object, {}, false, ray);
    if (!hit) {
        return std::nullopt;
    }
    return SurfaceHit{hit->t, hit->n_geom};
}
