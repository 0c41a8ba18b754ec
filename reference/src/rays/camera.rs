//! Eye rays. [rule 1]

use cases::{Camera, maths};

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{Aspect, CameraFormula, Fov, HalfAngle, RuleSource, Span};

/// A camera prepared for pictures of one size.
#[derive(Clone, Copy, Debug)]
pub struct Lens<T> {
    eye: Vec3<T>,
    right: Vec3<T>,
    up: Vec3<T>,
    forward: Vec3<T>,
    size: [T; 2],
    /// Half the width and half the height of the view plane at distance 1.
    half: [T; 2],
}

impl<T: Real> Lens<T> {
    /// Returns the camera prepared for pictures of `width` × `height` pixels.
    pub fn new<R: RuleSource>(rules: R, camera: &Camera, width: u32, height: u32) -> Self {
        let tangent = T::of(tangent(rules, camera.fov_y_deg));
        let size = [T::of(f64::from(width)), T::of(f64::from(height))];
        let shape = size[0] / size[1];
        let [wider, higher] = match rules.get().aspect {
            Aspect::Widens => [shape, T::ONE],
            Aspect::Ignored => [T::ONE; 2],
            Aspect::Inverted => [T::ONE / shape, T::ONE],
            Aspect::Heightens => [T::ONE, shape],
        };
        let half = match rules.get().fov {
            Fov::Vertical => [tangent * wider, tangent * higher],
            Fov::Horizontal => [tangent * higher, tangent / wider],
        };
        Self {
            eye: Vec3::of(camera.eye),
            right: Vec3::of(camera.right),
            up: if rules.get().level_up { Vec3::of(camera.up) } else { Vec3::axis(1) },
            forward: Vec3::of(camera.forward),
            size,
            half,
        }
    }

    /// Returns the eye ray through a point of pixel (i, j), in world space. [rule 1]
    ///
    /// The point (`dx`, `dy`) is counted from the corner at which the pixel's row and column begin,
    /// in pixels from 0 to 1; (0.5, 0.5) is the centre. The direction is a unit vector unless the
    /// rules say otherwise.
    pub fn eye_ray<R: RuleSource>(&self, rules: R, pixel: (u32, u32), (dx, dy): (T, T)) -> Ray<T> {
        let corner = if rules.get().pixel_centre { T::ZERO } else { T::HALF };
        let by = rules.get().style.nudge.map(|nudge| T::of(nudge) - corner);
        let share = |n: u32, offset: T, size: T| match rules.get().span {
            Span::Pixels => (T::of(f64::from(n)) + offset) / size,
            Span::EdgeToEdge => T::of(f64::from(n)) / (size - T::ONE),
        };
        let x = share(pixel.0, dx + by[0], self.size[0]);
        let y = share(pixel.1, dy + by[1], self.size[1]);
        let x = T::TWO * x - T::ONE;
        let y = if rules.get().rows_from_top { T::ONE - T::TWO * y } else { T::TWO * y - T::ONE };
        let way = self.way(rules, x, y);
        let direction = if rules.get().unit_direction { way.normalised() } else { way };
        let start = if rules.get().starts_at_eye { self.eye } else { self.eye + way };
        Ray::leaving(rules, start, direction)
    }

    /// Returns a vector from the eye towards a point of the view plane, with x and y from −1 to 1.
    #[inline(always)]
    fn way<R: RuleSource>(&self, rules: R, x: T, y: T) -> Vec3<T> {
        let [width, height] = self.half;
        match rules.get().style.camera {
            CameraFormula::Plane => {
                self.forward + self.right * (x * width) + self.up * (y * height)
            }
            CameraFormula::Corner => {
                let corner = self.eye + self.forward - self.right * width - self.up * height;
                corner + self.right * ((x + T::ONE) * width) + self.up * ((y + T::ONE) * height)
                    - self.eye
            }
            CameraFormula::Far => {
                self.forward * (T::ONE / height) + self.right * (x * (width / height)) + self.up * y
            }
        }
    }
}

/// Returns half the height of the view plane at distance 1 for an angle in degrees. [rule 1]
fn tangent<R: RuleSource>(rules: R, degrees: f64) -> f64 {
    let angle = degrees.to_radians();
    match rules.get().half_angle {
        HalfAngle::Half => maths::tan(angle / 2.0),
        HalfAngle::Whole => maths::tan(angle),
        HalfAngle::HalfOfTangent => maths::tan(angle) / 2.0,
        HalfAngle::Radians => maths::tan(degrees / 2.0),
    }
}
