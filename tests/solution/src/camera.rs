//! Eye rays. Stage 01.

use cases::{Camera, Ray};
use glam::DVec3;

/// Returns the ray from the eye through the centre of a pixel. [rule 1]
///
/// - `camera` is in world space: the eye C, three orthonormal vectors, and `fov_y_deg`, the
///   *vertical* angle of view in degrees.
/// - The picture has `width` columns and `height` rows of square pixels, so the view plane is
///   `width` / `height` times as wide as it is high.
/// - `i` counts columns from the left, `j` rows from the *top*; both begin at 0. The centre of a
///   pixel lies half a pixel further.
/// - The result starts at the eye and has a unit direction. `Ray::new` gives it its interval.
pub fn eye_ray(camera: &Camera, width: u32, height: u32, i: u32, j: u32) -> Ray {
    let (width, height) = (f64::from(width), f64::from(height));
    // The view plane lies at distance 1; A is its point in the middle of the pixel.
    let half_height = (camera.fov_y_deg.to_radians() / 2.0).tan();
    let half_width = half_height * width / height;
    let x = (2.0 * (f64::from(i) + 0.5) / width - 1.0) * half_width;
    let y = (1.0 - 2.0 * (f64::from(j) + 0.5) / height) * half_height;
    let a_from_eye: DVec3 = camera.forward + x * camera.right + y * camera.up;
    Ray::new(camera.eye, a_from_eye.normalize())
}
