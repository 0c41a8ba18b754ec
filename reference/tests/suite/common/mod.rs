//! Shared by the tests: scenes from text, and reproducible random numbers.

pub(crate) mod catalogue;
pub(crate) mod cost;
pub(crate) mod program;
pub(crate) mod random;

use cases::film::Image;
use cases::{Light, Scene, scene};
use glam::{DAffine3, DVec3};
use reference::numbers::real::Real;
use reference::rules::Lecture;
use reference::trace::render::{Options, render};
use reference::world::World;

/// Parses a scene from TOML text without `[render]` and camera, which are added.
pub(crate) fn scene(text: &str) -> Scene {
    let head = "[render]\nsize = [24, 18]\nmax_depth = 3\n[scene.camera]\neye = [0, 0, 4]\n\
        look_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n";
    match scene::parse(
        "test.toml",
        &format!("{head}{text}"),
        std::path::Path::new(""),
        &cases::Course::default(),
    ) {
        Ok(scene) => scene,
        Err(problems) => panic!("{}", problems.render(false)),
    }
}

/// A small random number generator (xorshift). The seed must not be 0.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Returns a number from −1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Returns a number from 0 to 1.
    pub(crate) fn share(&mut self) -> f64 {
        self.signed().abs()
    }

    /// Returns a unit vector.
    pub(crate) fn unit(&mut self) -> glam::DVec3 {
        loop {
            let v = glam::DVec3::new(self.signed(), self.signed(), self.signed());
            if (0.01..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}

/// Returns a scene of one white object with the given transform.
pub(crate) fn lone(
    shape: cases::Shape,
    meshes: Vec<cases::Mesh>,
    world_from_object: glam::DAffine3,
) -> Scene {
    let mut scene = scene(
        "[scene.materials.m]\nkd = [1, 1, 1]\n[[scene.objects]]\nsphere = {}\nmaterial = \"m\"\n",
    );
    let object = &mut scene.objects[0];
    (object.shape, object.world_from_object) = (shape, world_from_object);
    object.object_from_world = world_from_object.inverse();
    scene.meshes = meshes;
    scene
}

/// Returns a closed mesh around the origin: a sphere of `n` bands and `n` columns, whose vertices
/// have the distances that `radius` returns.
pub(crate) fn globe(n: u32, mut radius: impl FnMut() -> f64) -> cases::Mesh {
    use cases::maths::{cos, sin};
    use std::f64::consts::PI;
    let mut vertices = vec![glam::DVec3::Y * radius(), glam::DVec3::NEG_Y * radius()];
    for band in 1..n {
        let angle = PI * f64::from(band) / f64::from(n);
        let (height, width) = (sin(angle), cos(angle));
        for column in 0..n {
            let angle = 2.0 * PI * f64::from(column) / f64::from(n);
            let (z, x) = (sin(angle), cos(angle));
            vertices.push(glam::DVec3::new(x * height, width, z * height) * radius());
        }
    }
    let at = |band: u32, column: u32| 2 + (band - 1) * n + column % n;
    let mut triangles = Vec::new();
    for column in 0..n {
        triangles.push([0, at(1, column + 1), at(1, column)]);
        for band in 1..n - 1 {
            let [a, b] = [at(band, column), at(band, column + 1)];
            let [c, d] = [at(band + 1, column), at(band + 1, column + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
        triangles.push([1, at(n - 1, column), at(n - 1, column + 1)]);
    }
    cases::Mesh { vertices, triangles, normals: None }
}

/// Units of length in scene units, from tiny to huge.
pub(crate) const SCALES: [f64; 5] = [1e-6, 1e-3, 1.0, 1e3, 1e6];

/// Renders a scene by the rules of the lecture.
pub(crate) fn picture<T: Real>(scene: &Scene) -> Image {
    let world = World::<T>::new(scene);
    render(&world, Lecture, &Options::of(&world), |_| {}).0
}

/// Returns the scene translated by `by`.
pub(crate) fn moved(scene: &Scene, by: DVec3) -> Scene {
    let mut scene = scene.clone();
    scene.camera.eye += by;
    for light in &mut scene.lights {
        if let Light::Point { position, .. } = light {
            *position += by;
        }
    }
    for object in &mut scene.objects {
        object.world_from_object = DAffine3::from_translation(by) * object.world_from_object;
        object.object_from_world *= DAffine3::from_translation(-by);
    }
    scene
}
