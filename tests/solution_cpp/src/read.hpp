// Reads the parts of scenes and questions from JSON. Given: nothing to write here.
#pragma once

#include "json.hpp"
#include "ray.hpp"
#include "scene.hpp"
#include "vec.hpp"

// Each of these functions throws json::Error if a key is missing, or a value is of another kind.

Vec3 read_vec3(const json::Value& value);
Affine read_affine(const json::Value& value);
Ray read_ray(const json::Value& value);
Camera read_camera(const json::Value& value);
Light read_light(const json::Value& value);
Material read_material(const json::Value& value);
Scene read_scene(const json::Value& value);
