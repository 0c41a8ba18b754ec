//! Rays searched for together find what each finds alone, bit for bit.

mod common;

use common::{Random, globe, scene};
use glam::DVec3;
use reference::bvh::Lanes;
use reference::camera::Lens;
use reference::packet::MOST;
use reference::ray::Ray;
use reference::real::Real;
use reference::render::{Options, render, render_by};
use reference::rules::{Lecture, Rules};
use reference::vec3::Vec3;
use reference::work::Amounts;
use reference::world::{Search, World};

/// A stone of `n` bands about the origin, and what stands before and behind it.
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

/// A world searched by every set of instructions, and one that asks everything.
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

    /// How many of the rays meet something: each what it meets alone, by the same steps on every
    /// path.
    fn check(&self, rays: &[Ray<T>]) -> usize {
        let alone: Vec<_> =
            rays.iter().map(|ray| self.scan.nearest(Lecture, ray, &mut ())).collect();
        let mut steps = vec![];
        for world in &self.trees {
            let mut work = Amounts::default();
            let together = rays.iter().zip(world.first_together(rays, &mut work));
            let hit = |(ray, found): (&_, Option<_>)| {
                found.map(|met| world.hit(Lecture, ray, met, true, &mut ()))
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

/// Neighbouring rays from near and far, from within the mesh, and straight at corners and at the
/// middles of edges.
fn neighbours_find_what_each_finds<T: Real>() {
    let mut random = Random(0x9ac_4e7);
    let (mut n_met, mut n_rays) = (0, 0);
    for scene in [stone(24, BALL), stone(24, TURNED), stone(3, "")] {
        let ways = Ways::<T>::of(&scene);
        assert!(ways.trees[0].gains_together());
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
            n_met += ways.check(&rays);
            n_rays += rays.len();
        }
    }
    assert!(
        n_met > n_rays / 3 && n_met < n_rays,
        "{n_met} of {n_rays} rays meet anything: it tests too little"
    );
}

#[test]
fn neighbours_find_what_each_finds_in_both_precisions() {
    neighbours_find_what_each_finds::<f64>();
    neighbours_find_what_each_finds::<f32>();
}

/// Along axes and diagonals, with zeros of both signs, all from one point; among them rays that
/// have nothing in common.
#[test]
fn rays_along_axes_find_what_each_finds() {
    let ways = Ways::<f64>::of(&stone(8, BALL));
    let steps = [-1.0, -0.0, 0.0, 1.0];
    let all = || {
        steps
            .into_iter()
            .flat_map(move |x| steps.into_iter().flat_map(move |y| steps.map(|z| [x, y, z])))
    };
    let mut n_met = 0;
    for origin in all().map(|[x, y, z]| DVec3::new(x, y, z) * 2.0) {
        let directions: Vec<DVec3> = all().map(DVec3::from).filter(|d| *d != DVec3::ZERO).collect();
        for directions in directions.chunks(5).chain(directions.chunks(1)) {
            let rays: Vec<_> = directions
                .iter()
                .map(|d| Ray::leaving(Lecture, Vec3::of(origin), Vec3::of(*d)))
                .collect();
            n_met += ways.check(&rays);
        }
    }
    assert!(n_met > 500, "only {n_met} rays meet anything");
}

/// Intervals that begin behind the origin or end early, and origins that differ.
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

/// Meshes that fill their leaves or do not, and one without area; single precision holds their
/// corners.
#[test]
fn few_triangles_find_all_that_meet_them() {
    let middle_and_rim = "[0, 0, 0], [1, 0, 0], [1, 1, 0.25], [0, 1, 0.5], [-1, 1, 0], [-1, 0, \
        0.25], [-1, -1, 0.5], [0, -1, 0], [1, -1, 0.25]";
    let met = [0, 1, 2, 3, 4, 5, 6, 7].map(|n| {
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
    assert!(met.is_sorted() && met[0] == 0 && met[1] > 0 && met[7] > 12, "{met:?}");
}

/// A walk for sixteen rays takes far fewer steps than sixteen walks.
fn steps_are_shared<T: Real>() {
    let world = World::<T>::new(&stone(24, ""));
    let (mut together, mut alone) = (Amounts::default(), Amounts::default());
    for n in 0..64 {
        let corner = DVec3::new(f64::from(n % 8) - 4.0, f64::from(n / 8) - 4.0, 0.0) * 0.2;
        let targets =
            (0..MOST).map(|k| corner + DVec3::new((k % 4) as f64, (k / 4) as f64, 0.0) * 0.01);
        let rays = to::<T>(DVec3::new(0.1, 0.2, 4.0), targets);
        world.first_together(&rays, &mut together);
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

/// The eye rays of all public cases, in blocks that the picture's border cuts.
#[test]
fn eye_rays_find_what_each_finds_in_every_public_case() {
    let stages = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let (mut n_together, mut n_met) = (0, 0);
    for stage in cases::stage::load_all(&stages, &cases::Course::default()).unwrap() {
        for case in &stage.cases {
            let ways = Ways::<f64>::of(&case.scene);
            n_together += usize::from(ways.trees[0].gains_together());
            let lens = Lens::<f64>::new(Lecture, &case.scene.camera, 13, 10);
            for (i, j) in (0..13).step_by(4).flat_map(|i| (0..10).step_by(4).map(move |j| (i, j))) {
                let pixels =
                    (j..(j + 4).min(10)).flat_map(|j| (i..(i + 4).min(13)).map(move |i| (i, j)));
                let rays: Vec<_> =
                    pixels.map(|pixel| lens.eye_ray(Lecture, pixel, (0.5, 0.5))).collect();
                n_met += ways.check(&rays);
            }
        }
    }
    assert!(n_together > 2 && n_met > 1000, "{n_met} hits, {n_together} cases with a mesh");
}

/// By rules looked up at run time rays go one by one.
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
