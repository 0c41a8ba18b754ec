//! Tests of work that is left out because it provably changes nothing: pictures keep their bits,
//! and the work is not done.

use cases::course::Course;
use cases::film::Image;
use cases::scene::Attenuation;
use cases::{Light, Scene, Shape};
use glam::DVec3;
use rayon::prelude::*;
use reference::numbers::real::Real;
use reference::rules::{Rules, SquareSize, Weights};
use reference::trace::render::{Options, count_by};
use reference::watch::Counts;
use reference::watch::work::Amounts;
use reference::world::World;

use crate::common::{Random, random, scene};

fn counted<T: Real>(scene: &Scene, rules: &Rules) -> (Image, Counts, Amounts) {
    let world = World::<T>::new(scene);
    let (image, stats, work) = count_by(&world, rules, &Options::of(&world), |_| {});
    (image, stats.rays, work)
}

/// Returns a random scene without meshes, with one lamp more in every other one. Its light is so
/// faint that it may vanish beside the light of others, or may not.
fn solids(random: &mut Random, course: &Course) -> Scene {
    let mut scene = loop {
        let scene = random::scene(random, course);
        if !scene.objects.iter().any(|object| matches!(object.shape, Shape::Mesh { .. })) {
            break scene;
        }
    };
    if random.is(0.5) {
        let constant = cases::maths::pow(10.0, 4.0 + 20.0 * random.share());
        scene.lights.insert(
            0,
            Light::Point {
                position: random.unit() * 5.0,
                colour: DVec3::splat(0.9),
                ambient: DVec3::ZERO,
                attenuation: Attenuation { quadratic: 0.0, linear: 0.0, constant },
            },
        );
        scene.effects = cases::effects::called_for(&scene, course);
    }
    scene
}

/// The weights of a triangle's vertices matter to no scene without meshes. Rules that exchange them
/// compute the same pictures, but no proof holds for them, so that all work is done.
fn without_proofs(rules: &Rules) -> Rules {
    let rules = Rules { weights: Weights::Swapped, ..*rules };
    assert!(!rules.is_proven());
    rules
}

fn pictures_keep_their_bits<T: Real>() {
    let done: Vec<Amounts> = (1..=1000u64)
        .into_par_iter()
        .map(|seed| {
            let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            let course = random::course(&mut random);
            let scene = solids(&mut random, &course);
            // Other choices of normals for spawned rays are allowed, but nothing is proven there.
            let Rules { inside_by, reflect_by, refract_by, .. } = Rules::LECTURE;
            let rules = Rules { inside_by, reflect_by, refract_by, ..Rules::of(&course) };
            let (image, _, work) = counted::<T>(&scene, &rules);
            let (whole, _, all_work) = counted::<T>(&scene, &without_proofs(&rules));
            let bits = |image: &Image| -> Vec<[u64; 3]> {
                image.pixels().iter().map(|light| light.to_array().map(f64::to_bits)).collect()
            };
            assert!(bits(&image) == bits(&whole), "seed {seed}: {:?}", course.written());
            let skipped =
                |work: &Amounts| work.sure_misses + work.untinted_rays + work.vanishing_lights;
            assert_eq!(skipped(&all_work), 0, "seed {seed}");
            work
        })
        .collect();
    let n_scenes = |of: fn(&Amounts) -> u64| done.iter().filter(|work| of(work) > 0).count();
    let counts = [
        n_scenes(|work| work.sure_misses),
        n_scenes(|work| work.untinted_rays),
        n_scenes(|work| work.vanishing_lights),
    ];
    println!("misses, untinted rays and vanishing lights in {counts:?} of 1000 scenes");
    assert!(counts.iter().all(|n| *n >= 10), "the test is vacuous: {counts:?}");
}

#[test]
fn work_that_is_left_out_changes_no_bit_in_double_precision() {
    pictures_keep_their_bits::<f64>();
}

#[test]
fn work_that_is_left_out_changes_no_bit_in_single_precision() {
    pictures_keep_their_bits::<f32>();
}

/// Returns a scene with a triangle alone, which mirrors, has random normals at its corners, and is
/// seen between two lamps.
fn lone_triangle(random: &mut Random) -> Scene {
    let mut corner = |z: f64| random.unit() * 2.0 + DVec3::Z * z;
    let corners = [corner(0.0), corner(1.0), corner(-1.0)];
    let normals = [random.unit(), random.unit(), random.unit()];
    let list = |all: &[DVec3]| {
        let one = |v: &DVec3| format!("[{}, {}, {}]", v.x, v.y, v.z);
        all.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    let lamp = |at: DVec3| {
        format!("[[scene.lights]]\npoint = {{ position = {}, colour = [1, 1, 1] }}\n", list(&[at]))
    };
    let lamps = lamp(random.unit() * 5.0) + &lamp(random.unit() * 5.0);
    let (corners, normals) = (list(&corners), list(&normals));
    scene(&format!(
        "[scene.materials]\nsteel = {{ kd = [0.4, 0.4, 0.4], kr = [0.5, 0.5, 0.5] }}\n{lamps}\
         [[scene.objects]]\nmesh = {{ vertices = [{corners}], triangles = [[0, 1, 2]], \
         normals = [{normals}] }}\nmaterial = \"steel\"\n"
    ))
}

/// No ray that leaves the only triangle of a scene hits anything. The size of squares does not
/// matter to it, but no proof holds for rules with another one.
#[test]
fn a_lone_triangle_is_left_by_no_ray() {
    let rules = Rules { square: SquareSize::One, ..Rules::LECTURE };
    let mut n_rays = [0; 2];
    for seed in 1..=200u64 {
        let scene = lone_triangle(&mut Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
        let (image, rays, work) = counted::<f64>(&scene, &Rules::LECTURE);
        let (whole, all_rays, _) = counted::<f64>(&scene, &rules);
        assert!(image == whole, "seed {seed}");
        assert_eq!(rays.shadow + rays.reflected, 0, "seed {seed}");
        assert_eq!(work.sure_misses, all_rays.shadow + all_rays.reflected, "seed {seed}");
        n_rays[0] += all_rays.shadow;
        n_rays[1] += all_rays.reflected;
    }
    assert!(n_rays.iter().all(|n| *n > 1000), "the test is vacuous: {n_rays:?}");
}

/// A lamp of 1e-18 beside one of 1/2: no shadow ray goes to the faint one. Alone it is all there is
/// to see, and is followed.
#[test]
fn a_lamp_vanishes_beside_a_brighter_one_and_not_alone() {
    let lamp = |attenuation: &str| {
        format!(
            "[[scene.lights]]\npoint = {{ position = [0, 0, 9], colour = [1, 1, 1], ambient = [0, \
                0, 0]{attenuation} }}\n"
        )
    };
    let faint = lamp(", attenuation = { constant = 1e18 }");
    let objects = "[scene.materials]\nchalk = { kd = [0.5, 0.5, 0.5] }\n[[scene.objects]]\n\
        plane = { normal = [0, 0, 1], k = 0 }\nmaterial = \"chalk\"\n[[scene.objects]]\n\
        sphere = { center = [0, 0, -9] }\nmaterial = \"chalk\"\n";
    let counts = |lights: &str| {
        let (_, rays, work) =
            counted::<f64>(&scene(&format!("{objects}{lights}")), &Rules::LECTURE);
        assert_eq!(rays.eye, 24 * 18);
        [rays.shadow / rays.eye, work.vanishing_lights / rays.eye]
    };
    assert_eq!(counts(&lamp("")), [1, 0]);
    assert_eq!(counts(&format!("{}{faint}", lamp(""))), [1, 1]);
    assert_eq!(counts(&format!("{faint}{}", lamp(""))), [1, 1]);
    assert_eq!(counts(&faint), [1, 0]);
    assert_eq!(counts(&lamp(", attenuation = { constant = 1e15 }")), [1, 0]);
}
