//! Checks what holds for every scene on a scene that comes from outside.

use std::fmt::Display;

use glam::{DAffine3, DVec3};

use super::limits;
use super::model::{Camera, Light, Material, Mesh, Object, Scene, Shape};
use super::raw::numbers::MAX_NUMBER;
use super::transform;

/// Greatest difference of the length of a unit vector from 1, and of M M⁻¹ from the identity
/// (relative to the size of its terms).
const ROUNDING: f64 = 1e-6;

/// Returns everything about `scene` that breaks what holds for every scene, each as a sentence with
/// the place. At most a hundred are returned, because a few are enough to refuse the scene.
pub(crate) fn broken(scene: &Scene) -> Vec<String> {
    let mut found = Found(vec![]);
    let render = &scene.render;
    let pixels = u64::from(render.width) * u64::from(render.height);
    found.unless(
        pixels > 0 && pixels <= limits::MAX_PIXELS,
        "render",
        "the size is 0 or too large",
    );
    found.at_least_0("render.threshold", &[render.threshold]);
    found.camera(&scene.camera);
    found.colour("background", scene.background);
    for (i, light) in scene.lights.iter().enumerate() {
        found.light(&format!("lights[{i}]"), light);
    }
    for (i, material) in scene.materials.iter().enumerate() {
        found.material(&format!("materials[{i}]"), material);
    }
    for (i, mesh) in scene.meshes.iter().enumerate() {
        found.mesh(&format!("meshes[{i}]"), mesh);
    }
    found.unless(scene.objects.len() <= limits::MAX_OBJECTS, "objects", "they are too many");
    for (i, object) in scene.objects.iter().enumerate() {
        found.object(&format!("objects[{i}]"), object, scene);
    }
    found.0
}

struct Found(Vec<String>);

impl Found {
    fn unless(&mut self, holds: bool, place: impl Display, what: &str) {
        if !holds && self.0.len() < 100 {
            self.0.push(format!("{place}: {what}"));
        }
    }

    fn finite(&mut self, place: impl Display, v: DVec3) {
        self.unless(
            v.is_finite() && v.abs().max_element() <= MAX_NUMBER,
            place,
            "it has a number that cannot be used",
        );
    }

    fn unit(&mut self, place: impl Display, v: DVec3) {
        self.unless((v.length() - 1.0).abs() <= ROUNDING, place, "it is not a unit vector");
    }

    fn colour(&mut self, place: impl Display, c: DVec3) {
        self.unless(
            c.min_element() >= 0.0 && c.max_element() <= MAX_NUMBER,
            place,
            "it is not a colour of at least 0",
        );
    }

    /// Checks that all of `values`, which are no colours, are from 0 to [`MAX_NUMBER`].
    fn at_least_0(&mut self, place: impl Display, values: &[f64]) {
        let holds = values.iter().all(|x| (0.0..=MAX_NUMBER).contains(x));
        self.unless(holds, place, "it is not a number of at least 0");
    }

    fn size(&mut self, place: impl Display, x: f64) {
        self.unless(x > 0.0 && x <= MAX_NUMBER, place, "it is not a number above 0");
    }

    fn camera(&mut self, camera: &Camera) {
        self.finite("camera.eye", camera.eye);
        for (name, v) in [("right", camera.right), ("up", camera.up), ("forward", camera.forward)] {
            self.unit(format!("camera.{name}"), v);
        }
        let frame = (camera.right.cross(camera.up) + camera.forward).length();
        self.unless(frame <= ROUNDING, "camera", "right × up is not −forward");
        self.unless(
            camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0,
            "camera.fov_y_deg",
            "it is not between 0 and 180",
        );
    }

    fn light(&mut self, place: &str, light: &Light) {
        self.colour(format!("{place}.colour"), light.colour());
        self.colour(format!("{place}.ambient"), light.ambient());
        match light {
            Light::Point { position, attenuation: a, .. } => {
                self.finite(format!("{place}.position"), *position);
                let all = DVec3::new(a.quadratic, a.linear, a.constant);
                self.at_least_0(format!("{place}.attenuation"), &all.to_array());
                self.unless(all != DVec3::ZERO, format!("{place}.attenuation"), "it is all 0");
            }
            Light::Directional { direction, .. } => {
                self.unit(format!("{place}.direction"), *direction)
            }
        }
    }

    fn material(&mut self, place: &str, m: &Material) {
        for (name, colour) in
            [("ke", m.ke), ("ka", m.ka), ("kd", m.kd), ("ks", m.ks), ("kt", m.kt), ("kr", m.kr)]
        {
            self.colour(format!("{place}.{name}"), colour);
        }
        self.at_least_0(format!("{place}.ns"), &[m.ns]);
        self.size(format!("{place}.index"), m.index);
    }

    fn mesh(&mut self, place: &str, mesh: &Mesh) {
        let n = mesh.vertices.len();
        self.unless(mesh.triangles.len().max(n) <= limits::MAX_TRIANGLES, place, "it is too large");
        for vertex in &mesh.vertices {
            self.finite(format_args!("{place}.vertices"), *vertex);
        }
        let reaches = mesh.triangles.iter().flatten().all(|index| (*index as usize) < n);
        self.unless(reaches, format_args!("{place}.triangles"), "an index points at no vertex");
        if let Some(normals) = &mesh.normals {
            self.unless(
                normals.len() == n,
                format_args!("{place}.normals"),
                "they are not one for every vertex",
            );
            for normal in normals {
                self.unit(format_args!("{place}.normals"), *normal);
            }
        }
    }

    fn object(&mut self, place: &str, object: &Object, scene: &Scene) {
        self.unless(
            object.material < scene.materials.len(),
            format!("{place}.material"),
            "it points at no material",
        );
        self.unless(
            transform::is_invertible(&object.world_from_object),
            place,
            "its matrix has no inverse",
        );
        let agree = are_inverse(&object.world_from_object, &object.object_from_world);
        self.unless(agree, place, "object_from_world is not the inverse of world_from_object");
        self.shape(&format!("{place}.shape"), object.shape, scene.meshes.len());
    }

    fn shape(&mut self, place: &str, shape: Shape, n_meshes: usize) {
        match shape {
            Shape::Sphere { center, radius } => {
                self.finite(place, center);
                self.size(place, radius);
            }
            Shape::Plane { normal, k } => {
                self.unit(place, normal);
                self.finite(place, DVec3::splat(k));
            }
            Shape::Square {} => {}
            Shape::Box { min, max } => {
                self.finite(place, min);
                self.finite(place, max);
                self.unless(min.cmplt(max).all(), place, "max is not above min on every axis");
            }
            Shape::Cylinder { radius, z_min, z_max, .. } => {
                self.size(place, radius);
                self.ends(place, z_min, z_max);
            }
            Shape::Cone { bottom_radius, top_radius, z_min, z_max, .. } => {
                self.at_least_0(format!("{place}.bottom_radius"), &[bottom_radius]);
                self.at_least_0(format!("{place}.top_radius"), &[top_radius]);
                self.unless(
                    bottom_radius != top_radius,
                    place,
                    "its radius is the same at both ends",
                );
                self.ends(place, z_min, z_max);
            }
            Shape::Mesh { mesh } => self.unless(mesh < n_meshes, place, "it points at no mesh"),
        }
    }

    fn ends(&mut self, place: &str, z_min: f64, z_max: f64) {
        self.finite(place, DVec3::new(z_min, z_max, 0.0));
        self.unless(z_min < z_max, place, "z_max is not above z_min");
    }
}

/// Returns whether M M⁻¹ is the identity, up to rounding of the terms that are summed.
fn are_inverse(m: &DAffine3, inverse: &DAffine3) -> bool {
    if !m.is_finite() || !inverse.is_finite() {
        return false;
    }
    let product = *m * *inverse;
    let abs = |map: &DAffine3| DAffine3 {
        matrix3: map.matrix3.abs(),
        translation: map.translation.abs(),
    };
    let terms = abs(m) * abs(inverse);
    let near = |found: DVec3, wanted: DVec3, size: DVec3| {
        ((found - wanted).abs()).cmple(ROUNDING * size.max(DVec3::splat(f64::MIN_POSITIVE))).all()
    };
    let (p, t) = (product.matrix3, terms.matrix3);
    near(p.x_axis, DVec3::X, t.x_axis)
        && near(p.y_axis, DVec3::Y, t.y_axis)
        && near(p.z_axis, DVec3::Z, t.z_axis)
        && near(product.translation, DVec3::ZERO, terms.translation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_below_0_is_named_and_not_called_a_colour() {
        let mut found = Found(vec![]);
        let (bottom_radius, top_radius) = (-0.5, 0.0);
        let cone = Shape::Cone { bottom_radius, top_radius, z_min: -0.5, z_max: 0.5, capped: true };
        found.shape("objects[0].shape", cone, 0);
        assert_eq!(found.0, ["objects[0].shape.bottom_radius: it is not a number of at least 0"]);
    }
}
