//! Tests of the diagnosis. For a program that makes only one known mistake, that mistake alone is
//! named; for nonsense none is.

use std::sync::LazyLock;

use cases::answer::{CheckAnswer, ImageAnswer, Levels, Wrong, image_answer_path};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::probe::Answer;
use cases::stage::{Case, Check};
use grader::diagnose::{self, Evidence, Named, rank};
use grader::exam::Exam;
use grader::judge;
use grader::record::Verdict;
use rayon::prelude::*;
use reference::rules::Rules;
use reference::rules::misconceptions::{self, Misconception};
use reference::trace::answers::answer_in;
use reference::trace::render::{Options, render};
use reference::world::World;

/// An image case with its answer and the pictures of mistakes.
type Sent = (&'static Case, &'static ImageAnswer, Vec<Wrong>);
/// The light of a pixel by its column and row.
type Fill<'a> = &'a (dyn Fn(u32, u32) -> DVec3 + Sync);

static EXAM: LazyLock<Exam> = LazyLock::new(|| {
    Exam::load(&tests::public_stages()).unwrap_or_else(|problems| panic!("{problems}"))
});
static CASES: LazyLock<Vec<Sent>> = LazyLock::new(|| {
    let cases = EXAM
        .stages
        .iter()
        .flat_map(|one| one.stage.cases.iter().map(move |case| (case, &one.images[&case.id])));
    cases.map(|(case, answer)| (case, answer, pictures(case))).collect()
});

fn pictures(case: &Case) -> Vec<Wrong> {
    let bytes = std::fs::read(image_answer_path(&EXAM.folder, &case.id)).unwrap();
    Wrong::decode_all(&bytes, case.scene.render.width, case.scene.render.height).unwrap()
}

fn checks() -> impl Iterator<Item = (&'static Check, &'static CheckAnswer)> {
    EXAM.stages
        .iter()
        .flat_map(|one| one.stage.checks.iter().map(move |check| (check, &one.units[&check.id])))
}

fn known() -> Vec<&'static Misconception> {
    misconceptions::of(&Rules::LECTURE)
}

/// Returns the diagnoses for these pictures and answers. All cases have the same weight, and so do
/// all checks.
fn named(
    picture: impl Fn(&Case, &ImageAnswer, &[Wrong]) -> Image,
    reply: impl Fn(&Check, &CheckAnswer) -> Answer,
) -> Vec<Named> {
    let of_case = |(case, answer, mistakes): &Sent| {
        let actual = picture(case, answer, mistakes);
        match judge::picture(&actual, answer).verdict {
            Verdict::Pass => {
                Evidence::right(&case.id, 2000, mistakes.iter().map(|one| one.id.clone()))
            }
            _ => Evidence::wrong(&case.id, 2000, diagnose::picture(&actual, answer, mistakes)),
        }
    };
    let of_check = |(check, right): (&Check, &CheckAnswer)| {
        let given = reply(check, right);
        match judge::unit(&given, right, check.ask.function()).verdict {
            Verdict::Pass => Evidence::right(&check.id, 90, right.wrong.keys().cloned()),
            _ => Evidence::wrong(&check.id, 90, diagnose::unit(&given, right)),
        }
    };
    rank(&CASES.iter().map(of_case).chain(checks().map(of_check)).collect::<Vec<_>>())
}

/// Fails with the diagnoses of each mistake that is not named alone.
fn each_is_named(
    mistakes: &[&'static Misconception],
    named: impl Fn(&Misconception) -> Vec<Named> + Sync,
) {
    let is_fault = |wrong: &&'static Misconception| {
        let named = named(wrong);
        let is_alone = named.len() == 1 && named[0].mistakes == [wrong.id];
        (!is_alone).then(|| format!("{}: {named:?}", wrong.id))
    };
    let faults: Vec<String> = mistakes.par_iter().filter_map(is_fault).collect();
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), mistakes.len(), faults.join("\n"));
}

/// Returns the picture of a mistake as the answer file stores it.
fn stored(id: &str, answer: &ImageAnswer, mistakes: &[Wrong]) -> Image {
    let Some(wrong) = mistakes.iter().find(|wrong| wrong.id == id) else {
        return answer.expected.clone();
    };
    let light = |levels: Levels| DVec3::from(levels.map(f64::from)) / 255.0;
    let pixels = wrong.changes.iter().zip(answer.expected.pixels());
    let pixels = pixels
        .map(|(change, right)| light(change.unwrap_or_else(|| right.to_array().map(byte))))
        .collect();
    Image::from_pixels(answer.expected.width(), answer.expected.height(), pixels).unwrap()
}

#[test]
fn every_mistake_is_named_first_and_alone() {
    each_is_named(&known(), |wrong| {
        named(
            |_, answer, mistakes| stored(wrong.id, answer, mistakes),
            |_, right| right.wrong.get(wrong.id).unwrap_or(&right.answer).clone(),
        )
    });
}

/// Every ninth mistake, rendered in single precision.
#[test]
fn mistakes_are_named_in_single_precision_too() {
    let mistakes: Vec<_> = known().into_iter().step_by(9).collect();
    each_is_named(&mistakes, |wrong| {
        let rules = wrong.on(&Rules::LECTURE);
        let picture = |case: &Case, _: &ImageAnswer, _: &[Wrong]| {
            let world = World::<f32>::new(&case.scene);
            render(&world, &rules, &Options::of(&world), |_| {}).0
        };
        named(picture, |check, _| answer_in::<f32, _>(&rules, &check.ask))
    });
}

#[test]
fn nothing_is_named_for_nonsense() {
    let noise = |i: u32, j: u32, channel: u32| {
        let mixed = (i * 7919 + j * 104_729 + channel * 1_299_709).wrapping_mul(2_654_435_761);
        f64::from(mixed >> 8) / f64::from(1u32 << 24)
    };
    let fills: [(&str, Fill); 5] = [
        ("black", &|_, _| DVec3::ZERO),
        ("grey", &|_, _| DVec3::splat(0.5)),
        ("not a number", &|_, _| DVec3::NAN),
        ("noise", &|i, j| DVec3::new(noise(i, j, 0), noise(i, j, 1), noise(i, j, 2))),
        ("a slope", &|i, j| DVec3::new(f64::from(i) / 160.0, f64::from(j) / 120.0, 0.3)),
    ];
    for (name, fill) in fills {
        let picture = |_: &Case, answer: &ImageAnswer, _: &[Wrong]| {
            Image::from_fn(answer.expected.width(), answer.expected.height(), fill)
        };
        assert_eq!(
            named(picture, |_, right| right.answer.clone()),
            [],
            "{name} instead of every picture"
        );
        assert_eq!(
            named(picture, |_, _| Answer::Miss(true)),
            [],
            "{name}, and every answer a miss"
        );
    }
}
