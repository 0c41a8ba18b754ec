//! Indexes past the end of a list in the green case.

use cases::{Hit, Ray, Scene};

pub fn nearest_hit(scene: &Scene, ray: &Ray) -> Option<Hit> {
    let missing = usize::from(scene.background.y > 0.5);
    let lists: [&[Option<Hit>]; 2] = [&[None], &[]];
    lists[missing][0]
}
