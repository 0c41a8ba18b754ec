//! Tests of the points for wrong pictures on every public case: anti-aliased ones, shifted ones,
//! and ones without the effect.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use cases::Course;
use cases::answer::{ImageAnswer, image_answer_path};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::stage::{Case, load_all};
use grader::judge::{self, Judgement};
use grader::record::{FindingKind, Verdict};
use reference::expect::Set;
use reference::rules::misconceptions;
use reference::rules::{RuleSource, Rules};
use reference::trace::render::{self, Options};
use reference::world::World;
use tests::public_stages;

static SET: LazyLock<Set> = LazyLock::new(|| {
    let course = Course::default();
    let stages = load_all(&public_stages(), &course)
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    Set::new(stages, &course)
});

/// The correct pictures by the id of the case.
static PICTURES: LazyLock<BTreeMap<&str, Image>> =
    LazyLock::new(|| public_cases().map(|case| (case.id.as_str(), SET.picture(case))).collect());

fn public_cases() -> impl Iterator<Item = &'static Case> {
    SET.stages.iter().flat_map(|stage| &stage.cases)
}

fn stored(case: &Case) -> ImageAnswer {
    let bytes = std::fs::read(image_answer_path(&public_stages(), &case.id)).expect("an answer");
    ImageAnswer::decode(&bytes, case.scene.render.width, case.scene.render.height)
        .expect("an answer")
}

fn judged<R: RuleSource>(case: &Case, rules: R, samples: u32) -> Judgement {
    let world = World::<f64>::new(&case.scene);
    let picture: Image =
        render::render(&world, rules, &Options { samples, ..Options::of(&world) }, |_| {}).0;
    judge::picture(&picture, &stored(case))
}

/// Fails with all lines if there are any.
fn none(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Several rays per pixel are recognised and never fail. A case with few edges may let them pass.
#[test]
fn anti_aliased_pictures_are_named_on_every_case() {
    let tries = public_cases().flat_map(|case| [2, 3, 4].map(|samples| (case, samples)));
    let judged =
        tries.map(|(case, samples)| (judged(case, &Rules::LECTURE, samples), &case.id, samples));
    let is_named = |judgement: &Judgement| match &judgement.finding {
        Some(finding) => {
            finding.kind == FindingKind::Antialiased && judgement.verdict == Verdict::Partial
        }
        None => judgement.verdict == Verdict::Pass,
    };
    let wrong = judged.filter(|(one, ..)| !is_named(one));
    none(wrong.map(|(one, id, n)| format!("{id}, {n} × {n} rays: {one:?}")).collect());
}

/// A picture shifted by half a pixel also stays between the neighbours, but is no mean of them.
#[test]
fn a_shift_is_not_taken_for_anti_aliasing() {
    let wrong =
        misconceptions::of(&Rules::LECTURE).into_iter().find(|wrong| wrong.id == "pixel_corner");
    let rules = wrong.expect("the mistake is known").on(&Rules::LECTURE);
    let judged = public_cases().map(|case| (judged(case, &rules, 1), &case.id));
    let is_wrong = |judgement: &Judgement| {
        judgement.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Wrong)
    };
    none(
        judged
            .filter(|(one, _)| !is_wrong(one))
            .map(|(one, id)| format!("{id}: {one:?}"))
            .collect(),
    );
}

/// Returns the most frequent colour.
fn most_frequent(picture: &Image) -> DVec3 {
    let mut counts: BTreeMap<[u8; 3], u32> = BTreeMap::new();
    for pixel in picture.pixels() {
        *counts.entry(pixel.to_array().map(byte)).or_default() += 1;
    }
    let most = counts.into_iter().max_by_key(|(_, n)| *n).map_or([0; 3], |(bytes, _)| bytes);
    DVec3::from(most.map(f64::from)) / 255.0
}

/// Returns pictures that contain nothing of the case, each with its name.
fn blanks(n: usize, case: &'static Case) -> impl Iterator<Item = (String, Image)> {
    let expected = &PICTURES[case.id.as_str()];
    let (width, height) = (expected.width(), expected.height());
    let uniform = [
        ("black", DVec3::ZERO),
        ("white", DVec3::ONE),
        ("the background alone", case.scene.background),
        ("the most frequent colour", most_frequent(expected)),
    ];
    let uniform = uniform
        .map(|(name, colour)| (name.to_owned(), Image::from_fn(width, height, |_, _| colour)));
    let without = ("the picture without what the stage brings".to_owned(), SET.without(n, case));
    let others = public_cases()
        .filter(|other| other.id != case.id)
        .map(|other| (other.id.clone(), &PICTURES[other.id.as_str()]));
    let others =
        others.filter(move |(_, other)| (other.width(), other.height()) == (width, height));
    uniform.into_iter().chain([without]).chain(others.map(|(id, other)| (id, other.clone())))
}

#[test]
fn a_picture_without_the_effect_earns_nothing() {
    let cases = SET
        .stages
        .iter()
        .enumerate()
        .flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, case)));
    let mut wrong = vec![];
    for (n, case) in cases {
        let answer = stored(case);
        for (name, blank) in blanks(n, case) {
            let judgement = judge::picture(&blank, &answer);
            if judgement.verdict != Verdict::Fail {
                wrong.push(format!(
                    "{}: {name} earns {} thousandths ({:?})",
                    case.id, judgement.share, judgement.verdict
                ));
            }
        }
    }
    none(wrong);
}
