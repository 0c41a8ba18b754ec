//! Shared by the tests of the cost of accuracy.

use cases::{Scene, stage};
use reference::cost::measure::Outside;

/// A ball of glass above a reflective floor, with a lamp.
pub(crate) const SCENE: &str = r#"
[render]
size = [12, 9]
max_depth = 2
[scene.camera]
eye = [0, 0.2, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 40
[scene.materials]
glass = { kd = [0.1, 0.1, 0.1], kt = [0.5, 0.5, 0.5], kr = [0.3, 0.3, 0.3], index = 1.5 }
wall = { kd = [0.6, 0.4, 0.2], kr = [0.4, 0.4, 0.4] }
[[scene.lights]]
point = { position = [2, 3, 4], colour = [1, 1, 1], ambient = [0.2, 0.2, 0.2] }
[[scene.objects]]
sphere = {}
material = "glass"
[[scene.objects]]
plane = { normal = [0, 1, 0], k = -0.7 }
material = "wall"
"#;

/// Checks that every element of `svg` is closed in the right order, and that every `&` begins an
/// entity.
pub(crate) fn well_formed(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{svg}");
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap());
        }
    }
    assert_eq!(open, Vec::<&str>::new());
    assert!(
        svg.split('&').skip(1).all(|rest| ["amp;", "lt;", "gt;", "quot;", "#39;"]
            .iter()
            .any(|e| rest.starts_with(e)))
    );
}

/// Loads a scene from text.
pub(crate) fn scene(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    stage::load_scene(&path, &cases::Course::default()).unwrap()
}

/// A clock by which every picture takes half a second. It stops the measurement before picture
/// number `stops_before`.
pub(crate) struct FakeClock {
    now_s: f64,
    pub(crate) n_calls: usize,
    stops_before: usize,
    pub(crate) work: u64,
}

impl FakeClock {
    pub(crate) fn until(stops_before: usize) -> Self {
        Self { now_s: 0.0, n_calls: 0, stops_before, work: 0 }
    }
}

impl Outside for FakeClock {
    fn now_s(&mut self) -> f64 {
        self.now_s += 0.5;
        self.now_s
    }

    fn goes_on(&mut self) -> bool {
        self.n_calls += 1;
        self.n_calls <= self.stops_before
    }

    fn done(&mut self, work: u64) {
        self.work += work;
    }
}
