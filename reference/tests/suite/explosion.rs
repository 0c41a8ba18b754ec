//! Tests of trees of rays that explode: limits on the number of rays, and forecasts of it.

use crate::common::scene;
use cases::Scene;
use reference::rules::{Lecture, Rules};
use reference::trace::forecast::forecast;
use reference::trace::kernel::Kernel;
use reference::trace::render::{Options, count_by, count_within, render_by};
use reference::watch::Counts;
use reference::world::World;

/// Returns balls of glass that reflect and transmit, beside and within each other, at this depth.
fn glass(max_depth: u32) -> Scene {
    let mut scene = scene(
        "[scene]\nbackground = [0.4, 0.5, 0.7]\n[scene.materials]\n\
            glass = { kd = [0.1, 0.1, 0.1], kt = [0.6, 0.6, 0.6], kr = [0.4, 0.4, 0.4], index = \
            1.5 }\n\
            [[scene.lights]]\ndirectional = { direction = [0, -1, -1], colour = [1, 1, 1] }\n\
            [[scene.objects]]\nsphere = { center = [0.8, 0, 0], radius = 0.8 }\n\
            material = \"glass\"\n\
            [[scene.objects]]\nsphere = { center = [-0.8, 0, 0], radius = 0.8 }\n\
            material = \"glass\"\n\
            [[scene.objects]]\nsphere = { center = [-0.8, 0, 0], radius = 0.5 }\n\
            material = \"glass\"\n",
    );
    (scene.render.width, scene.render.height) = (64, 48);
    scene.render.max_depth = max_depth;
    scene
}

/// A picture is given up if and only if it takes more rays than allowed, with any number of
/// threads, and is the same if it is not.
#[test]
fn a_limit_of_rays_is_exact() {
    let world = World::<f64>::new(&glass(4));
    let options = Options::of(&world);
    let (image, stats, work) = count_by(&world, &Rules::LECTURE, &options, |_| {});
    let n_rays = stats.rays.total();
    assert_eq!(image, render_by(&world, &Rules::LECTURE, &options, |_| {}).0);
    for n_threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        for rules in [Rules::LECTURE, Rules { air: 1.0, ..Rules::LECTURE }] {
            let (_, stats, _) = count_by(&world, &rules, &options, |_| {});
            let n_rays = stats.rays.total();
            for (most, is_done) in
                [(1, false), (n_rays - 1, false), (n_rays, true), (u64::MAX, true)]
            {
                let found = pool.install(|| count_within(&world, &rules, &options, most, |_| {}));
                assert_eq!(found.is_some(), is_done, "{most} of {n_rays}, {n_threads} threads");
            }
        }
        let found =
            pool.install(|| count_within(&world, &Rules::LECTURE, &options, n_rays, |_| {}));
        assert_eq!(found, Some((image.clone(), stats, work)));
    }
}

/// At depth 200 the tree of a pixel has more rays than could ever be traced.
#[test]
fn a_tree_without_end_is_given_up() {
    let world = World::<f64>::new(&glass(200));
    let options = Options::of(&world);
    assert_eq!(count_within(&world, &Rules::LECTURE, &options, 100_000, |_| {}), None);
    let expected = forecast(&world, &Rules::LECTURE, &options).unwrap();
    assert!(expected.rays > 1e20, "{expected:?}");
}

/// The forecast counts what it can. Deeper, it lets the last levels grow on.
#[test]
fn a_forecast_is_within_a_factor_of_two() {
    for (max_depth, is_whole) in [(8, true), (10, true), (18, false)] {
        let mut scene = glass(max_depth);
        (scene.render.width, scene.render.height) = (160, 112);
        let world = World::<f64>::new(&scene);
        let options = Options::of(&world);
        let expected = forecast(&world, &Rules::LECTURE, &options).unwrap();
        // The whole picture, or the sampled pixels alone.
        let (first, step) = if is_whole { (0, 1) } else { (8, 16) };
        let places = |size: u32| (first..size).step_by(step);
        let kernel = Kernel::new(&world, Lecture, scene.effects);
        let (mut rays, mut n_pixels) = (Counts::default(), 0);
        for pixel in places(112).flat_map(|j| places(160).map(move |i| (i, j))) {
            kernel.eye(pixel, (0.5, 0.5), &mut rays);
            n_pixels += 1;
        }
        let share = expected.per_eye_ray * f64::from(n_pixels) / rays.total() as f64;
        println!("depth {max_depth}: {expected:?} is {share} of {rays:?}");
        assert!((0.5..=2.0).contains(&share), "depth {max_depth}: {share} of the rays");
        let budget = 100_000;
        assert!(is_whole || rays.total() > budget, "{rays:?}: nothing is extrapolated");
    }
}

#[test]
fn nothing_is_forecast_where_no_tree_can_explode() {
    let of = |scene: &Scene| {
        let world = World::<f64>::new(scene);
        forecast(&world, &Rules::LECTURE, &Options::of(&world))
    };
    let mut clear = glass(20);
    clear.materials[0].kr = glam::DVec3::ZERO;
    assert_eq!((of(&glass(7)), of(&clear)), (None, None));
    let mut faint = glass(20);
    faint.render.threshold = 0.3;
    faint.effects = faint.effects.with(cases::Effect::AdaptiveDepth);
    let few = of(&faint).unwrap().per_eye_ray;
    assert!(few < 20.0 && of(&glass(20)).unwrap().per_eye_ray > 20.0 * few, "{few}");
}
