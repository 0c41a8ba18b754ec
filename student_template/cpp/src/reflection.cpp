// Reflected rays. Stage 03.
#include "functions.hpp"
#include "todo.hpp"

// Returns R = d − 2 (d·N) N, the direction of the reflected ray. [rule 7]
//
// - `direction` d and `normal` N are unit vectors in the same frame; d points *towards* the
//   surface. R is a unit vector in this frame too, and points away from the surface.
// - N and −N give the same R.
Vec3 reflect(const Vec3& direction, const Vec3& normal) {
    todo("reflect [rule 7]: src/reflection.cpp");
}

// Returns whether a ray may spawn further rays. [rule 13]
//
// - `depth` is that of the ray that hit the surface; the eye ray's is 0. A ray of depth
//   `max_depth` spawns no more.
// - `weight` is the product of the factors (kr or kt) along the path of this ray, (1, 1, 1) for
//   the eye ray. A weight below `threshold` in *every* channel spawns no more either; a
//   `threshold` of 0 switches this test off.
bool goes_on(unsigned depth, unsigned max_depth, const Vec3& weight, double threshold) {
    todo("goes_on [rule 13]: src/reflection.cpp");
}

// Returns the light that the surface reflects to the viewer: kr · trace(Q, R). [rule 7]
//
// - `at` is in world space: its point is Q, `at.reflected_direction()` is R, and its material has
//   kr. Products are channel by channel.
// - `path` is that of the ray that hit the surface; the reflected ray's is
//   `path.extended(RayKind::Reflected, kr)`.
// - The function is called only if kr is not black and the ray `goes_on`.
Vec3 reflected_light(const Scene& scene, const Surface& at, const Path& path) {
    todo("reflected_light [rule 7]: src/reflection.cpp");
}
