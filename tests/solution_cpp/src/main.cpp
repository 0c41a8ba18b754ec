// A Whitted ray tracer, one function at a time: the three calls of docs/protocol.md. Given: nothing
// to write here; start with ../README.md.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "film.hpp"
#include "functions.hpp"
#include "json.hpp"
#include "probe.hpp"
#include "ray_tree.hpp"
#include "read.hpp"
#include "todo.hpp"
#include "trace.hpp"

namespace {

constexpr int FAILED = 1;
constexpr int UNREADABLE = 2;
constexpr int STILL_TO_BE_WRITTEN = 75;

constexpr const char* USAGE =
    "usage: tracer render SCENE.json OUT.png|OUT.pfm\n"
    "       tracer probe\n"
    "       tracer explain SCENE.json X Y";

// Wrong usage, or an input that cannot be read.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

Scene load(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
        throw InputError("cannot read the scene " + path);
    }
    try {
        return read_scene(json::parse(text.str()));
    } catch (const json::Error& why) {
        throw InputError("cannot understand " + path + ": " + why.what());
    }
}

Vec3 pixel(const Scene& scene, unsigned i, unsigned j) {
    const Render& render = scene.render;
    return trace(scene, eye_ray(scene.camera, render.width, render.height, i, j), Path());
}

void render(const std::string& path, const std::string& out) {
    const Scene scene = load(path);
    Image image = {scene.render.width, scene.render.height, {}};
    for (unsigned j = 0; j < image.height; ++j) {
        for (unsigned i = 0; i < image.width; ++i) {
            image.pixels.push_back(pixel(scene, i, j));
        }
    }
    write_image(out, image);
}

// Reads a column or a row below `size`.
unsigned coordinate(const std::string& text, unsigned size) {
    const bool is_number = !text.empty() && text.size() < 10 &&
                           text.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number || std::stoul(text) >= size) {
        throw InputError("there is no pixel `" + text + "`: expected 0 to " +
                         std::to_string(size - 1));
    }
    return static_cast<unsigned>(std::stoul(text));
}

void explain(const std::string& path, const std::string& x, const std::string& y) {
    const Scene scene = load(path);
    const unsigned i = coordinate(x, scene.render.width);
    const unsigned j = coordinate(y, scene.render.height);
    const std::string tree = ray_tree::record([&] { pixel(scene, i, j); });
    std::cout << (tree.empty() ? "no ray was recorded\n" : tree);
}

std::string reply(const json::Value& question) {
    try {
        return answer(question);
    } catch (const Todo&) {
        return "\"todo\":true";
    } catch (const json::Error&) {
        throw;
    } catch (const std::exception& why) {
        std::cerr << "panic: " << why.what() << std::endl;
        return "\"panic\":" + json::quoted(why.what());
    }
}

// Answers the questions on standard input. Each answer is flushed, so that a function that never
// returns costs no earlier answer.
void probe() {
    std::string line;
    while (std::getline(std::cin, line)) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        try {
            const json::Value question = json::parse(line);
            const std::string id = json::quoted(question["id"].string());
            const std::string body = reply(question);
            std::cout << "{\"id\":" << id << "," << body << "}" << std::endl;
        } catch (const json::Error& why) {
            throw InputError("cannot understand the question " + line + ": " + why.what());
        }
    }
}

void call(const std::vector<std::string>& args) {
    if (args.size() == 3 && args[0] == "render") {
        render(args[1], args[2]);
    } else if (args.size() == 1 && args[0] == "probe") {
        probe();
    } else if (args.size() == 4 && args[0] == "explain") {
        explain(args[1], args[2], args[3]);
    } else {
        throw InputError(USAGE);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        call(std::vector<std::string>(argv + 1, argv + argc));
        return 0;
    } catch (const Todo& function) {
        std::cerr << "todo: " << function.what() << std::endl;
        return STILL_TO_BE_WRITTEN;
    } catch (const InputError& why) {
        std::cerr << why.what() << std::endl;
        return UNREADABLE;
    } catch (const FilmError& why) {
        std::cerr << why.what() << std::endl;
        return UNREADABLE;
    } catch (const std::exception& why) {
        std::cerr << "panic: " << why.what() << std::endl;
        return FAILED;
    }
}
