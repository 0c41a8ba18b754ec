//! Tests of pictures that must not depend on the place or the size of a scene, and of pictures that
//! would show every wrong hit.

use std::path::Path;

use crate::common::{SCALES, moved, picture, scene};
use cases::film::{Image, level};
use cases::scene::Attenuation;
use cases::{Light, Scene, Shape, stage};
use glam::DVec3;
use rayon::prelude::*;
use reference::rules::{Formula, Rules};
use reference::trace::render::{Options, render_by};
use reference::world::World;

/// Returns the ids and the scenes of the public cases, in a small size.
fn cases() -> Vec<(String, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let stages = stage::load_all(&folder, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let small = |mut case: stage::Case| {
        (case.scene.render.width, case.scene.render.height) = (64, 48);
        (case.id, case.scene)
    };
    let all: Vec<_> = stages.into_iter().flat_map(|stage| stage.cases).map(small).collect();
    assert!(all.len() > 20, "only {} cases", all.len());
    all
}

/// Returns the scene `k` times as large, with attenuation adjusted, so that the picture is the
/// same. An object without a transform gets none.
fn scaled(scene: &Scene, k: f64) -> Scene {
    let mut scene = scene.clone();
    scene.camera.eye *= k;
    for light in &mut scene.lights {
        if let Light::Point { position, attenuation, .. } = light {
            *position *= k;
            let Attenuation { quadratic, linear, .. } = attenuation;
            (*quadratic, *linear) = (*quadratic / (k * k), *linear / k);
        }
    }
    let mut grown = vec![false; scene.meshes.len()];
    for object in &mut scene.objects {
        let needs_frame =
            matches!(object.shape, Shape::Square {}) || is_shared(object.shape, &grown);
        if object.is_untransformed() && !needs_frame {
            grow(&mut object.shape, k);
            if let Shape::Mesh { mesh } = object.shape {
                grown[mesh] = true;
                scene.meshes[mesh].vertices.iter_mut().for_each(|v| *v *= k);
            }
            continue;
        }
        let of_shape = if is_shared(object.shape, &grown) { 1.0 } else { k };
        let (forth, back) = (&mut object.world_from_object, &mut object.object_from_world);
        (forth.matrix3, forth.translation) = (forth.matrix3 * of_shape, forth.translation * k);
        // If the mesh has grown with the world, the inverse keeps its matrix.
        let (of_matrix, of_rest) = if of_shape == 1.0 { (1.0, k) } else { (1.0 / k, 1.0) };
        (back.matrix3, back.translation) = (back.matrix3 * of_matrix, back.translation * of_rest);
    }
    scene
}

fn is_shared(shape: Shape, grown: &[bool]) -> bool {
    matches!(shape, Shape::Mesh { mesh } if grown[mesh])
}

fn grow(shape: &mut Shape, k: f64) {
    match shape {
        Shape::Sphere { center, radius } => (*center, *radius) = (*center * k, *radius * k),
        Shape::Plane { k: distance, .. } => *distance *= k,
        Shape::Box { min, max } => (*min, *max) = (*min * k, *max * k),
        Shape::Cylinder { radius, z_min, z_max, .. } => {
            (*radius, *z_min, *z_max) = (*radius * k, *z_min * k, *z_max * k)
        }
        Shape::Cone { bottom_radius, top_radius, z_min, z_max, .. } => {
            (*bottom_radius, *top_radius) = (*bottom_radius * k, *top_radius * k);
            (*z_min, *z_max) = (*z_min * k, *z_max * k);
        }
        Shape::Square {} | Shape::Mesh { .. } => {}
    }
}

/// Returns the number of pixels with a byte that differs.
fn n_differing(one: &Image, other: &Image) -> usize {
    let bytes = |light: &DVec3| light.to_array().map(|x| level(x.clamp(0.0, 1.0)).round());
    one.pixels().iter().zip(other.pixels()).filter(|(a, b)| bytes(a) != bytes(b)).count()
}

#[test]
fn a_scene_scaled_by_a_power_of_two_gives_the_same_bits() {
    cases().par_iter().for_each(|(id, scene)| {
        let right = picture::<f64>(scene);
        for k in [1_048_576.0, 1.0 / 1_048_576.0] {
            assert_eq!(
                picture::<f64>(&scaled(scene, k)).pixels(),
                right.pixels(),
                "{id} scaled by {k}"
            );
        }
    });
}

#[test]
fn a_scene_scaled_or_moved_by_a_million_gives_the_same_bytes() {
    cases().par_iter().for_each(|(id, scene)| {
        let right = picture::<f64>(scene);
        for k in [1e6, 1e-6] {
            assert_eq!(
                n_differing(&picture::<f64>(&scaled(scene, k)), &right),
                0,
                "{id} scaled by {k}"
            );
        }
        let by = DVec3::new(1e6, -1e6, 1e6);
        assert_eq!(
            n_differing(&picture::<f64>(&moved(scene, by)), &right),
            0,
            "{id} moved by {by}"
        );
    });
}

/// Two facing mirrors, of which one glows. Each pixel is the sum of every second term of a
/// geometric series, so a hit too many or too few would give the other terms.
#[test]
fn a_hall_of_mirrors_is_a_geometric_series() {
    const DEPTH: u32 = 50;
    const RHO: f64 = 0.9;
    for scale in SCALES {
        let text = format!(
            "[scene.materials.glows]\nke = [1, 1, 1]\nkr = [{RHO}, {RHO}, {RHO}]\n\
                [scene.materials.dark]\nkr = [{RHO}, {RHO}, {RHO}]\n\
             [[scene.objects]]\nplane = {{ normal = [0, 0, 1], k = {} }}\nmaterial = \"glows\"\n\
             [[scene.objects]]\nplane = {{ normal = [0, 0, -1], k = {} }}\nmaterial = \"dark\"\n",
            -1.3 * scale,
            -5.7 * scale,
        );
        let mut scene = scene(&text);
        scene.camera.eye *= scale;
        scene.render.max_depth = DEPTH;
        let series = |from: u32| {
            (from..=DEPTH).step_by(2).map(|n| cases::maths::pow(RHO, f64::from(n))).sum::<f64>()
        };
        for pixel in picture::<f64>(&scene).pixels() {
            assert!(
                (pixel.x - series(0)).abs() < 1e-12,
                "at scale {scale:e}: {pixel} is not {}",
                series(0)
            );
        }
        for pixel in picture::<f32>(&scene).pixels() {
            assert!(
                (pixel.x - series(0)).abs() < 1e-5,
                "at scale {scale:e} in f32: {pixel} is not {}",
                series(0)
            );
        }
    }
}

/// Returns two balls on a ground of this radius.
fn on_a_ball(radius: f64) -> Scene {
    let mut scene = scene(&format!(
        "[scene]\nmaterials = {{ chalk = {{ kd = [0.7, 0.6, 0.5] }} }}\n\
        lights = [{{ point = {{ position = [3, 6, 4], colour = [1, 1, 1] }} }}]\nobjects = [\n\
        {{ sphere = {{ center = [-1.2, 0.9, -4], radius = 0.8 }}, material = \"chalk\" }},\n\
        {{ sphere = {{ center = [1.2, 0.9, -3], radius = 0.8 }}, material = \"chalk\" }},\n\
        {{ sphere = {{ center = [0, {0}, 0], radius = {radius} }}, material = \"chalk\" }}]\n",
        -radius - 1.0
    ));
    (scene.render.width, scene.render.height) = (160, 120);
    scene
}

#[test]
fn single_precision_is_right_on_a_large_ball_where_plain_formulas_are_not() {
    for radius in [1e2, 1e4, 1e6] {
        let scene = on_a_ball(radius);
        let (single, double) = (World::<f32>::new(&scene), World::<f64>::new(&scene));
        let rules = Rules::LECTURE;
        let truth = render_by(&double, &rules, &Options::of(&double), |_| {}).0;
        let n_off = |rules: &Rules| {
            let picture = render_by(&single, rules, &Options::of(&single), |_| {}).0;
            let levels = |light: &DVec3| light.to_array().map(level);
            let is_off = |(one, other): (&DVec3, &DVec3)| {
                levels(one).iter().zip(levels(other)).any(|(a, b)| (a - b).abs() > 1.0)
            };
            picture.pixels().iter().zip(truth.pixels()).filter(|pair| is_off(*pair)).count()
        };
        let (robust, plain) = (n_off(&rules), n_off(&Formula::Plain.rules(&rules)));
        println!("radius {radius:e}: {robust} pixels are off, {plain} by plain formulas");
        assert_eq!(robust, 0, "radius {radius:e}");
        assert!(radius < 1e6 || plain > 20, "radius {radius:e}: the plain formulas are right");
    }
}
