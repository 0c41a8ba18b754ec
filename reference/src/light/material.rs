//! Materials, in the precision of a render.

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;

/// The coefficients by which a surface reflects and transmits light. [rule 3]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the letters of rule 3, as in `cases::Material`")]
pub struct Material<T> {
    pub ke: Vec3<T>,
    pub ka: Vec3<T>,
    pub kd: Vec3<T>,
    pub ks: Vec3<T>,
    pub kt: Vec3<T>,
    pub kr: Vec3<T>,
    pub ns: T,
    pub index: T,
}

impl<T: Real> Material<T> {
    /// Returns the material in the precision `T`.
    pub fn of(m: &cases::Material) -> Self {
        Self {
            ke: Vec3::of(m.ke),
            ka: Vec3::of(m.ka),
            kd: Vec3::of(m.kd),
            ks: Vec3::of(m.ks),
            kt: Vec3::of(m.kt),
            kr: Vec3::of(m.kr),
            ns: T::of(m.ns),
            index: T::of(m.index),
        }
    }
}
