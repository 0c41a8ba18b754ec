//! Tests of packets: rays that are traced together find the hits that each finds alone, bit for
//! bit.

use crate::common::{Random, globe, scene};
use glam::DVec3;
use reference::lanes::Lanes;
use reference::numbers::real::Real;
use reference::numbers::vec3::Vec3;
use reference::rays::camera::Lens;
use reference::rays::ray::Ray;
use reference::rules::{Lecture, Rules};
use reference::trace::render::{Options, render, render_by};
use reference::watch::work::Amounts;
use reference::world::packet::MOST;
use reference::world::{Search, World};

/// Returns a scene of a stone of `n` bands about the origin, followed by `rest`: a transform of the
/// stone, or further objects.
fn stone(n: u32, rest: &str) -> cases::Scene {
    let mut random = Random(7);
    let mesh = "mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]] }";
    let mut scene = scene(&format!(
        "[scene.materials.m]\nkd = [0.5, 0.6, 0.7]\n[[scene.objects]]\nmaterial = \"m\"\n{mesh}\n\
            {rest}"
    ));
    scene.meshes[0] = globe(n, || 1.0 + 0.1 * random.signed());
    scene
}

/// A world with a tree for every instruction set, and a scan over all objects.
struct Ways<T> {
    scan: World<T>,
    trees: Vec<World<T>>,
}

impl<T: Real> Ways<T> {
    fn of(scene: &cases::Scene) -> Self {
        let tree = World::new(scene);
        let trees = Lanes::all().into_iter().map(|lanes| tree.clone().with_lanes(lanes)).collect();
        Self { scan: World::with_search(scene, Search::Scan), trees }
    }

    /// Returns how many of the rays hit anything. Checks that each finds the hit that it finds
    /// alone, and that all trees take equal steps.
    fn check(&self, rays: &[Ray<T>]) -> usize {
        let alone: Vec<_> =
            rays.iter().map(|ray| self.scan.nearest(Lecture, ray, &mut ())).collect();
        let mut steps = vec![];
        for world in &self.trees {
            let mut work = Amounts::default();
            let together = rays.iter().zip(world.first_of_packet(rays, &mut work));
            let hit = |(ray, found): (&_, Option<_>)| {
                found.map(|hit| world.hit(Lecture, ray, hit, true, &mut ()))
            };
            let together: Vec<_> = together.map(hit).collect();
            assert_eq!(format!("{together:?}"), format!("{alone:?}"), "along {rays:?}");
            steps.push(work);
        }
        assert!(steps.iter().all(|one| *one == steps[0]), "{steps:?} along {rays:?}");
        alone.iter().flatten().count()
    }
}

fn to<T: Real>(origin: DVec3, targets: impl Iterator<Item = DVec3>) -> Vec<Ray<T>> {
    targets.map(|to| Ray::leaving(Lecture, Vec3::of(origin), Vec3::of(to - origin))).collect()
}

const BALL: &str =
    "[[scene.objects]]\nmaterial = \"m\"\nsphere = { center = [0.5, 0.5, 0.9], radius = 0.3 }\n";
const TURNED: &str = "transforms = [{ scale = [1, 0.5, 2] }, { rotate = { axis = [1, 2, 3], \
    angle_deg = 40 } }, { translate = [0.3, -0.2, 0.1] }]\n";

/// Checks neighbouring rays from near and far, from inside the mesh, and straight at vertices and
/// at the middles of edges.
fn neighbours_find_what_each_finds<T: Real>() {
    let mut random = Random(0x9ac_4e7);
    let (mut n_hits, mut n_rays) = (0, 0);
    for scene in [stone(24, BALL), stone(24, TURNED), stone(3, "")] {
        let ways = Ways::<T>::of(&scene);
        assert!(ways.trees[0].gains_by_packets());
        let corners = &scene.meshes[0].vertices;
        for n in 0..400 {
            let far = [0.3, 1.5, 4.0, 1e3, 1e6][n % 5];
            let origin = random.unit() * far;
            let aim = corners[n % corners.len()];
            let spread = [0.0, 1e-9, 0.01, 0.1, 1.0][n / 5 % 5];
            let targets = (0..1 + n % MOST).map(|k| match k % 3 {
                0 => aim,
                1 => (aim + corners[(n + 1) % corners.len()]) * 0.5,
                _ => aim + random.unit() * spread,
            });
            let rays = to::<T>(origin, targets);
            n_hits += ways.check(&rays);
            n_rays += rays.len();
        }
    }
    assert!(
        n_hits > n_rays / 3 && n_hits < n_rays,
        "{n_hits} of {n_rays} rays hit anything: the test is too weak"
    );
}

#[test]
fn neighbours_find_what_each_finds_in_both_precisions() {
    neighbours_find_what_each_finds::<f64>();
    neighbours_find_what_each_finds::<f32>();
}

/// Rays along axes and diagonals, with zeros of both signs. The rays of a packet start at one
/// point, but may have nothing else in common.
#[test]
fn rays_along_axes_find_what_each_finds() {
    let ways = Ways::<f64>::of(&stone(8, BALL));
    let steps = [-1.0, -0.0, 0.0, 1.0];
    let all = || {
        steps
            .into_iter()
            .flat_map(move |x| steps.into_iter().flat_map(move |y| steps.map(|z| [x, y, z])))
    };
    let mut n_hits = 0;
    for origin in all().map(|[x, y, z]| DVec3::new(x, y, z) * 2.0) {
        let directions: Vec<DVec3> = all().map(DVec3::from).filter(|d| *d != DVec3::ZERO).collect();
        for directions in directions.chunks(5).chain(directions.chunks(1)) {
            let rays: Vec<_> = directions
                .iter()
                .map(|d| Ray::leaving(Lecture, Vec3::of(origin), Vec3::of(*d)))
                .collect();
            n_hits += ways.check(&rays);
        }
    }
    assert!(n_hits > 500, "only {n_hits} rays hit anything");
}

/// Rays whose intervals begin behind the origin or end early, and rays of different origins.
#[test]
fn rays_with_little_in_common_find_what_each_finds() {
    let ways = Ways::<f64>::of(&stone(8, BALL));
    let rays = to::<f64>(
        DVec3::new(0.2, 0.1, 3.0),
        (0..MOST).map(|k| DVec3::new(0.01 * k as f64, 0.0, 0.0)),
    );
    let changed = |change: &dyn Fn(&mut Ray<f64>)| {
        let mut rays = rays.clone();
        rays.iter_mut().skip(5).for_each(change);
        ways.check(&rays)
    };
    assert_eq!(changed(&|_| {}), MOST);
    assert_eq!(changed(&|ray| ray.t_max = 0.5), 5);
    assert_eq!(changed(&|ray| ray.t_min = -10.0), MOST);
    assert_eq!(changed(&|ray| ray.t_min = 0.9), MOST);
    assert_eq!(changed(&|ray| ray.origin = Vec3::new(0.0, 0.0, -3.0)), 5);
    assert_eq!(changed(&|ray| ray.direction = -ray.direction), 5);
    assert_eq!(changed(&|ray| ray.direction = ray.direction * 1e-200), MOST);
    assert_eq!(changed(&|ray| ray.direction = Vec3::ZERO), 5);
}

/// Meshes that do or do not fill their leaves, and one without area. Single precision represents
/// their vertices exactly.
#[test]
fn few_triangles_find_all_that_meet_them() {
    let middle_and_rim = "[0, 0, 0], [1, 0, 0], [1, 1, 0.25], [0, 1, 0.5], [-1, 1, 0], [-1, 0, \
        0.25], [-1, -1, 0.5], [0, -1, 0], [1, -1, 0.25]";
    let hit = [0, 1, 2, 3, 4, 5, 6, 7].map(|n| {
        let fan: Vec<[usize; 3]> = (0..n).map(|k| [0, k + 1, k + 2]).chain([[0, 0, 1]]).collect();
        let mesh = format!("mesh = {{ vertices = [{middle_and_rim}], triangles = {fan:?} }}");
        let text = format!(
            "[scene.materials.m]\nkd = [1, 1, 1]\n[[scene.objects]]\nmaterial = \"m\"\n{mesh}\n"
        );
        let targets = [-0.75, -0.25, 0.25, 0.75]
            .map(|x| [-0.7, -0.2, 0.3, 0.8].map(|y| DVec3::new(x, y, 0.2)));
        Ways::<f64>::of(&scene(&text))
            .check(&to(DVec3::new(0.1, 0.2, 9.0), targets.into_iter().flatten()))
    });
    assert!(hit.is_sorted() && hit[0] == 0 && hit[1] > 0 && hit[7] > 12, "{hit:?}");
}

/// Checks that one traversal for sixteen rays takes far fewer steps than sixteen traversals.
fn steps_are_shared<T: Real>() {
    let world = World::<T>::new(&stone(24, ""));
    let (mut together, mut alone) = (Amounts::default(), Amounts::default());
    for n in 0..64 {
        let corner = DVec3::new(f64::from(n % 8) - 4.0, f64::from(n / 8) - 4.0, 0.0) * 0.2;
        let targets =
            (0..MOST).map(|k| corner + DVec3::new((k % 4) as f64, (k / 4) as f64, 0.0) * 0.01);
        let rays = to::<T>(DVec3::new(0.1, 0.2, 4.0), targets);
        world.first_of_packet(&rays, &mut together);
        for ray in &rays {
            world.first(Lecture, ray, &mut alone);
        }
    }
    let (together, alone) = (together.mesh_nodes, alone.mesh_nodes);
    assert!(0 < together && 4 * together < alone, "{together} nodes for all, {alone} one by one");
}

#[test]
fn steps_are_shared_in_both_precisions() {
    steps_are_shared::<f64>();
    steps_are_shared::<f32>();
}

/// The eye rays of all public cases, in blocks of which some are cut by the border of the picture.
#[test]
fn eye_rays_find_what_each_finds_in_every_public_case() {
    let stages = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let (mut n_packets, mut n_hits) = (0, 0);
    for stage in cases::stage::load_all(&stages, &cases::Course::default()).unwrap() {
        for case in &stage.cases {
            let ways = Ways::<f64>::of(&case.scene);
            n_packets += usize::from(ways.trees[0].gains_by_packets());
            let lens = Lens::<f64>::new(Lecture, &case.scene.camera, 13, 10);
            for (i, j) in (0..13).step_by(4).flat_map(|i| (0..10).step_by(4).map(move |j| (i, j))) {
                let pixels =
                    (j..(j + 4).min(10)).flat_map(|j| (i..(i + 4).min(13)).map(move |i| (i, j)));
                let rays: Vec<_> =
                    pixels.map(|pixel| lens.eye_ray(Lecture, pixel, (0.5, 0.5))).collect();
                n_hits += ways.check(&rays);
            }
        }
    }
    assert!(n_packets > 2 && n_hits > 1000, "{n_hits} hits, {n_packets} cases with a mesh");
}

/// With rules that are looked up at run time, rays are traced one by one.
#[test]
fn pictures_are_the_same_with_rays_together_and_one_by_one() {
    let mut scene = stone(20, BALL);
    (scene.render.width, scene.render.height) = (37, 19);
    scene.materials[0].kr = DVec3::splat(0.3);
    let world = World::<f64>::new(&scene);
    for samples in [1, 2, 3, 5] {
        let options = Options { samples, ..Options::of(&world) };
        let alone = render(&world, &Rules::LECTURE, &options, |_| {});
        assert_eq!(render(&world, Lecture, &options, |_| {}), alone, "{samples} × {samples}");
        assert_eq!(
            render_by(&world, &Rules::LECTURE, &options, |_| {}),
            alone,
            "{samples} × {samples}, chosen kernel"
        );
    }
}
