//! Reaches for what the course does not hand out.

use cases::Light;
use cases::glam::DVec3;

pub fn to_light(_: &Light, point: DVec3) -> (DVec3, f64) {
    (point, unsafe { *std::ptr::null::<f64>() })
}

pub fn distance_attenuation(_: &Light, _: f64) -> f64 {
    1.0
}
