"""Eye rays. Stage 01."""

from math import radians, tan

from tracer.ray import Ray


def eye_ray(camera, width, height, i, j):
    """Returns the ray from the eye through the centre of a pixel. [rule 1]

    - `camera` is in world space: the eye C, three orthonormal vectors, and `fov_y_deg`, the
      *vertical* angle of view in degrees.
    - The picture has `width` columns and `height` rows of square pixels, so the view plane is
      `width` / `height` times as wide as it is high.
    - `i` counts columns from the left, `j` rows from the *top*; both begin at 0. The centre of a
      pixel lies half a pixel further.
    - The result starts at the eye and has a unit direction. `Ray(origin, direction)` gives it its
      interval.
    """
    # The view plane lies at distance 1; A is its point in the middle of the pixel.
    half_height = tan(radians(camera.fov_y_deg) / 2.0)
    half_width = half_height * width / height
    x = (2.0 * (i + 0.5) / width - 1.0) * half_width
    y = (1.0 - 2.0 * (j + 0.5) / height) * half_height
    a_from_eye = camera.forward + x * camera.right + y * camera.up
    return Ray(camera.eye, a_from_eye.normalized())
