// Pictures and their files. Given: nothing to write here.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "vec.hpp"

// A picture in linear light, row by row from the top.
struct Image {
    unsigned width;
    unsigned height;
    std::vector<Vec3> pixels;
};

// A file that cannot be written.
class FilmError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Writes a picture of 8 bits a channel if `path` ends in .png, or of linear floats if it ends in
// .pfm.
void write_image(const std::string& path, const Image& image);
