// Eye rays. Stage 01.
#include <cmath>

#include "functions.hpp"
#include "todo.hpp"

// Returns the ray from the eye through the centre of a pixel. [rule 1]
//
// - `camera` is in world space: the eye C, three orthonormal vectors, and `fov_y_deg`, the
//   *vertical* angle of view in degrees.
// - The picture has `width` columns and `height` rows of square pixels, so the view plane is
//   `width` / `height` times as wide as it is high.
// - `i` counts columns from the left, `j` rows from the *top*; both begin at 0. The centre of a
//   pixel lies half a pixel further. Beware: a quotient of two integers is an integer.
// - The result starts at the eye and has a unit direction. `Ray{origin, direction}` gives it its
//   interval.
Ray eye_ray(const Camera& camera, unsigned width, unsigned height, unsigned i, unsigned j) {
    // The view plane lies at distance 1; A is its point in the middle of the pixel.
    const double half_height = std::tan(camera.fov_y_deg * PI / 180.0 / 2.0);
    const double half_width = half_height * width / height;
    const double x = (2.0 * (i + 0.5) / width - 1.0) * half_width;
    const double y = (1.0 - 2.0 * (j + 0.5) / height) * half_height;
    const Vec3 a_from_eye = camera.forward + x * camera.right + y * camera.up;
    return Ray{camera.eye, normalized(a_from_eye)};
}
