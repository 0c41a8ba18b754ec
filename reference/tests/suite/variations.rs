//! Tests of the legal variations: each takes its freedoms as published, and none differs visibly
//! from the reference.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use cases::film::{Image, level};
use cases::stage::{self, Case, Stage};
use rayon::prelude::*;
use reference::expect::variations::{Precision, Variation, published, variations};
use reference::rules::misconceptions;
use reference::rules::{Lecture, Rules};
use reference::trace::render::{Options, render};
use reference::world::World;

/// A pixel strays if a channel differs by more levels than this.
const LEVELS: f64 = 2.0;
/// The greatest allowed share of straying pixels. Beyond it, the noise of the variation is visible,
/// or the case is unfair to it.
const STRAY_SHARE: f64 = 0.01;

static STAGES: LazyLock<Vec<Stage>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    stage::load_all(&folder, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)))
});

fn n_stray(centre: &Image, other: &Image) -> usize {
    let differs = |(a, b): (&glam::DVec3, &glam::DVec3)| {
        (0..3).any(|c| {
            let is_close = (level(a[c]) - level(b[c])).abs() <= LEVELS; // False for NaN.
            !is_close
        })
    };
    centre.pixels().iter().zip(other.pixels()).filter(|pair| differs(*pair)).count()
}

/// Returns, for every variation, the share of the pixels of a case on which it strays.
fn stray_shares<'a>(
    case: &'a Case,
    variations: &'a [Variation],
) -> Vec<(f64, &'a str, &'a Variation)> {
    let centre = World::<f64>::new(&case.scene);
    let centre = render(&centre, Lecture, &Options::of(&centre), |_| {}).0;
    let share = |v: &Variation| {
        let picture = v.picture(&case.scene, case.scene.effects);
        n_stray(&centre, &picture) as f64 / centre.pixels().len() as f64
    };
    variations.iter().map(|v| (share(v), case.id.as_str(), v)).collect()
}

/// Prints the variations and cases that stray most, the worst first.
#[test]
fn no_variation_strays_from_the_reference() {
    let variations = variations(&Rules::LECTURE);
    let cases: Vec<_> = STAGES.iter().flat_map(|stage| &stage.cases).collect();
    let mut shares: Vec<_> =
        cases.par_iter().flat_map_iter(|case| stray_shares(case, &variations)).collect();
    shares.sort_by(|a, b| b.0.total_cmp(&a.0));
    let line = |(share, case, v): &(f64, &str, &Variation)| {
        format!("{:6.2} %  {case}: {}", share * 100.0, v.name)
    };
    let table: Vec<_> = shares.iter().take(60).map(line).collect();
    println!("{}", table.join("\n"));
    let n_ill = shares.iter().filter(|(share, ..)| *share > STRAY_SHARE).count();
    assert!(
        n_ill == 0,
        "{n_ill} stray on more than {} % of the pixels:\n{}",
        STRAY_SHARE * 100.0,
        table.join("\n")
    );
}

#[test]
fn noise_that_is_too_large_strays() {
    let mut noisy = variations(&Rules::LECTURE);
    for v in &mut noisy {
        v.rules.style.nudge = [0.5, 0.5];
    }
    let shares = stray_shares(&STAGES[0].cases[0], &noisy);
    assert!(
        shares.iter().all(|(share, ..)| *share > STRAY_SHARE),
        "a nudge by half a pixel is not noticed"
    );
}

#[test]
fn there_are_enough_of_each_precision_and_all_differ() {
    let variations = variations(&Rules::LECTURE);
    for precision in [Precision::F32, Precision::F64] {
        assert!(
            variations.iter().filter(|v| v.precision == precision).count() >= 24,
            "{precision:?}"
        );
    }
    let names: BTreeSet<_> = variations.iter().map(|v| &v.name).collect();
    assert_eq!(names.len(), variations.len());
}

#[test]
fn what_is_free_is_published() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/grading.md");
    let page = std::fs::read_to_string(page).unwrap();
    assert!(
        page.contains(&published()),
        "docs/grading.md must hold this table:\n\n{}",
        published()
    );
}

/// A mistake is one change to the rules, independent of a student's other choices. A case that
/// shows it must show it in any style.
#[test]
fn a_mistake_shows_in_any_style() {
    const SIZE: (u32, u32) = (48, 36);
    let small = |case: &Case| {
        let mut scene = case.scene.clone();
        (scene.render.width, scene.render.height) = SIZE;
        scene
    };
    let scenes: Vec<_> = STAGES.iter().flat_map(|stage| &stage.cases).map(small).collect();
    let lecture = Variation {
        name: "the reference".into(),
        precision: Precision::F64,
        rules: Rules::LECTURE,
    };
    let styles: Vec<_> = variations(&Rules::LECTURE).into_iter().step_by(7).collect();
    misconceptions::of(&Rules::LECTURE).par_iter().for_each(|wrong| {
        let n_seen = |v: &Variation, scene: &cases::Scene| {
            let mut broken = v.clone();
            (wrong.apply)(&mut broken.rules);
            n_stray(&v.picture(scene, scene.effects), &broken.picture(scene, scene.effects))
        };
        let Some(scene) = scenes.iter().find(|scene| n_seen(&lecture, scene) > 9) else { return };
        for style in &styles {
            assert!(n_seen(style, scene) > 0, "{} does not show in {}", wrong.id, style.name);
        }
    });
}
