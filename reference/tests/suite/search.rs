//! Tests of the search. Trees find the hits of a scan over all objects, bit for bit; the number of
//! threads changes nothing; single precision is close to double.

use std::fmt::Write;

use crate::common::{Random, scene};
use cases::Effect;
use cases::film::level;
use glam::{DAffine3, DVec3};
use reference::lanes::Lanes;
use reference::numbers::real::Real;
use reference::numbers::vec3::Vec3;
use reference::rays::camera::Lens;
use reference::rays::ray::Ray;
use reference::rules::Lecture;
use reference::trace::render::{Options, render};
use reference::watch::work::Amounts;
use reference::world::search::Crossings;
use reference::world::{Search, World};

/// Returns a scene of many random shapes, and a mesh whose triangles share edges. Some triangles
/// have no area.
fn disorder(random: &mut Random) -> cases::Scene {
    let mut text = String::from(
        "[scene.materials.m]\nkd = [0.5, 0.6, 0.7]\n[[scene.lights]]\n\
            directional = { direction = [0, -1, -1], colour = [1, 1, 1] }\n",
    );
    let shapes = [
        "sphere = {}",
        "square = {}",
        "box = {}",
        "cylinder = {}",
        "cone = {}",
        "cone = { bottom_radius = 0.2, top_radius = 0.4, capped = false }",
        "plane = { normal = [0, 1, 0.5], k = -4 }",
    ];
    for n in 0..30 {
        let mut number = |scale: f64| random.signed() * scale;
        let at = [number(2.0), number(2.0), number(2.0)];
        let (turn, size) = (number(180.0), 0.3 + number(0.25));
        let shape = shapes[n % shapes.len()];
        write!(
            text,
            "[[scene.objects]]\n{shape}\nmaterial = \"m\"\n\
                transforms = [{{ scale = [{size}, 0.5, {size}] }}, {{ rotate = {{ axis = [1, 2, \
                3], angle_deg = {turn} }} }}, {{ translate = {at:?} }}]\n"
        )
        .unwrap();
    }
    let vertices: Vec<[f64; 3]> =
        (0..60).map(|_| [random.signed(), random.signed(), random.signed()]).collect();
    let triangles: Vec<[usize; 3]> =
        (0..58).map(|i| [i, i + 1, if i % 9 == 0 { i } else { i + 2 }]).collect();
    write!(
        text,
        "[[scene.objects]]\nmaterial = \"m\"\n\
            mesh = {{ vertices = {vertices:?}, triangles = {triangles:?} }}\n"
    )
    .unwrap();
    scene(&text)
}

/// Returns a scene of flat shapes along the axes, coincident or side by side: bounding boxes
/// without thickness, touching faces, coincident triangles.
fn order() -> cases::Scene {
    let mut text = String::from("[scene.materials.m]\nkd = [0.5, 0.6, 0.7]\n");
    for n in 0..16 {
        let (x, y) = (n % 4 - 2, n / 4 - 2);
        let shape = match n % 3 {
            0 => format!("box = {{ min = [{x}, {y}, 0], max = [{}, {}, 1] }}", x + 1, y + 1),
            1 => format!("square = {{}}\ntransforms = [{{ translate = [{x}.5, {y}.5, 0] }}]"),
            _ => format!(
                "mesh = {{ vertices = [[{x}, {y}, 0], [{0}, {y}, 0], [{0}, {1}, 0], [{x}, {1}, \
                    0]], triangles = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [2, 1, 0]] }}",
                x + 1,
                y + 1
            ),
        };
        for _ in 0..2 {
            write!(text, "[[scene.objects]]\nmaterial = \"m\"\n{shape}\n").unwrap();
        }
    }
    scene(&text)
}

/// A world with every way to search it: a scan, and a tree for each instruction set.
struct Ways<T> {
    scan: World<T>,
    trees: Vec<World<T>>,
}

impl<T: Real> Ways<T> {
    fn of(scene: &cases::Scene) -> Self {
        let scan = World::with_search(scene, Search::Scan);
        let tree = World::with_search(scene, Search::Tree);
        Self {
            scan,
            trees: Lanes::all().into_iter().map(|lanes| tree.clone().with_lanes(lanes)).collect(),
        }
    }

    /// Returns whether the ray hits anything. Checks that every search finds the same hits, bit for
    /// bit, and that all trees take equal steps.
    fn intersects(&self, ray: &Ray<T>) -> bool {
        let search = |world: &World<T>| {
            let mut work = Amounts::default();
            let hit = format!("{:?}", world.nearest(Lecture, ray, &mut work));
            let is_hit = world.occluded(Lecture, ray, &mut work);
            let mut crossings = Crossings::none();
            assert!(
                world.crossings(Lecture, ray, |_| false, &mut crossings, &mut work),
                "nothing blocks {ray:?}"
            );
            ((hit, is_hit, format!("{crossings:?}")), work)
        };
        let (found, _) = search(&self.scan);
        let steps: Vec<Amounts> = self
            .trees
            .iter()
            .map(|tree| {
                let (by_tree, work) = search(tree);
                assert_eq!(by_tree, found, "along {ray:?}");
                work
            })
            .collect();
        assert!(steps.iter().all(|one| *one == steps[0]), "{steps:?} along {ray:?}");
        found.1
    }
}

fn trees_find_what_lists_find_among_flat_shapes<T: Real>() {
    let ways = Ways::<T>::of(&order());
    let places = [-3.0, -2.0, -1.5, -1.0, -0.0, 0.0, 0.25, 0.5, 1.0, 2.0];
    let steps = [-1.0, -0.0, 0.0, 1.0];
    let three = |list: &[f64]| -> Vec<DVec3> {
        let pairs = list.iter().flat_map(|x| list.iter().map(move |y| (*x, *y)));
        pairs.flat_map(|(x, y)| list.iter().map(move |z| DVec3::new(x, y, *z))).collect()
    };
    let mut n_hits = 0;
    for direction in three(&steps).into_iter().filter(|d| *d != DVec3::ZERO) {
        for origin in three(&places) {
            let ray = Ray::leaving(Lecture, Vec3::of(origin), Vec3::of(direction));
            n_hits += usize::from(ways.intersects(&ray));
        }
    }
    assert!(n_hits > 5000, "only {n_hits} rays hit anything: the test is vacuous");
}

#[test]
fn trees_find_what_lists_find_along_axes_and_within_planes() {
    trees_find_what_lists_find_among_flat_shapes::<f64>();
    trees_find_what_lists_find_among_flat_shapes::<f32>();
}

#[test]
fn trees_find_what_lists_find_from_afar() {
    let ways = Ways::<f64>::of(&order());
    let mut n_hits = 0;
    for (axis, distance) in
        (0..3).flat_map(|axis| [1e3_f64, -1e5, 1e7, -1e9].map(|distance| (axis, distance)))
    {
        let mut direction = DVec3::ZERO;
        direction[axis] = -distance.signum();
        for (a, b) in
            (-8..=8).flat_map(|a| (-8..=8).map(move |b| (f64::from(a) / 4.0, f64::from(b) / 4.0)))
        {
            let mut origin = DVec3::splat(distance);
            (origin[(axis + 1) % 3], origin[(axis + 2) % 3]) = (a, b);
            n_hits += usize::from(ways.intersects(&Ray::leaving(
                Lecture,
                Vec3::of(origin),
                Vec3::of(direction),
            )));
        }
    }
    assert!(n_hits > 1000, "only {n_hits} rays hit anything: the test is vacuous");
}

#[test]
fn trees_find_what_lists_find_however_long_the_direction() {
    let ways = Ways::<f64>::of(&order());
    let mut random = Random(0x1e_46_7b);
    let mut n_hits = 0;
    for n in 0..4000 {
        let size = [1e-308, 4.6e-308, 1e-292, 1e-280, 1e-100, 1e100, 1e280, 1e300][n % 8];
        let slopes = DVec3::new(
            1.0,
            [0.12, 0.01, 1e-9][n % 3],
            if n % 2 == 0 { 0.0 } else { random.signed() },
        );
        let origin = DVec3::new(-3.0, random.signed() * 2.0, random.signed());
        n_hits += usize::from(ways.intersects(&Ray::leaving(
            Lecture,
            Vec3::of(origin),
            Vec3::of(slopes * size),
        )));
    }
    assert!(n_hits > 1000, "only {n_hits} rays hit anything: the test is vacuous");
}

fn trees_find_what_lists_find<T: Real>() {
    let mut random = Random(0x0dd_b1a5_ed00_d1ce);
    let mut n_hits = 0;
    for _ in 0..8 {
        let scene = disorder(&mut random);
        let ways = Ways::<T>::of(&scene);
        let vertices = &scene.meshes[0].vertices;
        for n in 0..1500 {
            let origin = random.unit() * 4.0;
            // Half of the rays have a random direction, the other half go straight at a vertex,
            // where several triangles tie.
            let direction = if n % 2 == 0 {
                random.unit()
            } else {
                (vertices[n % vertices.len()] - origin).normalize()
            };
            let ray = Ray::leaving(Lecture, Vec3::of(origin), Vec3::of(direction));
            n_hits += usize::from(ways.intersects(&ray));
        }
    }
    assert!(n_hits > 3000, "only {n_hits} rays hit anything: the test is vacuous");
}

#[test]
fn trees_find_what_lists_find_in_double_precision() {
    trees_find_what_lists_find::<f64>();
}

#[test]
fn trees_find_what_lists_find_in_single_precision() {
    trees_find_what_lists_find::<f32>();
}

/// The eye rays of all public cases, and from each hit a ray in a random direction.
#[test]
fn trees_find_what_lists_find_in_every_public_case() {
    let stages = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let mut random = Random(0x0ca_5e5);
    let (mut n_scenes, mut n_hits) = (0, 0);
    for stage in cases::stage::load_all(&stages, &cases::Course::default()).unwrap() {
        for case in &stage.cases {
            let (ways, camera) = (Ways::<f64>::of(&case.scene), case.scene.camera);
            let lens = Lens::<f64>::new(Lecture, &camera, 12, 9);
            n_scenes += 1;
            for pixel in (0..12).flat_map(|i| (0..9).map(move |j| (i, j))) {
                let ray = lens.eye_ray(Lecture, pixel, (random.share(), random.share()));
                n_hits += usize::from(ways.intersects(&ray));
                if let Some(hit) = ways.scan.nearest(Lecture, &ray, &mut ()) {
                    ways.intersects(&Ray::spawned(
                        Lecture,
                        &hit.hit_point(hit.n_geom),
                        Vec3::of(random.unit()),
                    ));
                }
            }
        }
    }
    assert!(n_scenes > 20 && n_hits > 1000, "{n_hits} hits in {n_scenes} scenes");
}

/// Returns the scene with all objects mapped by `map`.
fn mapped(scene: &cases::Scene, map: DAffine3) -> cases::Scene {
    let mut scene = scene.clone();
    for object in &mut scene.objects {
        object.world_from_object = map * object.world_from_object;
        object.object_from_world = object.world_from_object.inverse();
    }
    scene
}

/// Checks worlds in which rounding on the way to object space is large: far from the origin, at
/// extreme sizes, and with nearly singular matrices.
fn trees_find_what_lists_find_in_far_and_flat_worlds<T: Real>() {
    let mut random = Random(0xfa5_7a4d_f1a7);
    let turn = DAffine3::from_axis_angle(DVec3::new(0.48, 0.6, 0.64), 0.8);
    let flat =
        |least: f64| turn * DAffine3::from_scale(DVec3::new(1.0, 1.0, least)) * turn.inverse();
    let far = |by: f64| DAffine3::from_translation(DVec3::new(by, -0.7 * by, 0.3 * by));
    let sized = |k: f64| DAffine3::from_scale(DVec3::splat(k));
    let maps = [far(1e4), far(1e6), far(1e8), sized(1e-8), sized(1e8), far(1e6) * sized(1e-3)];
    for map in maps.into_iter().chain([flat(1e-3), flat(1e-6), flat(1e-9), far(1e4) * flat(1e-6)]) {
        let scene = mapped(&disorder(&mut random), map);
        let ways = Ways::<T>::of(&scene);
        let mut n_hits = 0;
        for n in 0..600 {
            let from = map.transform_point3(random.unit() * 4.0);
            let object = &scene.objects[n % scene.objects.len()];
            let to = object.world_from_object.transform_point3(random.unit() * 0.4);
            let ray = Ray::leaving(Lecture, Vec3::of(from), Vec3::of((to - from).normalize()));
            n_hits += usize::from(ways.intersects(&ray));
        }
        assert!(n_hits > 100, "only {n_hits} rays hit anything under {map:?}: the test is vacuous");
    }
}

#[test]
fn trees_find_what_lists_find_where_rounding_is_large() {
    trees_find_what_lists_find_in_far_and_flat_worlds::<f64>();
    trees_find_what_lists_find_in_far_and_flat_worlds::<f32>();
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let scene = disorder(&mut Random(0xabc));
    let world = World::<f64>::new(&scene);
    let options = Options { samples: 2, ..Options::of(&world) };
    let with = |n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| render(&world, Lecture, &options, |_| {}))
    };
    let (image, stats) = with(1);
    assert_eq!(stats.rays.eye, 24 * 18 * 4);
    for n in [2, 3, 7] {
        assert_eq!(with(n), (image.clone(), stats), "{n} threads");
    }
}

#[test]
fn single_precision_is_close_to_double() {
    let scene = disorder(&mut Random(0xabc));
    let single = World::<f32>::new(&scene);
    let double = World::<f64>::new(&scene);
    let (single, _) = render(&single, Lecture, &Options::of(&single), |_| {});
    let (double, _) = render(&double, Lecture, &Options::of(&double), |_| {});
    let pairs = single.pixels().iter().zip(double.pixels());
    let differs = |(a, b): &(&glam::DVec3, &glam::DVec3)| {
        (0..3).any(|c| (level(a[c]) - level(b[c])).abs() > 0.5)
    };
    let n_out = pairs.filter(differs).count();
    // The pixels that differ are at silhouettes.
    assert!(n_out <= 4, "{n_out} of 432 pixels differ by more than half a level");
    assert_ne!(single, double, "both pictures are in the same precision");
}

#[test]
fn a_ray_of_a_kind_that_is_off_is_never_cast() {
    let mut scene = disorder(&mut Random(0xabc));
    scene.materials[0].kr = DVec3::splat(0.5);
    scene.materials[0].kt = DVec3::splat(0.5);
    let world = World::<f64>::new(&scene);
    let rays = |effects| {
        render(&world, Lecture, &Options { effects, ..Options::of(&world) }, |_| {}).1.rays
    };
    let all = rays(cases::Effects::all());
    assert!(all.shadow > 0 && all.reflected > 0 && all.refracted > 0, "{all:?}");
    let none = rays(cases::Effects::NONE);
    assert_eq!(none.total(), none.eye);
    assert_eq!(rays(cases::Effects::all().without(Effect::Shadows)).shadow, 0);
    assert_eq!(rays(cases::Effects::all().without(Effect::Reflection)).reflected, 0);
    assert_eq!(rays(cases::Effects::all().without(Effect::Refraction)).refracted, 0);
}
