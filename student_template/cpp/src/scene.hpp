// The resolved scene, as docs/protocol.md describes it. Given: nothing to write here.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vec.hpp"

// An effect that a picture may show beyond eye rays and local light.
enum class Effect {
    Shadows,
    TintedShadows,
    Reflection,
    Refraction,
    SmoothNormals,
    Transforms,
    Attenuation,
    AdaptiveDepth,
};

// The effects that a scene simulates; no other may show.
class Effects {
public:
    bool has(Effect effect) const { return bits[static_cast<std::size_t>(effect)]; }
    void add(Effect effect) { bits.set(static_cast<std::size_t>(effect)); }

private:
    std::bitset<8> bits;
};

// Settings of a render.
struct Render {
    unsigned width = 1;
    unsigned height = 1;
    // Depth at which a ray spawns no further rays; the eye ray has depth 0. [rule 13]
    unsigned max_depth = 0;
    // Weight below which a path spawns no further rays, in every channel; 0 is off. [rule 13]
    double threshold = 0.0;
};

// A pinhole camera; `right`, `up`, `forward` are orthonormal. [rule 1]
struct Camera {
    Vec3 eye;
    Vec3 right;
    Vec3 up;
    Vec3 forward;
    // Vertical angle of view in degrees.
    double fov_y_deg = 45.0;
};

// A = min(1, 1 / (quadratic r² + linear r + constant)); none negative, not all zero. [rule 4]
struct Attenuation {
    double quadratic = 0.0;
    double linear = 0.0;
    double constant = 1.0;
};

// A source of light.
struct Light {
    enum class Kind { Point, Directional };

    Kind kind = Kind::Point;
    // I. [rule 3]
    Vec3 colour;
    // Ia, this light's own ambient colour. [rule 3]
    Vec3 ambient;
    // Position of a point light.
    Vec3 position;
    // Attenuation of a point light with distance. [rule 4]
    Attenuation attenuation;
    // Unit vector along which the light of a directional light travels, away from the light.
    Vec3 direction;
};

// The response of a surface to light; colours are linear RGB, none negative. [rule 3]
struct Material {
    std::string name;
    // Emission, ambient, diffuse, specular, transmissive.
    Vec3 ke, ka, kd, ks, kt;
    // Reflective: weight of the reflected ray. [rule 7]
    Vec3 kr;
    // Specular exponent, at least 0.
    double ns = 0.0;
    // Index of refraction, above 0. [rule 9]
    double index = 1.0;
};

// Triangles over shared vertices; the normal of (A, B, C) is along (B − A) × (C − A). [rule 16]
struct Mesh {
    std::vector<Vec3> vertices;
    // Triangles, each as three indices into `vertices`.
    std::vector<std::array<std::size_t, 3>> triangles;
    // One unit normal per vertex, or none where the mesh is flat. [rule 18]
    std::optional<std::vector<Vec3>> normals;
};

// Shapes in object space. Sizes are positive. [rule 14] [rule 15] [rule 16]
struct Sphere {
    Vec3 center;
    double radius = 0.5;
};
struct Plane {
    // N of N·X = k, a unit vector.
    Vec3 normal;
    double k = 0.0;
};
struct Square {};
struct Box {
    Vec3 min;
    Vec3 max;
};
// A cylinder is a cone with two equal radii.
struct Cone {
    double bottom_radius = 0.5;
    double top_radius = 0.5;
    double z_min = 0.0;
    double z_max = 1.0;
    // Whether discs close the ends.
    bool capped = true;
};
struct MeshShape {
    // Index into the meshes of the scene.
    std::size_t mesh = 0;
};
using Shape = std::variant<Sphere, Plane, Square, Box, Cone, MeshShape>;

// An object of the scene.
struct Object {
    std::string name;
    // Shape, in object space.
    Shape shape;
    // Index into the materials of the scene.
    std::size_t material = 0;
    // M, object space to world space, and its inverse. [rule 20]
    Affine world_from_object;
    Affine object_from_world;
    // Whether M is the identity, so that object space is world space.
    bool is_untransformed = true;
};

// A complete picture to render.
struct Scene {
    Render render;
    Effects effects;
    Camera camera;
    // Colour of a ray that hits nothing.
    Vec3 background;
    std::vector<Light> lights;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
};
