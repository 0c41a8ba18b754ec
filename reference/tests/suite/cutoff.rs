//! Tests of the bound on the light of rays that are not cast, on paper and in pictures. [rule 13]

use std::path::Path;

use cases::glam::DVec3;
use cases::{Effect, Effects, Scene, stage};
use reference::rules::{Lecture, Rules};
use reference::trace::cutoff::Limits;
use reference::trace::kernel::Kernel;
use reference::watch::Notes;
use reference::world::World;

/// Returns a scene from the centre of a ball that emits `glow` and reflects `kr`. Every ray hits it
/// at a right angle.
fn mirror_ball(glow: f64, kr: f64, max_depth: u32, threshold: f64) -> Scene {
    let text = format!(
        "[render]\nsize = [2, 2]\nmax_depth = {max_depth}\nthreshold = {threshold}\n\
            [scene.camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\n\
         up = [0, 1, 0]\nfov_y_deg = 40\n[scene.materials]\n\
         m = {{ ke = [{glow}, {glow}, {glow}], kd = [0, 0, 0], kr = [{kr}, {kr}, {kr}] }}\n\
         [[scene.objects]]\nsphere = {{ radius = 1 }}\nmaterial = \"m\"\n"
    );
    load(&text)
}

fn load(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    stage::load_scene(&path, &cases::Course::default()).unwrap()
}

/// Returns the light and the left-out weight of every pixel, and the number of rays of the picture.
fn pixels(scene: &Scene, max_depth: u32, threshold: f64) -> (Vec<(DVec3, DVec3)>, u64) {
    let mut world = World::<f64>::new(scene);
    (world.render.max_depth, world.render.threshold) = (max_depth, threshold);
    let effects = scene.effects.with(Effect::AdaptiveDepth);
    let kernel = Kernel::new(&world, Lecture, effects);
    let mut notes = Notes::default();
    let at = |n: u32| (n % scene.render.width, n / scene.render.width);
    let pixels = (0..scene.render.width * scene.render.height)
        .map(|n| {
            let light = kernel.eye(at(n), (0.5, 0.5), &mut notes).f64();
            (light, notes.end_pixel(1.0))
        })
        .collect();
    (pixels, notes.rays.total())
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{found}, not {expected}");
}

#[test]
fn the_figures_worked_out_on_paper() {
    // 1 + 0.9 + 0.81 + … = 10; 51 terms are 10 (1 − 0.9^51) = 9.9536
    let scene = mirror_ball(1.0, 0.9, 50, 0.0);
    let limits = Limits::of(&scene, &Rules::LECTURE, scene.effects);
    near(limits.light.x, 10.0);
    let (all, n_rays) = pixels(&scene, 50, 0.0);
    near(all[0].0.x, 9.9536160231341);
    assert_eq!(n_rays, 4 * 51);
    near(limits.of_weight(all[0].1).x, 10.0 - 9.9536160231341);
    near(limits.of_depth(50).x, 10.0 - 9.9536160231341);
    // 0.9^53 = 0.00376 is the first power below 1/256. This ray is still cast; the next one, of
    // weight 0.9^54, is not.
    let (cut, n_rays) = pixels(&scene, 1000, 1.0 / 256.0);
    assert_eq!(n_rays, 4 * 54);
    near(10.0 - cut[0].0.x, 0.03381391913523);
    near(limits.of_weight(cut[0].1).x, 0.03381391913523);
    // 0.9^132 = 9.1e-7 is the first power below 1e-6.
    assert_eq!(pixels(&scene, 1000, 1e-6).1, 4 * 133);
}

/// Two facing squares, with the eye between them: a perfect mirror that emits nothing, and a wall
/// that emits `glow` and reflects half of the light.
fn facing_mirrors(glow: f64, max_depth: u32) -> Scene {
    load(&format!(
        "[render]\nsize = [1, 1]\nmax_depth = {max_depth}\n\
            [scene.camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\n\
         up = [0, 1, 0]\nfov_y_deg = 40\n[scene.materials]\n\
         perfect = {{ kd = [0, 0, 0], kr = [1, 1, 1] }}\n\
         wall = {{ ke = [{glow}, {glow}, {glow}], kd = [0, 0, 0], kr = [0.5, 0.5, 0.5] }}\n\
         [[scene.objects]]\nplane = {{ normal = [0, 0, 1], k = -1 }}\nmaterial = \"perfect\"\n\
         [[scene.objects]]\nplane = {{ normal = [0, 0, 1], k = 1 }}\nmaterial = \"wall\"\n"
    ))
}

/// The mirror returns what the wall returns, and the wall g + (g + (…)/2)/2 = 2 g. At depth 2 k + 1
/// the last ray ends at the wall, and k + 1 terms of g (1 + 1/2 + 1/4 + …) are there.
#[test]
fn a_perfect_mirror_among_others_has_the_bound_of_the_others() {
    let scene = facing_mirrors(3.0, 50);
    let limits = Limits::of(&scene, &Rules::LECTURE, scene.effects);
    assert_eq!((limits.sent_on.x, limits.light.x), (1.0, 6.0));
    assert_eq!(limits.of_depth(50).x, 6.0, "the bound for the depth alone does not fall");
    for (depth, light) in [(0, 0.0), (1, 3.0), (3, 4.5), (5, 5.25), (7, 5.625)] {
        let (found, _) = pixels(&scene, depth, 0.0);
        assert_eq!(found[0].0.x, light, "depth {depth}");
        assert_eq!(limits.of_weight(found[0].1).x, 6.0 - light, "depth {depth}");
    }
}

/// In a ball with kr = 1 that emits 1, a picture of depth n shows n + 1. There is no bound for all
/// depths, and the bound for n more levels is reached.
#[test]
fn a_glowing_perfect_mirror_gains_its_glow_with_each_level() {
    let scene = mirror_ball(1.0, 1.0, 3, 0.0);
    let limits = Limits::of(&scene, &Rules::LECTURE, scene.effects);
    let at = |depth: u32| pixels(&scene, depth, 0.0).0[0];
    let (light, weight) = at(3);
    assert_eq!(limits.light, DVec3::INFINITY);
    for n in [1, 2, 10] {
        near(at(3 + n).0.x - light.x, f64::from(n));
        near(limits.of_levels(weight, n).x, f64::from(n));
    }
    // With kr = 2, the levels after depth 3 add 16, 32, 64 …
    let scene = mirror_ball(1.0, 1.0, 3, 0.0);
    let doubling = Limits { sent_on: DVec3::splat(2.0), ..limits };
    assert_eq!(doubling.of_levels(DVec3::splat(16.0), 3).x, 16.0 + 32.0 + 64.0);
    assert_eq!(Limits::of(&scene, &Rules::LECTURE, Effects::NONE).of_levels(weight, 9).x, 1.0);
}

#[test]
fn what_does_not_fade_has_no_bound() {
    let limits = |scene: &Scene| Limits::of(scene, &Rules::LECTURE, scene.effects);
    let endless = limits(&mirror_ball(1.0, 1.0, 3, 0.0));
    assert_eq!((endless.light.x, endless.of_weight(DVec3::ONE).x), (f64::INFINITY, f64::INFINITY));
    assert_eq!(endless.of_weight(DVec3::ZERO), DVec3::ZERO, "nothing was left out");
    let scene = mirror_ball(2.0, 1.0, 3, 0.0);
    let dull = Limits::of(&scene, &Rules::LECTURE, Effects::NONE);
    assert_eq!(
        (dull.sent_on, dull.light.x),
        (DVec3::ZERO, 2.0),
        "kr has no effect without reflection"
    );
    assert_eq!(dull.of_depth(0), DVec3::ZERO);
}

/// Checks the bound for several depths and thresholds. No pixel may be off by more than its bound,
/// and the error of some pixel must be at least `share` of it.
#[track_caller]
fn check(name: &str, scene: &Scene, deepest: u32, share: f64) {
    let limits = Limits::of(scene, &Rules::LECTURE, scene.effects);
    let (truth, _) = pixels(scene, deepest, 0.0);
    let rest =
        truth.iter().map(|(_, weight)| limits.of_weight(*weight).max_element()).fold(0.0, f64::max);
    assert!(rest < 1e-3, "{name}: {deepest} is not deep: {rest} may be missing");
    let mut best = 0.0f64;
    for (max_depth, threshold) in [
        (0, 0.0),
        (1, 0.0),
        (2, 0.0),
        (4, 0.0),
        (deepest, 0.3),
        (deepest, 0.05),
        (deepest, 1.0 / 256.0),
    ] {
        let (cut, _) = pixels(scene, max_depth, threshold);
        let most = limits.of_depth(max_depth);
        for (n, ((exact, _), (light, weight))) in truth.iter().zip(&cut).enumerate() {
            let bound = limits.of_weight(*weight);
            for c in 0..3 {
                let error = exact[c] - light[c];
                assert!(
                    error >= -1e-12,
                    "{name}, depth {max_depth}, {threshold}: pixel {n} is too bright by {}",
                    -error
                );
                assert!(
                    error <= bound[c] + 1e-12,
                    "{name}, depth {max_depth}, {threshold}: pixel {n}: {error} > {}",
                    bound[c]
                );
                assert!(
                    threshold > 0.0 || bound[c] <= most[c] + 1e-12,
                    "{name}: depth {max_depth} promises {}",
                    most[c]
                );
                if bound[c] > 1e-3 {
                    best = best.max(error / bound[c]);
                }
            }
        }
    }
    println!("{name}: at best {best:.3} of the bound");
    assert!(best >= share, "{name}: the bound is too loose: errors are at most {best} of it");
}

#[test]
fn no_pixel_of_a_public_case_is_darker_than_the_bound_allows() {
    let stages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    for (id, deepest, share) in [
        ("03_reflection/hall_of_mirrors", 80, 0.05),
        ("03_reflection/faint_paths_end", 60, 0.05),
        ("03_reflection/golden_ball", 40, 0.05),
        ("04_refraction/two_hidden_cards", 100, 0.05),
        ("04_refraction/crystal_ball", 100, 0.05),
        ("06_smooth_normals/curved_mirror", 40, 0.05),
    ] {
        check(
            id,
            &stage::load_scene(&stages.join(format!("{id}.toml")), &cases::Course::default())
                .unwrap(),
            deepest,
            share,
        );
    }
}

#[test]
fn nor_of_glass_in_glass_where_rays_branch() {
    let text = "[render]\nsize = [24, 18]\nmax_depth = 3\n[scene.camera]\neye = [0, 0, 4]\n\
        look_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
        [scene]\nbackground = [0.4, 0.5, 0.7]\n\
        [scene.materials]\nouter = { kd = [0.1, 0.1, 0.1], kt = [0.4, 0.3, 0.4], kr = [0.2, 0.2, \
        0.1], index = 1.5 }\n\
        inner = { kd = [0.2, 0.1, 0.1], kt = [0.3, 0.3, 0.3], kr = [0.3, 0.3, 0.2], index = 1.2 }\n\
        [[scene.lights]]\ndirectional = { direction = [0, -1, -1], colour = [1, 1, 1], ambient = \
        [0.2, 0.2, 0.2] }\n\
        [[scene.objects]]\nsphere = { radius = 1 }\nmaterial = \"outer\"\n[[scene.objects]]\n\
        sphere = { radius = 0.6 }\nmaterial = \"inner\"\n";
    check("glass in glass", &load(text), 14, 0.05);
}
