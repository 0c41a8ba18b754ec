// Vectors of three numbers, for points, directions and colours. Given: nothing to write here.
#pragma once

#include <algorithm>
#include <cmath>

struct Vec3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    // The component along an axis: 0 is x, 1 is y, 2 is z.
    double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

    Vec3& operator+=(const Vec3& v) {
        x += v.x;
        y += v.y;
        z += v.z;
        return *this;
    }

    // Multiplies component by component, as colours are filtered.
    Vec3& operator*=(const Vec3& v) {
        x *= v.x;
        y *= v.y;
        z *= v.z;
        return *this;
    }
};

constexpr double PI = 3.14159265358979323846;

constexpr Vec3 BLACK = {0.0, 0.0, 0.0};
constexpr Vec3 WHITE = {1.0, 1.0, 1.0};

inline Vec3 operator-(const Vec3& v) { return {-v.x, -v.y, -v.z}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Vec3 operator*(const Vec3& v, double s) { return s * v; }
inline Vec3 operator/(const Vec3& v, double s) { return {v.x / s, v.y / s, v.z / s}; }

// The product component by component, as colours are filtered.
inline Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

inline bool operator==(const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline bool operator!=(const Vec3& a, const Vec3& b) { return !(a == b); }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

// The unit vector along `v`, which is not the zero vector.
inline Vec3 normalized(const Vec3& v) { return v / length(v); }

// The unit vector along `v`, or `otherwise` if `v` is the zero vector.
inline Vec3 normalized_or(const Vec3& v, const Vec3& otherwise) {
    const double l = length(v);
    return l > 0.0 ? v / l : otherwise;
}

inline double max_component(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

// A matrix of three rows.
struct Mat3 {
    Vec3 rows[3];
};

inline Vec3 operator*(const Mat3& m, const Vec3& v) {
    return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}

inline Mat3 transposed(const Mat3& m) {
    const auto column = [&m](int axis) {
        return Vec3{m.rows[0][axis], m.rows[1][axis], m.rows[2][axis]};
    };
    return {{column(0), column(1), column(2)}};
}

// The map X → A X + t of points; directions are mapped by A alone. [rule 20]
struct Affine {
    // A.
    Mat3 linear;
    // t.
    Vec3 translation;
};

// Returns whether `m` maps every point to itself.
inline bool is_identity(const Affine& m) {
    const Vec3* rows = m.linear.rows;
    return rows[0] == Vec3{1.0, 0.0, 0.0} && rows[1] == Vec3{0.0, 1.0, 0.0} &&
           rows[2] == Vec3{0.0, 0.0, 1.0} && m.translation == Vec3{};
}
