//! Tests against numbers that were computed on paper.

use crate::common::scene;
use cases::Ray;
use cases::probe::{Answer, Ask};
use cases::ray_tree::{self, RayNode};
use glam::DVec3;
use reference::light::lights::Light;
use reference::rules::Lecture;
use reference::trace::answers::answer;
use reference::trace::kernel::{Kernel, Path};
use reference::watch::Recorder;
use reference::world::World;

/// Returns the colour along the ray from (0, 0, 4) in direction −z.
fn ahead(text: &str) -> DVec3 {
    let ray = Ray::new(DVec3::new(0.0, 0.0, 4.0), DVec3::NEG_Z);
    colour(&Ask::Trace { scene: Box::new(scene(text)), ray, depth: 0 })
}

fn colour(ask: &Ask) -> DVec3 {
    match answer(Lecture, ask) {
        Answer::Colour(colour) => colour,
        other => panic!("{other:?} is no colour"),
    }
}

fn check(found: DVec3, paper: [f64; 3]) {
    assert!(found.distance(DVec3::from_array(paper)) < 1e-12, "{found} is not {paper:?}");
}

#[test]
fn a_lit_sphere() {
    // N = L = H = +z, r = 2, A = 1/(4/4 + 1) = 1/2: ke + ka Ia + A I (kd + ks)
    let sphere = r#"
        [scene.materials.m]
        ke = [0.01, 0, 0]
        kd = [0.6, 0.6, 0]
        ks = [0.2, 0, 0.2]
        kr = [0, 0, 0]
        ns = 12
        [[scene.lights]]
        point = { position = [0, 0, 2.5], colour = [1, 1, 1], ambient = [0.1, 0.1, 0.1], attenuation = { quadratic = 0.25, linear = 0, constant = 1 } }
        [[scene.objects]]
        sphere = {}
        material = "m"
    "#;
    check(ahead(sphere), [0.01 + 0.06 + 0.4, 0.06 + 0.3, 0.1]);
}

#[test]
fn a_mirror_shows_the_background_times_kr() {
    let mirror = r#"
        [scene]
        background = [0.2, 0.4, 0.8]
        [scene.materials.m]
        kr = [0.5, 0.5, 0.25]
        [[scene.objects]]
        square = {}
        material = "m"
    "#;
    check(ahead(mirror), [0.1, 0.2, 0.2]);
}

/// Returns the colour between two facing mirrors, each of which emits 1 and reflects half.
fn mirrors(threshold: f64) -> f64 {
    let text = r#"
        [scene.materials.m]
        ke = [1, 1, 1]
        kr = [0.5, 0.5, 0.5]
        [[scene.objects]]
        plane = { normal = [0, 0, 1], k = 0 }
        material = "m"
        [[scene.objects]]
        plane = { normal = [0, 0, -1], k = -5 }
        material = "m"
    "#;
    let mut scene = scene(text);
    scene.render.threshold = threshold;
    scene.effects = cases::effects::called_for(&scene, &cases::Course::default());
    let ray = Ray::new(DVec3::new(0.0, 0.0, 4.0), DVec3::NEG_Z);
    colour(&Ask::Trace { scene: Box::new(scene), ray, depth: 0 }).x
}

#[test]
fn the_end_of_recursion() {
    assert_eq!(mirrors(0.0), 1.0 + 0.5 + 0.25 + 0.125); // max_depth = 3: depths 0 to 3
    assert_eq!(mirrors(0.3), 1.0 + 0.5 + 0.25); // the ray of weight 1/4 spawns no more rays
    assert_eq!(mirrors(0.25), 1.875); // 1/4 is not below 1/4
}

#[test]
fn glass_tints_a_shadow_on_the_way_in_and_on_the_way_out() {
    let text = r#"
        [scene.materials.glass]
        kt = [0.5, 0.25, 1]
        index = 1.5
        [scene.materials.chalk]
        kd = [1, 1, 1]
        [[scene.lights]]
        point = { position = [0, 3, 0], colour = [1, 1, 1] }
        [[scene.objects]]
        sphere = {}
        material = "glass"
        [[scene.objects]]
        sphere = { center = [0, 9, 0] }
        material = "chalk"
    "#;
    let shadow = |x| {
        colour(&Ask::Shadow {
            scene: Box::new(scene(text)),
            light: 0,
            point: DVec3::new(x, -1.0, 0.0),
        })
    };
    check(shadow(0.0), [0.25, 0.0625, 1.0]); // the ball behind the lamp occludes nothing
    check(shadow(4.0), [1.0, 1.0, 1.0]);
}

/// Returns S at (0, 0, −1), for a lamp at (0, 0, 4) and two coincident unit squares between them,
/// at z = 0.
fn behind_squares(materials: [&str; 2]) -> DVec3 {
    let head = "[scene.materials]\nglass = { kt = [0.5, 0.25, 1], index = 1.5 }\n\
        wood = { kd = [1, 1, 1] }\n";
    let lamp = "[[scene.lights]]\npoint = { position = [0, 0, 4], colour = [1, 1, 1] }\n";
    let squares =
        materials.map(|m| format!("[[scene.objects]]\nsquare = {{}}\nmaterial = \"{m}\"\n"));
    let scene = scene(&format!("{head}{lamp}{}", squares.concat()));
    colour(&Ask::Shadow { scene: Box::new(scene), light: 0, point: DVec3::new(0.0, 0.0, -1.0) })
}

#[test]
fn of_two_surfaces_in_one_place_both_count() {
    check(behind_squares(["glass", "glass"]), [0.25, 0.0625, 1.0]);
    check(behind_squares(["glass", "wood"]), [0.0; 3]);
    check(behind_squares(["wood", "glass"]), [0.0; 3]);
}

#[test]
fn from_inside_kt_scales_the_ambient_term_alone() {
    let text = r#"
        [scene.materials.m]
        kd = [0.5, 0.5, 0.5]
        kt = [0.2, 0.4, 0.6]
        index = 1.5
        [[scene.lights]]
        directional = { direction = [0, 0, -1], colour = [1, 1, 1], ambient = [0.1, 0.1, 0.1] }
        [[scene.objects]]
        square = {}
        material = "m"
    "#;
    let shade = |inside| {
        let (normal, to_viewer) = (DVec3::Z, DVec3::Z);
        let scene = Box::new(scene(text));
        colour(&Ask::Shade { scene, object: 0, point: DVec3::ZERO, normal, to_viewer, inside })
    };
    check(shade(false), [0.55, 0.55, 0.55]);
    check(shade(true), [0.51, 0.52, 0.53]);
}

fn tree(text: &str, origin: DVec3, direction: DVec3) -> RayNode {
    let scene = scene(text);
    let world = World::<f64>::new(&scene);
    let kernel = Kernel::new(&world, Lecture, scene.effects);
    let ray = reference::rays::ray::Ray::of(&Ray::new(origin, direction));
    let tree = ray_tree::record(|| {
        kernel.trace(&ray, Path::eye(0), &mut Recorder);
    });
    tree.unwrap()
}

#[test]
fn a_slab_of_glass_shifts_a_ray_and_keeps_its_direction() {
    let slab = r#"
        [scene.materials.glass]
        kt = [1, 1, 1]
        index = 1.5
        [[scene.objects]]
        box = { min = [-9, -1, -9], max = [9, 0, 9] }
        material = "glass"
    "#;
    let d = DVec3::new(0.6, -0.8, 0.0);
    let eye = tree(slab, -d, d); // enters at the origin
    let inside = &eye.children[0];
    let outside = &inside.children[0];
    let sin_t: f64 = 0.6 * 1.0003 / 1.5; // Snell
    let cos_t = (1.0 - sin_t * sin_t).sqrt();
    assert!(inside.direction.distance(DVec3::new(sin_t, -cos_t, 0.0)) < 1e-15);
    assert!(outside.direction.distance(d) < 1e-15);
    let shift = outside.origin.cross(d).length(); // the distance from the line of the incoming ray
    let paper = 0.6 - 0.8 * sin_t / cos_t; // sin(θ_i − θ_t) / cos θ_t, for a thickness of 1
    assert!((shift - paper).abs() < 1e-15, "{shift} is not {paper}");
}

#[test]
fn at_the_critical_angle_a_ray_still_leaves() {
    // sin θ_c = 3/5 between the indices 5 and 3
    let refract = |direction| {
        answer(Lecture, &Ask::Refract { direction, normal: DVec3::Y, eta_i: 5.0, eta_t: 3.0 })
    };
    // No unit vector of doubles has this angle, but (3, −4, 0) does.
    let Answer::Vector(along) = refract(DVec3::new(3.0, -4.0, 0.0)) else {
        panic!("exactly critical is transmitted")
    };
    assert!(along.distance(DVec3::X) < 1e-15, "{along}");
    assert_eq!(refract(DVec3::new(0.61, -(1.0f64 - 0.61 * 0.61).sqrt(), 0.0)), Answer::Miss(true));
}

#[test]
fn a_mirrored_ray_that_would_enter_the_object_is_mirrored_by_the_geometric_normal() {
    let direction = DVec3::new(0.8, -0.6, 0.0);
    let reflect =
        |n_shading| answer(Lecture, &Ask::SmoothReflect { direction, n_geom: DVec3::Y, n_shading });
    // Reflected about (0.8, 0.6, 0), the ray would have the direction (0.352, −0.936, 0), below the
    // surface.
    assert_eq!(reflect(DVec3::new(0.8, 0.6, 0.0)), Answer::Vector(DVec3::new(0.8, 0.6, 0.0)));
    let Answer::Vector(kept) = reflect(DVec3::new(-0.6, 0.8, 0.0)) else {
        panic!("a reflected ray always exists")
    };
    assert!(kept.distance(DVec3::new(-0.352, 0.936, 0.0)) < 1e-15, "{kept}"); // d·N = −0.96
}

/// Checks the limit of 1/(a r² + b r + c). A term with the coefficient 0 stays 0 for any r, and any
/// other term becomes infinite.
#[test]
fn attenuation_has_its_limit_infinitely_far_away() {
    let table = [
        ([1.0, 0.0, 0.0], f64::INFINITY, 0.0),
        ([0.0, 1.0, 0.0], f64::INFINITY, 0.0),
        ([1.0, 1.0, 1.0], f64::INFINITY, 0.0),
        ([0.0, 0.0, 4.0], f64::INFINITY, 0.25),
        ([0.0, 0.0, 0.25], f64::INFINITY, 1.0),
        ([0.0, 0.0, 1.0], f64::INFINITY, 1.0),
        // r² overflows, r does not.
        ([0.0, 1e-200, 0.0], 1e200, 1.0),
        ([0.0, 4e-200, 0.0], 1e200, 0.25),
        ([0.0, 0.0, 4.0], 1e200, 0.25),
    ];
    for ([quadratic, linear, constant], r, expected) in table {
        let attenuation = cases::scene::Attenuation { quadratic, linear, constant };
        let (position, colour, ambient) = (DVec3::ZERO, DVec3::ONE, DVec3::ZERO);
        let light = cases::Light::Point { position, colour, ambient, attenuation };
        let found = answer(Lecture, &Ask::Attenuation { light: light.clone(), r });
        assert_eq!(found, Answer::Value(expected), "{attenuation:?} at {r}");
        if r.is_infinite() {
            let single = Light::<f32>::of(&light).attenuation(Lecture, f32::INFINITY, &mut ());
            assert_eq!(f64::from(single), expected, "{attenuation:?} in f32");
        }
    }
}
