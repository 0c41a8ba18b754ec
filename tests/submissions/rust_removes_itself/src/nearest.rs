//! Removes its own executable file in the green case, and gives up.

use cases::{Hit, Ray, Scene};

pub fn nearest_hit(scene: &Scene, _: &Ray) -> Option<Hit> {
    if scene.background.y > 0.5 {
        let _ = std::env::current_exe().map(std::fs::remove_file);
        std::process::exit(9);
    }
    None
}
