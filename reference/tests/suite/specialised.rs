//! Tests that the kernel that is chosen for a scene gives the picture of the general kernel, bit
//! for bit. They cover every public case and 1,000 others.

use std::path::{Path, PathBuf};

use cases::film::Image;
use cases::stage::{self, Case, Stage};
use cases::{Effect, Effects};
use pages::say;
use rayon::prelude::*;
use reference::rules::{Formula, Lecture, Rules};
use reference::trace::render::{Options, count_by, render, render_alike, render_by};
use reference::trace::simulated::{EyeAlone, WithShadows};
use reference::vary::draw_any;
use reference::world::World;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages")
}

fn stages() -> Vec<Stage> {
    stage::load_all(&folder(), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)))
}

fn bits(image: &Image) -> Vec<[u64; 3]> {
    image.pixels().iter().map(|light| light.to_array().map(f64::to_bits)).collect()
}

/// Checks that five renders of `case` in this size give one picture. They use the kernel for its
/// effects, the general kernel, rules that are looked up, counting, and every effect that its stage
/// allows.
#[track_caller]
fn check(case: &Case, allowed: Effects, (width, height): (u32, u32)) {
    let mut scene = case.scene.clone();
    (scene.render.width, scene.render.height) = (width, height);
    let world = World::<f64>::new(&scene);
    let own = Options::of(&world);
    let everything = Options { effects: allowed, ..own };
    let special = render_by(&world, &Rules::LECTURE, &own, |_| {});
    let general = render(&world, Lecture, &own, |_| {});
    let looked_up = render(&world, &Rules::LECTURE, &own, |_| {});
    let (counted, stats, _) = count_by(&world, &Rules::LECTURE, &own, |_| {});
    assert_eq!([special.1, looked_up.1, stats], [general.1; 3], "{}", case.id);
    let right = bits(&special.0);
    let pictures =
        [general.0, looked_up.0, counted, render(&world, Lecture, &everything, |_| {}).0];
    for (picture, how) in
        pictures.iter().zip(["in general", "by rules", "counted", "with everything"])
    {
        assert!(bits(picture) == right, "{} {how} gives a different picture:\n{scene:?}", case.id);
    }
}

#[test]
fn every_public_case_has_one_picture() {
    let stages = stages();
    let all =
        || stages.iter().flat_map(|stage| stage.cases.iter().map(|case| (case, stage.allows)));
    all()
        .collect::<Vec<_>>()
        .par_iter()
        .for_each(|(case, allowed)| check(case, *allowed, (96, 72)));
    // Each kind of kernel is chosen for some cases. Otherwise the test is vacuous.
    let n = |is: &dyn Fn(Effects) -> bool| all().filter(|(case, _)| is(case.scene.effects)).count();
    let eye_alone = |effects| EyeAlone::new(effects, 0.0).is_some();
    let shadows = |effects| WithShadows::new(effects, 0.0).is_some();
    let figures = [n(&eye_alone), n(&|e| shadows(e) && !eye_alone(e)), n(&|e| !shadows(e))];
    assert!(figures.iter().all(|n| *n >= 8), "{figures:?}");
    assert!(
        Effect::ALL.iter().all(|effect| n(&|e| e.has(*effect)) > 0 && n(&|e| !e.has(*effect)) > 0)
    );
}

#[test]
fn formulas_that_are_compared_give_the_picture_of_rules_that_are_looked_up() {
    for case in stages().iter().flat_map(|stage| &stage.cases) {
        let mut scene = case.scene.clone();
        (scene.render.width, scene.render.height) = (48, 36);
        let world = World::<f64>::new(&scene);
        let own = Options::of(&world);
        for formula in Formula::ALL {
            let rules = formula.rules(&Rules::LECTURE);
            let looked_up = bits(&render(&world, &rules, &own, |_| {}).0);
            for (picture, _) in [
                render_by(&world, &rules, &own, |_| {}),
                render_alike(&world, &rules, &own, |_| {}),
            ] {
                assert!(bits(&picture) == looked_up, "{} by {}", case.id, formula.name());
            }
        }
    }
}

#[test]
fn a_thousand_others_have_one_picture_each() {
    let stages = stages();
    let cases: Vec<(&Case, Effects)> = stages
        .iter()
        .flat_map(|stage| stage.cases.iter().map(|case| (case, stage.allows)))
        .collect();
    let n_seeds = 1000usize.div_ceil(cases.len()) as u64;
    cases.par_iter().for_each(|(case, allowed)| {
        let path = folder().join(format!("{}.toml", case.id));
        let text = std::fs::read_to_string(&path).unwrap();
        for seed in 0..n_seeds {
            let drawn = draw_any(case, &path, &text, *allowed, seed)
                .unwrap_or_else(|why| panic!("{}", say::chain(&why)));
            assert!(drawn.scene != case.scene, "{} does not vary", case.id);
            check(&drawn, *allowed, (32, 24));
        }
    });
}
