//! Tests by counts that an effect does work exactly in the scenes that call for it.

use std::path::Path;

use cases::effects::simulate_only;
use cases::stage::{self, Case};
use cases::{Effect, Effects, Scene};
use rayon::prelude::*;
use reference::rules::{Lecture, Rules};
use reference::trace::render::{Options, count_by, render};
use reference::watch::work::Amounts;
use reference::watch::{Counts, made_by};
use reference::world::World;

/// Returns the public cases in a small size.
fn cases() -> Vec<Case> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let stages = stage::load_all(&folder, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let mut all: Vec<Case> = stages.into_iter().flat_map(|stage| stage.cases).collect();
    all.iter_mut().for_each(|case| (case.scene.render.width, case.scene.render.height) = (64, 48));
    all
}

fn counted(scene: &Scene, rules: &Rules) -> (Counts, Amounts) {
    let world = World::<f64>::new(scene);
    let (_, stats, work) = count_by(&world, rules, &Options::of(&world), |_| {});
    (stats.rays, work)
}

/// Returns the count of work that `effect` did in `scene`, with only `effects` simulated.
fn made(scene: &Scene, effects: Effects, effect: Effect) -> u64 {
    let mut scene = scene.clone();
    simulate_only(&mut scene, effects);
    let (rays, work) = counted(&scene, &Rules::LECTURE);
    made_by(effect, &rays, &work).0
}

#[test]
fn no_case_makes_what_it_does_not_call_for_and_each_makes_what_it_does() {
    let wrong: Vec<String> = cases()
        .par_iter()
        .flat_map_iter(|case| {
            let own = case.scene.effects;
            let (rays, work) = counted(&case.scene, &Rules::LECTURE);
            Effect::ALL.into_iter().filter_map(move |effect| {
                let (n, of) = made_by(effect, &rays, &work);
                // A ray that can only miss is called for, but not cast.
                let n_called_for = n + if own.has(effect) { work.sure_misses } else { 0 };
                (own.has(effect) != (n_called_for > 0)).then(|| format!("{}: {n} {of}", case.id))
            })
        })
        .collect();
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn an_effect_that_is_switched_off_makes_nothing() {
    let wrong: Vec<String> = cases()
        .par_iter()
        .flat_map_iter(|case| {
            let own = case.scene.effects;
            let made = move |effect: Effect| made(&case.scene, own.without(effect), effect);
            own.iter().filter_map(move |effect| {
                let n = made(effect);
                (n > 0).then(|| format!("{} without {effect}: {n}", case.id))
            })
        })
        .collect();
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn counting_changes_no_picture_and_no_count() {
    let cases = cases();
    assert!(
        Effect::ALL.iter().all(|effect| cases.iter().any(|case| case.scene.effects.has(*effect)))
    );
    cases.par_iter().for_each(|case| {
        let world = World::<f64>::new(&case.scene);
        let options = Options::of(&world);
        let plain = render(&world, Lecture, &options, |_| {});
        let (image, stats, work) = count_by(&world, &Rules::LECTURE, &options, |_| {});
        assert_eq!((image, stats), plain, "{}", case.id);
        assert!(work.objects > 0, "{}: no ray is tested against an object", case.id);
    });
}

/// The page of the documentation is what its command writes.
#[test]
fn the_page_of_effects_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("effects.md");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_reference"))
        .current_dir(&root)
        .args(["effects", "--page"])
        .arg(&page)
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let written = std::fs::read_to_string(&page).unwrap();
    let stored = std::fs::read_to_string(root.join("docs/effects.md")).unwrap();
    assert!(
        written == stored,
        "docs/effects.md is stale: cargo run --release -p reference -- effects --page \
            docs/effects.md"
    );
}
