//! The nearest hit in a scene. Stage 01.

use cases::{Hit, Ray, Scene};

use crate::object::intersect_object;

/// Returns the nearest hit of `ray` among all objects of the scene, or `None`. [rule 2]
///
/// - `ray` and the hit are in world space. `intersect_object(scene, index, ray)` returns the hit
///   with one object.
/// - The least t counts. Of two hits at the same t, the one with the object that is listed first
///   wins: a later one replaces it only if it is strictly nearer.
/// - An empty scene gives `None`.
pub fn nearest_hit(scene: &Scene, ray: &Ray) -> Option<Hit> {
    todo!("nearest_hit [rule 2]: src/nearest.rs")
}
