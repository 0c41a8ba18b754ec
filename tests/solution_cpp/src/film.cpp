// Pictures and their files. Given: nothing to write here.
#include "film.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace {

// The nearest of 256 levels, without gamma. NaN becomes 0. [decision D25]
std::uint8_t level(double light) {
    const double clamped = light > 0.0 ? std::min(light, 1.0) : 0.0;
    return static_cast<std::uint8_t>(clamped * 255.0 + 0.5);
}

void push_big_endian(std::string& out, std::uint32_t n) {
    for (const int shift : {24, 16, 8, 0}) {
        out.push_back(static_cast<char>(n >> shift & 0xFF));
    }
}

// The checksum of a chunk of a PNG.
std::uint32_t crc(const std::string& bytes) {
    std::uint32_t sum = 0xFFFFFFFF;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            sum = sum & 1 ? sum >> 1 ^ 0xEDB88320 : sum >> 1;
        }
    }
    return ~sum;
}

// The checksum of a zlib stream.
std::uint32_t adler(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

// Returns a zlib stream that holds the bytes uncompressed, in blocks of up to 65535.
std::string stored(const std::string& bytes) {
    constexpr std::size_t MOST = 65535;
    std::string out = "\x78\x01";
    std::size_t at = 0;
    do {
        const std::size_t size = std::min(MOST, bytes.size() - at);
        out.push_back(at + size == bytes.size() ? 1 : 0);
        for (const std::size_t field : {size, ~size}) {
            out.push_back(static_cast<char>(field & 0xFF));
            out.push_back(static_cast<char>(field >> 8 & 0xFF));
        }
        out.append(bytes, at, size);
        at += size;
    } while (at < bytes.size());
    push_big_endian(out, adler(bytes));
    return out;
}

void push_chunk(std::string& out, const std::string& name, const std::string& content) {
    push_big_endian(out, static_cast<std::uint32_t>(content.size()));
    out += name + content;
    push_big_endian(out, crc(name + content));
}

std::string png(const Image& image) {
    std::string header;
    push_big_endian(header, image.width);
    push_big_endian(header, image.height);
    // 8 bits a channel, RGB, deflate, the only filters, not interlaced.
    header += std::string("\x08\x02\x00\x00\x00", 5);
    std::string rows;
    for (std::size_t n = 0; n < image.pixels.size(); ++n) {
        if (n % image.width == 0) {
            rows.push_back('\0');
        }
        const Vec3& pixel = image.pixels[n];
        for (const double light : {pixel.x, pixel.y, pixel.z}) {
            rows.push_back(static_cast<char>(level(light)));
        }
    }
    std::string out = "\x89PNG\r\n\x1a\n";
    push_chunk(out, "IHDR", header);
    push_chunk(out, "IDAT", stored(rows));
    push_chunk(out, "IEND", "");
    return out;
}

// The bottom row comes first, and -1.0 says that the floats are little-endian.
std::string pfm(const Image& image) {
    std::string out =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    for (unsigned row = image.height; row-- > 0;) {
        for (unsigned column = 0; column < image.width; ++column) {
            const Vec3& pixel = image.pixels[std::size_t{row} * image.width + column];
            for (const double light : {pixel.x, pixel.y, pixel.z}) {
                const float value = static_cast<float>(light);
                std::uint32_t bits;
                std::memcpy(&bits, &value, sizeof bits);
                for (const int shift : {0, 8, 16, 24}) {
                    out.push_back(static_cast<char>(bits >> shift & 0xFF));
                }
            }
        }
    }
    return out;
}

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

void write_image(const std::string& path, const Image& image) {
    if (!ends_with(path, ".png") && !ends_with(path, ".pfm")) {
        throw FilmError("the picture " + path + " must end in .png or .pfm");
    }
    const std::string bytes = ends_with(path, ".png") ? png(image) : pfm(image);
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
        throw FilmError("cannot write the picture " + path);
    }
}
