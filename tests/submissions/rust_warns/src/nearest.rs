//! Right, with a variable that need not be mutable.

use cases::{Hit, Ray, Scene};

use crate::object::intersect_object;

pub fn nearest_hit(scene: &Scene, ray: &Ray) -> Option<Hit> {
    let mut hits = (0..scene.objects.len()).filter_map(|index| intersect_object(scene, index, ray));
    let mut first = hits.next();
    hits.fold(first, |best, hit| if best.is_none_or(|best| hit.t < best.t) { Some(hit) } else { best })
}
