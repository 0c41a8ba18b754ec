//! Calls itself for ever in the green case.

use cases::{Hit, Ray, Scene};

pub fn nearest_hit(scene: &Scene, ray: &Ray) -> Option<Hit> {
    if scene.background.y < 0.5 {
        return None;
    }
    let next = Ray { t_min: ray.t_min + 1.0, ..*ray };
    nearest_hit(scene, &next).filter(|hit| hit.t > ray.t_min)
}
