//! Exports a scene to the formats of other renderers, as closely as each allows: the same camera,
//! shapes, lights and depth.

pub mod mitsuba;
pub mod pov;
pub mod tachyon;

use cases::glam::DVec3;
use cases::{Material, Object, Scene, Shape, maths};

/// A file for a renderer: its name and its bytes.
pub type File = (String, Vec<u8>);

/// A shape that every renderer here supports.
enum Known<'a> {
    Sphere { center: DVec3, radius: f64 },
    Mesh(&'a cases::Mesh),
}

/// Returns the shape of an object. It is an error if the shape is neither a sphere nor an
/// untransformed mesh.
fn known<'a>(scene: &'a Scene, object: &Object) -> Result<Known<'a>, String> {
    match object.shape {
        Shape::Sphere { center, radius } => Ok(Known::Sphere { center, radius }),
        Shape::Mesh { mesh } if object.is_untransformed() => Ok(Known::Mesh(&scene.meshes[mesh])),
        _ => Err(format!("`{}` is neither a sphere nor an untransformed mesh", object.name)),
    }
}

/// Returns half the height of the view plane at distance 1. [rule 1]
fn half_height(scene: &Scene) -> f64 {
    maths::tan(scene.camera.fov_y_deg.to_radians() / 2.0)
}

/// Returns the width of the picture divided by its height.
fn aspect(scene: &Scene) -> f64 {
    f64::from(scene.render.width) / f64::from(scene.render.height)
}

/// Returns the centre and the radius of the sphere of the same volume in world space, for renderers
/// without ellipsoids.
fn as_sphere(object: &Object, center: DVec3, radius: f64) -> (DVec3, f64) {
    let m = object.world_from_object;
    (m.transform_point3(center), radius * maths::pow(m.matrix3.determinant().abs(), 1.0 / 3.0))
}

/// Returns the mean of the three channels.
fn mean(colour: DVec3) -> f64 {
    (colour.x + colour.y + colour.z) / 3.0
}

/// Returns the sum of the ambient light of all lights. [rule 3]
fn ambient(scene: &Scene) -> DVec3 {
    scene.lights.iter().map(cases::Light::ambient).sum()
}

/// Returns the index of a material relative to the air around it, which has the index of rule 9.
fn relative_index(material: &Material) -> f64 {
    const AIR: f64 = 1.0003;
    material.index / AIR
}

/// Formats three numbers with `between` between them. None is −0.
fn numbers(v: DVec3, between: &str) -> String {
    let v = v + DVec3::ZERO;
    format!("{}{between}{}{between}{}", v.x, v.y, v.z)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A tiny scene with a triangle, a transformed sphere, and glass. The eye is at (0, 0, 5),
    /// looks along −z, and is upright. Half the height of the view plane is 1.
    const TINY: &str = "
        [render]\nsize = [8, 4]\nmax_depth = 3\n[scene]\nbackground = [0.5, 0, 0.25]
        [scene.camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 90
        [scene.materials]\nchalk = { kd = [0.5, 0.25, 0.75] }
        glass = { kd = [0.2, 0.2, 0.2], ks = [0.5, 0.5, 0.5], ns = 50, kt = [0.75, 0.75, 0.75], \
        index = 1.50045 }
        [[scene.lights]]\npoint = { position = [1, 2, 3], colour = [1, 0.5, 0.25], ambient = \
        [0.125, 0, 0] }
        [[scene.lights]]\ndirectional = { direction = [0, -2, 0], colour = [0.5, 0.5, 0.5] }
        [[scene.objects]]\nmesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = \
        [[0, 1, 2]] }\nmaterial = \"chalk\"
        [[scene.objects]]\nsphere = {}\nmaterial = \"glass\"\n\
        transforms = [{ scale = [1, 2, 4] }, { translate = [7, 8, 9] }]
    ";

    fn text(export: fn(&Scene) -> Result<Vec<File>, String>) -> String {
        let scene = cases::scene::parse("tiny", TINY, Path::new("."), &cases::Course::default())
            .expect("it is valid");
        let files = export(&scene).expect("it can be exported");
        String::from_utf8(files.into_iter().next().expect("a scene").1).expect("text")
    }

    /// Checks that `text` holds each of `parts`, and in that order.
    fn check(text: &str, parts: &[&str]) {
        let mut rest = text;
        for part in parts {
            rest = rest
                .split_once(part)
                .unwrap_or_else(|| panic!("no `{part}` in the rest:\n{rest}"))
                .1;
        }
    }

    #[test]
    fn a_scene_reaches_pov_ray_with_its_own_camera_and_depth() {
        // The view plane at distance 1 is 4 wide and 2 high. A depth of 3 is a trace level of 3.
        let parts = [
            "max_trace_level 3",
            "background { color rgb <0.5,0,0.25> }",
            "location <0,0,5>",
            "right <4,0,0>",
            "up <0,2,0>",
            "direction <0,0,-1>",
            "light_source { <1,2,3> color rgb <1,0.5,0.25> }",
            "<0,1000000,0>",
            "parallel",
            "vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> }",
            "face_indices { 1, <0,1,2> }",
            "rgb <0.5,0.25,0.75>",
            "sphere { <0,0,0>, 0.5",
            "transmit 0.75",
            "ior 1.5",
            "matrix <1,0,0,0,2,0,0,0,4,7,8,9>",
        ];
        check(&text(pov::export), &parts);
    }

    #[test]
    fn a_scene_reaches_tachyon_with_its_depth_turned_to_the_left_hand() {
        let parts = [
            "RESOLUTION 8 4",
            "ZOOM 0.5",
            "RAYDEPTH 4",
            "CENTER 0 0 -5",
            "VIEWDIR 0 0 1",
            "UPDIR 0 1 0",
            "LIGHT CENTER 1 2 -3",
            "DIRECTION 0 -1 0",
            "BACKGROUND 0.5 0 0.25",
            "TRI V0 0 0 0 V1 0 1 0 V2 1 0 0",
            "SPHERE CENTER 7 8 -9 RAD 1",
        ];
        check(
            &text(tachyon::export)
                .replace("0.5000000000000001", "0.5")
                .replace("0.49999999999999994", "0.5"),
            &parts,
        );
    }

    #[test]
    fn a_scene_reaches_mitsuba_with_its_camera() {
        let parts = [
            "name=\"fov\" value=\"90\"",
            "origin=\"0, 0, 5\"",
            "name=\"width\" value=\"8\"",
            "name=\"height\" value=\"4\"",
            "dielectric",
            "1.5",
            "mesh_0.ply",
            "\"sphere\"",
            "x=\"7\" y=\"8\" z=\"9\"",
            "name=\"radius\" value=\"1\"",
        ];
        check(&text(mitsuba::export), &parts);
    }

    #[test]
    fn a_shape_that_the_others_lack_is_refused() {
        let text = TINY.replace("sphere = {}", "square = {}");
        let scene = cases::scene::parse("tiny", &text, Path::new("."), &cases::Course::default())
            .expect("it is valid");
        for export in [pov::export, tachyon::export, mitsuba::export] {
            assert!(export(&scene).expect_err("it has a square").contains("objects[1]"));
        }
    }
}
