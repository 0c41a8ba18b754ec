// The tree of rays behind a pixel, recorded while the pixel is traced, and its text.
// Given: nothing to write here.
#pragma once

#include <functional>
#include <string>

#include "ray.hpp"
#include "vec.hpp"

enum class RayKind { Eye, Reflected, Refracted };

namespace ray_tree {

// The hit of a recorded ray.
struct RecordedHit {
    // The object's name.
    std::string object;
    double t;
    Vec3 point;
    // Normal used for shading, turned against the ray. [rule 11]
    Vec3 normal;
    // Whether the ray was inside the object.
    bool inside;
    // Emission and direct light at the point. [rule 3]
    Vec3 direct;
};

// Runs `trace` and returns the text of the tree of its rays; empty if it traced no ray.
std::string record(const std::function<void()>& trace);

// Returns whether `record` is running. The functions below do nothing otherwise.
bool is_recording();

// Opens a node for a ray that is about to be traced; `leave` closes it.
void enter(RayKind kind, unsigned depth, const Ray& ray);

// Records the hit of the open node's ray.
void hit(const RecordedHit& found);

// Closes the open node with the colour that its ray returned, and returns that colour.
Vec3 leave(const Vec3& colour);

}  // namespace ray_tree
