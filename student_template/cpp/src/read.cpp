// Reads the parts of scenes and questions from JSON. Given: nothing to write here.
#include "read.hpp"

#include <algorithm>
#include <iterator>

namespace {

// The names of the effects, in the order of `Effect`.
constexpr const char* EFFECTS[] = {"shadows",        "tinted_shadows", "reflection",
                                   "refraction",     "smooth_normals", "transforms",
                                   "attenuation",    "adaptive_depth"};

Effect read_effect(const json::Value& value) {
    const auto found = std::find(std::begin(EFFECTS), std::end(EFFECTS), value.string());
    if (found == std::end(EFFECTS)) {
        throw json::Error("there is no effect `" + value.string() + "`");
    }
    return static_cast<Effect>(found - std::begin(EFFECTS));
}

// Reads an index into a list of `n` members.
std::size_t read_index(const json::Value& value, std::size_t n) {
    const unsigned index = value.whole();
    if (index >= n) {
        throw json::Error("the index " + std::to_string(index) + " is too large");
    }
    return index;
}

Shape read_shape(const json::Value& value, std::size_t n_meshes) {
    if (const json::Value* sphere = value.find("sphere")) {
        return Sphere{read_vec3((*sphere)["center"]), (*sphere)["radius"].number()};
    }
    if (const json::Value* plane = value.find("plane")) {
        return Plane{read_vec3((*plane)["normal"]), (*plane)["k"].number()};
    }
    if (value.find("square") != nullptr) {
        return Square{};
    }
    if (const json::Value* box = value.find("box")) {
        return Box{read_vec3((*box)["min"]), read_vec3((*box)["max"])};
    }
    if (const json::Value* cylinder = value.find("cylinder")) {
        const json::Value& of = *cylinder;
        const double radius = of["radius"].number();
        return Cone{radius, radius, of["z_min"].number(), of["z_max"].number(),
                    of["capped"].boolean()};
    }
    if (const json::Value* cone = value.find("cone")) {
        const json::Value& of = *cone;
        return Cone{of["bottom_radius"].number(), of["top_radius"].number(), of["z_min"].number(),
                    of["z_max"].number(), of["capped"].boolean()};
    }
    if (const json::Value* mesh = value.find("mesh")) {
        return MeshShape{read_index((*mesh)["mesh"], n_meshes)};
    }
    throw json::Error("the shape is none of those of docs/protocol.md");
}

Mesh read_mesh(const json::Value& value) {
    Mesh mesh;
    for (const json::Value& vertex : value["vertices"].array()) {
        mesh.vertices.push_back(read_vec3(vertex));
    }
    for (const json::Value& triangle : value["triangles"].array()) {
        const std::vector<json::Value>& corners = triangle.array();
        if (corners.size() != 3) {
            throw json::Error("a triangle has three corners");
        }
        const auto corner = [&](int n) { return read_index(corners[n], mesh.vertices.size()); };
        mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    }
    if (!value["normals"].is_null()) {
        mesh.normals.emplace();
        for (const json::Value& normal : value["normals"].array()) {
            mesh.normals->push_back(read_vec3(normal));
        }
        if (mesh.normals->size() != mesh.vertices.size()) {
            throw json::Error("a mesh has one normal for each vertex");
        }
    }
    return mesh;
}

Object read_object(const json::Value& value, const Scene& scene) {
    Object object;
    object.name = value["name"].string();
    object.shape = read_shape(value["shape"], scene.meshes.size());
    object.material = read_index(value["material"], scene.materials.size());
    object.world_from_object = read_affine(value["world_from_object"]);
    object.object_from_world = read_affine(value["object_from_world"]);
    object.is_untransformed = is_identity(object.world_from_object);
    return object;
}

}  // namespace

Vec3 read_vec3(const json::Value& value) {
    const std::vector<json::Value>& list = value.array();
    if (list.size() != 3) {
        throw json::Error("expected a list of three numbers");
    }
    return {list[0].number(), list[1].number(), list[2].number()};
}

Affine read_affine(const json::Value& value) {
    const std::vector<json::Value>& rows = value.array();
    if (rows.size() != 4) {
        throw json::Error("expected a matrix of four rows");
    }
    const auto at = [&rows](int row, int column) {
        const std::vector<json::Value>& numbers = rows[row].array();
        if (numbers.size() != 4) {
            throw json::Error("expected a row of four numbers");
        }
        return numbers[column].number();
    };
    const auto row = [&at](int n) { return Vec3{at(n, 0), at(n, 1), at(n, 2)}; };
    return {{{row(0), row(1), row(2)}}, {at(0, 3), at(1, 3), at(2, 3)}};
}

Ray read_ray(const json::Value& value) {
    return {read_vec3(value["origin"]), read_vec3(value["direction"]), value["t_min"].number(),
            value["t_max"].number()};
}

Camera read_camera(const json::Value& value) {
    return {read_vec3(value["eye"]), read_vec3(value["right"]), read_vec3(value["up"]),
            read_vec3(value["forward"]), value["fov_y_deg"].number()};
}

Light read_light(const json::Value& value) {
    const json::Value* point = value.find("point");
    const json::Value& of = point != nullptr ? *point : value["directional"];
    Light light;
    light.colour = read_vec3(of["colour"]);
    light.ambient = read_vec3(of["ambient"]);
    if (point != nullptr) {
        const json::Value& attenuation = of["attenuation"];
        light.kind = Light::Kind::Point;
        light.position = read_vec3(of["position"]);
        light.attenuation = {attenuation["quadratic"].number(), attenuation["linear"].number(),
                             attenuation["constant"].number()};
    } else {
        light.kind = Light::Kind::Directional;
        light.direction = read_vec3(of["direction"]);
    }
    return light;
}

Material read_material(const json::Value& value) {
    Material material;
    material.name = value["name"].string();
    material.ke = read_vec3(value["ke"]);
    material.ka = read_vec3(value["ka"]);
    material.kd = read_vec3(value["kd"]);
    material.ks = read_vec3(value["ks"]);
    material.kt = read_vec3(value["kt"]);
    material.kr = read_vec3(value["kr"]);
    material.ns = value["ns"].number();
    material.index = value["index"].number();
    return material;
}

Scene read_scene(const json::Value& value) {
    Scene scene;
    const json::Value& render = value["render"];
    scene.render = {render["width"].whole(), render["height"].whole(), render["max_depth"].whole(),
                    render["threshold"].number()};
    for (const json::Value& effect : value["effects"].array()) {
        scene.effects.add(read_effect(effect));
    }
    scene.camera = read_camera(value["camera"]);
    scene.background = read_vec3(value["background"]);
    for (const json::Value& light : value["lights"].array()) {
        scene.lights.push_back(read_light(light));
    }
    for (const json::Value& material : value["materials"].array()) {
        scene.materials.push_back(read_material(material));
    }
    for (const json::Value& mesh : value["meshes"].array()) {
        scene.meshes.push_back(read_mesh(mesh));
    }
    for (const json::Value& object : value["objects"].array()) {
        scene.objects.push_back(read_object(object, scene));
    }
    return scene;
}
