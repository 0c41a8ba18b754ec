//! Tests of resolving, against numbers computed by hand and against properties.

use std::path::Path;

use cases::glam::{DAffine3, DVec3};
use cases::{Light, Material, Scene, Shape, scene};

const HEAD: &str = "render = { size = [1, 1] }\n[scene]\n\
    materials = { m = { kd = [0.2, 0.3, 0.4] }, n = {} }\n\
    camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0.3, 2, 1], fov_y_deg = 40 }\n";

fn parse(body: &str) -> Scene {
    scene::parse("test", &format!("{HEAD}{body}\n"), Path::new(""), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

/// Returns M of a single sphere under these transforms.
fn matrix(transforms: &str) -> DAffine3 {
    parse(&format!(
        "objects = [{{ sphere = {{}}, material = \"m\", transforms = [{transforms}] }}]"
    ))
    .objects[0]
        .world_from_object
}

#[test]
fn transforms_act_in_the_order_in_which_they_are_listed() {
    let table = [
        ("{ scale = 2 }, { translate = [1, 0, 0] }", [1.0, 2.0, 3.0], [3.0, 4.0, 6.0]),
        ("{ translate = [1, 0, 0] }, { scale = 2 }", [1.0, 2.0, 3.0], [4.0, 4.0, 6.0]),
        ("{ rotate = { axis = [0, 0, 7], angle_deg = 90 } }", [1.0, 2.0, 3.0], [-2.0, 1.0, 3.0]),
        ("{ rotate = { axis = [1, 0, 0], angle_deg = -90 } }", [1.0, 2.0, 3.0], [1.0, 3.0, -2.0]),
        ("{ scale = [1, -2, 0.5] }", [1.0, 2.0, 3.0], [1.0, -4.0, 1.5]),
        ("{ shear = { xy = 0.5, zx = 2 } }", [1.0, 2.0, 3.0], [2.0, 2.0, 5.0]),
        (
            "{ matrix = [[0, 1, 0, 5], [0, 0, 2, 6], [3, 0, 0, 7], [0, 0, 0, 1]] }",
            [1.0, 2.0, 3.0],
            [7.0, 12.0, 10.0],
        ),
    ];
    for (transforms, from, to) in table {
        assert_eq!(matrix(transforms).transform_point3(from.into()).to_array(), to, "{transforms}");
    }
}

#[test]
fn a_group_acts_after_its_objects_and_lends_its_material() {
    let scene = parse(
        "objects = [{ name = \"g\", material = \"m\", transforms = [{ scale = 2 }], group = [\n\
         { sphere = {}, transforms = [{ translate = [1, 0, 0] }] },\n\
         { material = \"n\", group = [{ box = {} }] }] }, { name = \"last\", square = {}, \
         material = \"n\" }]",
    );
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["g[0]", "g[1][0]", "last"]);
    assert_eq!(scene.objects.iter().map(|object| object.material).collect::<Vec<_>>(), [0, 1, 1]);
    assert_eq!(
        scene.objects[0].world_from_object.transform_point3(DVec3::ZERO).to_array(),
        [2.0, 0.0, 0.0]
    );
}

/// Checks that a normal stays perpendicular to its surface: (A⁻ᵀ N)·(A v) = 0 for every v in the
/// surface. [rule 20]
#[test]
fn normals_stay_perpendicular_and_inverses_undo() {
    let transforms = "{ scale = [1, 3, 0.2] }, { rotate = { axis = [1, 2, 3], angle_deg = 77 } }, \
        { shear = { xy = 0.7 } }";
    let scene = parse(&format!(
        "objects = [{{ sphere = {{}}, material = \"m\", transforms = [{transforms}] }}]"
    ));
    let object = &scene.objects[0];
    for normal in [DVec3::X, DVec3::new(1.0, 2.0, -2.0), DVec3::new(0.3, -0.1, 0.9)] {
        let normal = normal.normalize();
        let in_surface = normal.any_orthonormal_vector();
        let there = object.world_from_object.transform_vector3(in_surface);
        assert!((object.normal_matrix() * normal).dot(there).abs() < 1e-13, "{normal}");
        let back = object
            .object_from_world
            .transform_point3(object.world_from_object.transform_point3(normal));
        assert!((back - normal).length() < 1e-13, "{normal}");
    }
}

#[test]
fn the_camera_has_a_right_handed_frame() {
    let camera = parse("").camera;
    assert_eq!(camera.forward, DVec3::NEG_Z);
    assert!((camera.right.cross(camera.up) + camera.forward).length() < 1e-15);
    assert!(camera.up.dot(DVec3::new(0.3, 2.0, 1.0)) > 0.0);
    assert!(camera.right.x > 0.9, "+x is to the right in a view along −z with y up");
}

#[test]
fn what_is_left_out_has_the_documented_default() {
    let scene = parse(
        "lights = [{ point = { position = [0, 0, 0], colour = [1, 1, 1] } }]\n\
         objects = [{ plane = { normal = [0, 2, 0], k = -3 }, material = \"m\" }, { cone = {}, \
         material = \"m\" }]",
    );
    let Light::Point { ambient, attenuation, .. } = &scene.lights[0] else { panic!() };
    assert_eq!(
        (*ambient, attenuation.quadratic, attenuation.linear, attenuation.constant),
        (DVec3::ZERO, 0.0, 0.0, 1.0)
    );
    let Material { ka, kd, ks, kr, ns, index, .. } = &scene.materials[0];
    assert_eq!((ka, kr), (kd, ks));
    assert_eq!((*ns, *index), (0.0, 1.0003));
    assert_eq!(scene.objects[0].shape, Shape::Plane { normal: DVec3::Y, k: -1.5 });
    let cone =
        Shape::Cone { bottom_radius: 0.5, top_radius: 0.0, z_min: -0.5, z_max: 0.5, capped: true };
    assert_eq!(scene.objects[1].shape, cone);
    assert_eq!(
        (scene.render.max_depth, scene.render.threshold, scene.background),
        (0, 0.0, DVec3::ZERO)
    );
}

#[test]
fn one_mesh_file_is_read_once_and_keeps_its_normals_unless_told_otherwise() {
    let mesh = |rest: &str| {
        format!("{{ material = \"m\", mesh = {{ file = \"meshes/read/doubles.ply\"{rest} }} }}")
    };
    let text =
        format!("{HEAD}objects = [{}, {}, {}]\n", mesh(""), mesh(""), mesh(", smooth = false"));
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let scene = scene::parse("test", &text, &base, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let meshes: Vec<Shape> = scene.objects.iter().map(|object| object.shape).collect();
    assert_eq!(meshes, [0, 0, 1].map(|mesh| Shape::Mesh { mesh }));
    let normals = scene.meshes[0].normals.as_ref().unwrap();
    assert_eq!(normals[0], DVec3::Z);
    assert!((normals[1] - DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15);
    assert_eq!(
        scene.meshes[0].vertices[1],
        DVec3::new(1.0, 0.0, 0.1),
        "a double is not rounded on the way"
    );
    assert_eq!(scene.meshes[1].normals, None);
}
