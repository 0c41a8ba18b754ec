// Passes each question of the unit checks to its function. Given: nothing to write here.
#include "probe.hpp"

#include <functional>
#include <map>

#include "functions.hpp"
#include "object.hpp"
#include "read.hpp"
#include "trace.hpp"

namespace {

using json::number;
using json::Value;

std::string list(const Vec3& v) {
    return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]";
}

std::string flag(bool value) { return value ? "true" : "false"; }

std::string colour(const Vec3& v) { return "\"colour\":" + list(v); }

std::string vector(const Vec3& v) { return "\"vector\":" + list(v); }

const std::string MISS = "\"miss\":true";

std::string vector_or_miss(const std::optional<Vec3>& v) { return v ? vector(*v) : MISS; }

std::string hit_or_miss(const std::optional<SurfaceHit>& hit) {
    if (!hit) {
        return MISS;
    }
    return "\"hit\":{\"t\":" + number(hit->t) + ",\"normal\":" + list(hit->normal) + "}";
}

std::string ray_of(const Ray& ray) {
    return "\"ray\":{\"origin\":" + list(ray.origin) +
           ",\"direction\":" + list(ray.direction) + "}";
}

Vec3 vec3(const Value& question, const char* key) { return read_vec3(question[key]); }

// Reads the index of a list's member.
template <typename T>
const T& member(const std::vector<T>& members, const Value& index) {
    if (index.whole() >= members.size()) {
        throw json::Error("an index of the question is too large");
    }
    return members[index.whole()];
}

std::string answer_eye_ray(const Value& q) {
    const std::vector<Value>& pixel = q["pixel"].array();
    if (pixel.size() != 2) {
        throw json::Error("a pixel has a column and a row");
    }
    return ray_of(eye_ray(read_camera(q["camera"]), q["width"].whole(), q["height"].whole(),
                          pixel[0].whole(), pixel[1].whole()));
}

std::string answer_nearest(const Value& q) {
    const std::optional<Hit> hit = nearest_hit(read_scene(q["scene"]), read_ray(q["ray"]));
    if (!hit) {
        return MISS;
    }
    return "\"found\":{\"t\":" + number(hit->t) +
           ",\"object\":" + std::to_string(hit->object) + "}";
}

std::string answer_to_light(const Value& q) {
    const ToLight to = to_light(read_light(q["light"]), vec3(q, "point"));
    return "\"to_light\":{\"direction\":" + list(to.direction) + ",\"t\":" + number(to.t) + "}";
}

std::string answer_facing_normal(const Value& q) {
    const Facing facing = facing_normal(vec3(q, "direction"), vec3(q, "normal"));
    return "\"facing\":{\"normal\":" + list(facing.normal) + ",\"inside\":" + flag(facing.inside) +
           "}";
}

std::string answer_shade(const Value& q) {
    const Scene scene = read_scene(q["scene"]);
    const Object& object = member(scene.objects, q["object"]);
    const Vec3 normal = vec3(q, "normal");
    const Surface at = {vec3(q, "point"),      -vec3(q, "to_viewer"), normal, normal,
                        q["inside"].boolean(), scene.materials[object.material]};
    return colour(shade(scene, at));
}

std::string answer_shadow(const Value& q) {
    const Scene scene = read_scene(q["scene"]);
    return colour(unblocked_share(scene, member(scene.lights, q["light"]), vec3(q, "point")));
}

std::string answer_trace(const Value& q) {
    const Path path = {RayKind::Eye, q["depth"].whole(), WHITE};
    return colour(trace(read_scene(q["scene"]), read_ray(q["ray"]), path));
}

std::string answer_indices(const Value& q) {
    const Indices found = indices(q["inside"].boolean(), q["index"].number());
    return "\"indices\":{\"eta_i\":" + number(found.eta_i) + ",\"eta_t\":" + number(found.eta_t) +
           "}";
}

std::string answer_transformed_sphere(const Value& q) {
    Object sphere;
    sphere.shape = Sphere{};
    sphere.world_from_object = read_affine(q["world_from_object"]);
    sphere.object_from_world = read_affine(q["object_from_world"]);
    sphere.is_untransformed = is_identity(sphere.world_from_object);
    return hit_or_miss(intersect_transformed(sphere, read_ray(q["ray"])));
}

std::string answer_interpolate(const Value& q) {
    const std::vector<Value>& normals = q["normals"].array();
    if (normals.size() != 3) {
        throw json::Error("a triangle has three normals");
    }
    return vector(interpolate_normal(
        vec3(q, "weights"), {read_vec3(normals[0]), read_vec3(normals[1]), read_vec3(normals[2])}));
}

// The answer to each kind of question, by its key `fn`.
const std::map<std::string, std::function<std::string(const Value&)>> ANSWERS = {
    {"eye_ray", answer_eye_ray},
    {"sphere",
     [](const Value& q) {
         const Ray ray = read_ray(q["ray"]);
         return hit_or_miss(intersect_sphere(ray, vec3(q, "center"), q["radius"].number()));
     }},
    {"plane",
     [](const Value& q) {
         const Ray ray = read_ray(q["ray"]);
         return hit_or_miss(intersect_plane(ray, vec3(q, "normal"), q["k"].number()));
     }},
    {"square", [](const Value& q) { return hit_or_miss(intersect_square(read_ray(q["ray"]))); }},
    {"box",
     [](const Value& q) {
         return hit_or_miss(intersect_box(read_ray(q["ray"]), vec3(q, "min"), vec3(q, "max")));
     }},
    {"triangle",
     [](const Value& q) {
         const Ray ray = read_ray(q["ray"]);
         return hit_or_miss(intersect_triangle(ray, vec3(q, "a"), vec3(q, "b"), vec3(q, "c")));
     }},
    {"nearest", answer_nearest},
    {"to_light", answer_to_light},
    {"attenuation",
     [](const Value& q) {
         const double share = distance_attenuation(read_light(q["light"]), q["r"].number());
         return "\"value\":" + number(share);
     }},
    {"facing_normal", answer_facing_normal},
    {"ambient",
     [](const Value& q) {
         const Material material = read_material(q["material"]);
         return colour(ambient(material, read_light(q["light"]), q["inside"].boolean()));
     }},
    {"light_term",
     [](const Value& q) {
         return colour(light_term(read_material(q["material"]), vec3(q, "arriving"),
                                  vec3(q, "normal"), vec3(q, "to_viewer"), vec3(q, "to_light")));
     }},
    {"shade", answer_shade},
    {"shadow", answer_shadow},
    {"reflect",
     [](const Value& q) { return vector(reflect(vec3(q, "direction"), vec3(q, "normal"))); }},
    {"goes_on",
     [](const Value& q) {
         return "\"goes_on\":" + flag(goes_on(q["depth"].whole(), q["max_depth"].whole(),
                                              vec3(q, "weight"), q["threshold"].number()));
     }},
    {"trace", answer_trace},
    {"indices", answer_indices},
    {"refract",
     [](const Value& q) {
         return vector_or_miss(refract(vec3(q, "direction"), vec3(q, "normal"),
                                       q["eta_i"].number(), q["eta_t"].number()));
     }},
    {"ray_to_object",
     [](const Value& q) {
         return ray_of(ray_to_object(read_ray(q["ray"]), read_affine(q["object_from_world"])));
     }},
    {"normal_to_world",
     [](const Value& q) {
         return vector(normal_to_world(vec3(q, "normal"), read_affine(q["object_from_world"])));
     }},
    {"transformed_sphere", answer_transformed_sphere},
    {"barycentric",
     [](const Value& q) {
         return vector(barycentric(vec3(q, "a"), vec3(q, "b"), vec3(q, "c"), vec3(q, "q")));
     }},
    {"interpolate", answer_interpolate},
    {"smooth_reflect",
     [](const Value& q) {
         return vector(
             smooth_reflect(vec3(q, "direction"), vec3(q, "n_geom"), vec3(q, "n_shading")));
     }},
    {"smooth_refract",
     [](const Value& q) {
         return vector_or_miss(smooth_refract(vec3(q, "direction"), vec3(q, "n_geom"),
                                              vec3(q, "n_shading"), q["eta_i"].number(),
                                              q["eta_t"].number()));
     }},
};

}  // namespace

std::string answer(const Value& question) {
    const std::string& function = question["fn"].string();
    const auto found = ANSWERS.find(function);
    if (found == ANSWERS.end()) {
        throw json::Error("there is no function `" + function + "`");
    }
    return found->second(question);
}
