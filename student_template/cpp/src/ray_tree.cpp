// The tree of rays behind a pixel. Given: nothing to write here.
#include "ray_tree.hpp"

#include <cstddef>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

namespace ray_tree {
namespace {

// A ray, its hit, and the rays that it spawned, in the order in which they were cast.
struct Node {
    RayKind kind = RayKind::Eye;
    unsigned depth = 0;
    Ray ray;
    std::optional<RecordedHit> hit;
    Vec3 colour;
    std::vector<Node> children;
};

// The open nodes from the root inwards, while a tree is recorded. The root stands for no ray.
std::vector<Node> open_nodes;

const char* name(RayKind kind) {
    switch (kind) {
        case RayKind::Eye: return "eye";
        case RayKind::Reflected: return "reflected";
        case RayKind::Refracted: return "refracted";
    }
    return "";
}

// Formats a number with six digits after the point, without trailing zeros or a minus before zero.
std::string digits(double x) {
    if (x != x) {
        return "NaN";
    }
    const int size = std::snprintf(nullptr, 0, "%.6f", x);
    std::string text(static_cast<std::size_t>(size) + 1, '\0');
    std::snprintf(&text[0], text.size(), "%.6f", x);
    text.pop_back();
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') {
            text.pop_back();
        }
    }
    return text == "-0" ? "0" : text;
}

std::string triple(const Vec3& v) {
    return "(" + digits(v.x) + ", " + digits(v.y) + ", " + digits(v.z) + ")";
}

void write(const Node& node, std::size_t indent, std::string& out) {
    const std::string pad(2 * indent, ' ');
    out += pad + name(node.kind) + " ray, depth " + std::to_string(node.depth) + "\n";
    out += pad + "  origin " + triple(node.ray.origin);
    out += " direction " + triple(node.ray.direction) + "\n";
    if (node.hit) {
        const RecordedHit& hit = *node.hit;
        const char* side = hit.inside ? "inside" : "outside";
        out += pad + "  hits " + hit.object + " from " + side + " at t " + digits(hit.t) + "\n";
        out += pad + "  point " + triple(hit.point) + " normal " + triple(hit.normal) + "\n";
        out += pad + "  direct light " + triple(hit.direct) + "\n";
    } else {
        out += pad + "  hits nothing\n";
    }
    out += pad + "  colour " + triple(node.colour) + "\n";
    for (const Node& child : node.children) {
        write(child, indent + 1, out);
    }
}

}  // namespace

std::string record(const std::function<void()>& trace) {
    open_nodes.assign(1, Node());
    trace();
    const std::vector<Node> roots = std::move(open_nodes.front().children);
    open_nodes.clear();
    std::string text;
    if (!roots.empty()) {
        write(roots.front(), 0, text);
    }
    return text;
}

bool is_recording() { return !open_nodes.empty(); }

void enter(RayKind kind, unsigned depth, const Ray& ray) {
    if (is_recording()) {
        Node node;
        node.kind = kind;
        node.depth = depth;
        node.ray = ray;
        open_nodes.push_back(node);
    }
}

void hit(const RecordedHit& found) {
    if (is_recording()) {
        open_nodes.back().hit = found;
    }
}

Vec3 leave(const Vec3& colour) {
    if (open_nodes.size() > 1) {
        Node node = std::move(open_nodes.back());
        open_nodes.pop_back();
        node.colour = colour;
        open_nodes.back().children.push_back(std::move(node));
    }
    return colour;
}

}  // namespace ray_tree
