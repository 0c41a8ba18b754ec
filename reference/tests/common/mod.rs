//! What several tests need: scenes from text, and numbers that look random but are the same each time.
#![allow(dead_code, reason = "no test needs all of it")]

use cases::{Scene, scene};

/// The scene of a TOML text without `[render]` and camera, which are added.
pub(crate) fn scene(text: &str) -> Scene {
    let head = "[render]\nsize = [24, 18]\nmax_depth = 3\n[scene.camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n";
    match scene::parse("test.toml", &format!("{head}{text}"), std::path::Path::new("")) {
        Ok(scene) => scene,
        Err(problems) => panic!("{}", problems.render(false)),
    }
}

/// A small generator (xorshift).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// From −1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// From 0 to 1.
    pub(crate) fn share(&mut self) -> f64 {
        self.signed().abs()
    }

    /// A vector of unit length.
    pub(crate) fn unit(&mut self) -> glam::DVec3 {
        loop {
            let v = glam::DVec3::new(self.signed(), self.signed(), self.signed());
            if (0.01..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}
