//! Tests of the diagnosis. For a program that makes only one known mistake, that mistake alone is
//! named, nearly always; of several mistakes most are named, and none that the program does not
//! make; for nonsense and for right programs with spoilt pictures none is.

use std::sync::LazyLock;

use cases::answer::{ImageAnswer, Levels, Wrong, image_answer_path};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::probe::Answer;
use cases::stage::Case;
use grader::diagnose::Explanation;
use grader::record::{Confidence, Diagnosis};
use rayon::prelude::*;
use reference::rules::Rules;
use reference::rules::misconceptions::{self, Misconception};
use reference::trace::answers::answer_in;
use reference::trace::render::{Options, render};
use reference::world::World;
use tests::diagnosis::{Desk, NUISANCES, Names, combinations, in_bytes, names, parts};

/// The light of a pixel by its column and row.
type Fill<'a> = &'a (dyn Fn(u32, u32) -> DVec3 + Sync);

static DESK: LazyLock<Desk> =
    LazyLock::new(|| Desk::open(&tests::public_stages()).unwrap_or_else(|why| panic!("{why}")));
/// The pictures of mistakes of each case.
static LAYERS: LazyLock<Vec<Vec<Wrong>>> =
    LazyLock::new(|| DESK.cases().map(|(case, _)| layers(case)).collect());

fn layers(case: &Case) -> Vec<Wrong> {
    let bytes = std::fs::read(image_answer_path(&DESK.exam.folder, &case.id)).unwrap();
    Wrong::decode_all(&bytes, case.scene.render.width, case.scene.render.height).unwrap()
}

fn known() -> Vec<&'static Misconception> {
    misconceptions::of(&Rules::LECTURE)
}

/// The share of mistakes that must be named alone. A few are named together with another one, from
/// which a single check or a faint difference distinguishes them.
const ALONE: f64 = 0.95;

/// Fails if a mistake that a program does not make is named by itself, or if fewer than [`ALONE`]
/// of the mistakes are named alone.
fn each_is_named(
    mistakes: &[&'static Misconception],
    explain: impl Fn(&Misconception) -> Explanation + Sync,
) {
    let named = |wrong: &&'static Misconception| {
        let explanation = explain(wrong);
        let owned = |ids: &Vec<&str>| ids.iter().map(|id| (*id).to_owned()).collect();
        (wrong.id, names(&explanation).iter().map(owned).collect())
    };
    let named: Vec<(&str, Vec<Vec<String>>)> = mistakes.par_iter().map(named).collect();
    let not_alone: Vec<_> = named.iter().filter(|(id, names)| *names != [[*id]]).collect();
    let is_wrong = |(id, names): &&(&str, Vec<Vec<String>>)| {
        names.iter().any(|ids| !ids.iter().any(|one| one == id))
    };
    let wrong: Vec<_> = named.iter().filter(is_wrong).collect();
    let n_alone = mistakes.len() - not_alone.len();
    let is_enough = n_alone as f64 >= ALONE * mistakes.len() as f64;
    assert!(wrong.is_empty() && is_enough, "{n_alone} of {}: {not_alone:?}", mistakes.len());
}

/// Returns the pictures of a mistake as the answer files store them.
fn stored(id: &str) -> Vec<Image> {
    let picture = |(layers, (_, answer)): (&Vec<Wrong>, (&Case, &ImageAnswer))| {
        let Some(wrong) = layers.iter().find(|wrong| wrong.id == id) else {
            return answer.expected.clone();
        };
        let light = |levels: Levels| DVec3::from(levels.map(f64::from)) / 255.0;
        let right = answer.expected.pixels().iter().map(|right| right.to_array().map(byte));
        let mut pixels: Vec<DVec3> = right.map(light).collect();
        for (n, levels) in wrong.pixels.iter().zip(&wrong.colours) {
            pixels[*n as usize] = light(*levels);
        }
        Image::from_pixels(answer.expected.width(), answer.expected.height(), pixels).unwrap()
    };
    LAYERS.iter().zip(DESK.cases()).map(picture).collect()
}

#[test]
fn nearly_every_mistake_is_named_alone_and_no_other_is() {
    each_is_named(&known(), |wrong| {
        DESK.explain(&stored(wrong.id), |_, right| {
            Some(right.wrong.get(wrong.id).unwrap_or(&right.answer).clone())
        })
    });
}

/// Every third mistake. No picture distinguishes the mistakes of the threshold from each other.
#[test]
fn mistakes_are_named_from_pictures_alone() {
    let known = known().into_iter().filter(|wrong| wrong.field != "cutoff");
    let mistakes: Vec<_> = known.step_by(3).collect();
    each_is_named(&mistakes, |wrong| DESK.explain(&stored(wrong.id), |_, _| None));
}

/// Every ninth mistake, rendered in single precision.
#[test]
fn mistakes_are_named_in_single_precision_too() {
    let mistakes: Vec<_> = known().into_iter().step_by(9).collect();
    each_is_named(&mistakes, |wrong| {
        let rules = wrong.on(&Rules::LECTURE);
        let picture = |(case, _): (&Case, &ImageAnswer)| {
            let world = World::<f32>::new(&case.scene);
            in_bytes(&render(&world, &rules, &Options::of(&world), |_| {}).0)
        };
        let pictures: Vec<Image> = DESK.cases().map(picture).collect();
        DESK.explain(&pictures, |check, _| Some(answer_in::<f32, _>(&rules, &check.ask)))
    });
}

#[test]
fn of_several_mistakes_most_are_named_and_hardly_any_other() {
    let drawn = [combinations(11, 8, 2), combinations(12, 6, 3)].concat();
    let of_one = |mistakes: &Vec<&'static Misconception>| {
        let explanation = DESK.explain(&DESK.render(&parts(mistakes)), |_, _| None);
        Names::of(mistakes, &names(&explanation))
    };
    let all: Vec<Names> = drawn.par_iter().map(of_one).collect();
    let sum = all.into_iter().fold(Names::default(), Names::plus);
    assert!(sum.found as f64 >= 0.8 * sum.parts as f64 && sum.wrong + sum.near <= 1, "{sum}");
}

/// Of the mistakes that hide each other, rendering finds at least as many, and adds no wrong name.
#[test]
fn rendering_the_named_mistakes_together_finds_hidden_ones() {
    let (mut before, mut after) = (Names::default(), Names::default());
    for mistakes in combinations(13, 4, 3) {
        let pictures = DESK.render(&parts(&mistakes));
        let explanation = DESK.explain(&pictures, |_, _| None);
        before = before.plus(Names::of(&mistakes, &names(&explanation)));
        let confirmed = DESK.confirm(&pictures, explanation);
        after = after.plus(Names::of(&mistakes, &names(&confirmed)));
    }
    assert!(after.found >= before.found && after.wrong <= before.wrong, "{before}; {after}");
}

#[test]
fn a_right_program_with_spoilt_pictures_is_given_no_mistake_of_a_tracer() {
    let of_one = |at: usize| {
        let nuisance = &NUISANCES[at];
        let pictures: Vec<Image> =
            DESK.cases().map(|(_, answer)| nuisance.of(&answer.expected)).collect();
        let explanation = DESK.explain(&pictures, |_, right| Some(right.answer.clone()));
        let named = names(&explanation);
        let is_right = match nuisance.film {
            Some(film) => named == [[film]],
            None => {
                let mistakes = explanation.diagnoses.iter().flat_map(|one| &one.mistakes);
                mistakes
                    .into_iter()
                    .all(|mistake| mistake.rule == 0 && mistake.id != "last_rows_missing")
            }
        };
        (!is_right).then(|| format!("{}: {named:?}", nuisance.name))
    };
    let faults: Vec<String> = (0..NUISANCES.len()).into_par_iter().filter_map(of_one).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
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
        let picture = |(_, answer): (&Case, &ImageAnswer)| {
            Image::from_fn(answer.expected.width(), answer.expected.height(), fill)
        };
        let pictures: Vec<Image> = DESK.cases().map(picture).collect();
        for reply in [None, Some(Answer::Miss(true))] {
            let explanation = DESK.explain(&pictures, |_, right| {
                Some(reply.clone().unwrap_or_else(|| right.answer.clone()))
            });
            assert_eq!(explanation.diagnoses, [], "{name} instead of every picture, {reply:?}");
            let rest = explanation.unexplained.expect("everything is unexplained");
            assert!(rest.checks.len() >= DESK.cases().count(), "{name}");
            let worst = rest.worst.expect("a pixel to look at");
            assert!(worst.cluster > 10_000, "{name}: {worst:?}");
        }
    }
}

#[test]
fn a_mistake_is_named_with_what_it_explains() {
    let explanation = DESK.explain(&stored("no_shadows"), |_, _| None);
    let [Diagnosis { confidence, explains, .. }] = explanation.diagnoses.as_slice() else {
        panic!("{explanation:?}")
    };
    assert_eq!((*confidence, explanation.unexplained), (Confidence::Surely, None));
    for one in explains {
        let [left, top, right, bottom] = one.region.expect("the bounds of a region");
        assert!(one.pixels > 3 && left <= right && top <= bottom, "{one:?}");
        let case = DESK.cases().find(|(case, _)| case.id == one.id).expect("the case").0;
        let render = &case.scene.render;
        assert!(right < render.width && bottom < render.height, "{one:?}");
    }
    assert!(explains.iter().any(|one| one.id == "02_shadows/two_lamps"), "{explains:?}");
}
