//! Tests of all cases together: every rule is covered, every case shows what it promises, points
//! add up, answers are current.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use cases::answer::{self, CheckAnswer, ImageAnswer};
use cases::film::Image;
use cases::probe::{Answer, Ask};
use cases::stage::{self, Case, Stage};
use cases::{Course, Effect, Effects, Scene};
use grader::exam::Exam;
use grader::record::Verdict;
use grader::{judge, lint};
use pages::say;
use reference::expect::variations::{Precision, Variation, variations};
use reference::expect::{self, Set};
use reference::numbers::real::Real;
use reference::rules::misconceptions::{self, Misconception};
use reference::rules::{Epsilon, Lecture, RuleSource, Rules};
use reference::trace::answers;
use reference::trace::render::{self, Options};
use reference::watch::Counts;
use reference::world::World;

/// The rules that stages test; the others are extras.
const RULES: std::ops::RangeInclusive<u8> = 1..=21;

static STAGES: LazyLock<Vec<Stage>> = LazyLock::new(|| {
    stage::load_all(&folder(), &Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)))
});

static SET: LazyLock<Set> = LazyLock::new(|| Set::new(STAGES.clone(), &Course::default()));

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages")
}

fn image_cases() -> impl Iterator<Item = &'static Case> {
    STAGES.iter().flat_map(|stage| &stage.cases)
}

fn broken(rule: u8) -> impl Iterator<Item = &'static Misconception> {
    misconceptions::of(&Rules::LECTURE).into_iter().filter(move |wrong| wrong.rule == rule)
}

fn stored(case: &Case) -> ImageAnswer {
    let path = answer::image_answer_path(&folder(), &case.id);
    let bytes = std::fs::read(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let render = case.scene.render;
    ImageAnswer::decode(&bytes, render.width, render.height)
        .unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

fn picture<T: Real, R: RuleSource>(scene: &Scene, rules: R, effects: Effects) -> Image {
    let world = World::<T>::new(scene);
    render::render(&world, rules, &Options { effects, ..Options::of(&world) }, |_| {}).0
}

fn passes(case: &Case, actual: &Image) -> bool {
    judge::picture(actual, &stored(case)).verdict == Verdict::Pass
}

/// Returns whether the case passes a program that follows `rules` instead of the lecture's.
fn forgives(case: &Case, rules: &Rules) -> bool {
    passes(case, &picture::<f64, _>(&case.scene, rules, case.scene.effects))
}

/// Fails with all lines if there are any.
fn none(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Each stage has 25 points; the values are in thousandths.
#[test]
fn every_stage_is_worth_25_points() {
    for stage in STAGES.iter() {
        let images: u64 = stage.cases.iter().map(|case| case.points).sum();
        assert_eq!(images + stage.unit_points, 25_000, "{}", stage.id);
    }
}

#[test]
fn every_rule_has_a_picture_and_a_question() {
    let pictures: BTreeSet<u8> =
        image_cases().flat_map(|case| case.rules.iter().copied()).collect();
    let questions: BTreeSet<u8> = STAGES
        .iter()
        .flat_map(|stage| &stage.checks)
        .flat_map(|check| check.rules.iter().copied())
        .collect();
    assert_eq!(pictures, RULES.collect(), "rules named by image cases");
    assert_eq!(questions, RULES.collect(), "rules named by unit checks");
}

#[test]
fn every_rule_that_a_case_names_can_be_seen_broken_in_it() {
    none(
        image_cases()
            .flat_map(|case| case.rules.iter().map(move |rule| (case, *rule)))
            .filter(|(case, rule)| {
                broken(*rule).all(|wrong| forgives(case, &wrong.on(&Rules::LECTURE)))
            })
            .map(|(case, rule)| {
                format!("{}: no known way of breaking rule {rule} shows in it", case.id)
            })
            .collect(),
    );
}

/// The cases that name the rule of the mistake come first. The others are rendered only if none of
/// those fails it.
#[test]
fn every_misconception_is_caught() {
    none(
        misconceptions::of(&Rules::LECTURE)
            .into_iter()
            .filter(|wrong| {
                let names_it = |case: &&Case| case.rules.contains(&wrong.rule);
                let (first, rest): (Vec<_>, Vec<_>) = image_cases().partition(names_it);
                let rules = wrong.on(&Rules::LECTURE);
                first.into_iter().all(|case| forgives(case, &rules))
                    && !fails_a_question(&rules)
                    && rest.into_iter().all(|case| forgives(case, &rules))
            })
            .map(|wrong| {
                format!("{} (rule {}) passes every case and every check", wrong.id, wrong.rule)
            })
            .collect(),
    );
}

/// Two mistakes without a difference could only be named together, and the student would search for
/// one of them in vain.
#[test]
fn any_two_misconceptions_differ_in_some_case_or_check() {
    let exam = Exam::load(&folder()).unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!(exam.mistakes.len(), misconceptions::of(&Rules::LECTURE).len());
    let alike = lint::alike(&exam).unwrap_or_else(|why| panic!("{why}"));
    none(alike.iter().map(|[one, other]| format!("{one} looks like {other}")).collect());
}

fn fails_a_question(rules: &Rules) -> bool {
    STAGES.iter().any(|stage| {
        let stored = check_answers(stage);
        stage.checks.iter().zip(&stored).any(|(check, right)| {
            judge::unit(&answers::answer(rules, &check.ask), right, check.ask.function()).verdict
                != Verdict::Pass
        })
    })
}

fn check_answers(stage: &Stage) -> Vec<CheckAnswer> {
    if stage.checks.is_empty() {
        return Vec::new();
    }
    let path = answer::check_answers_path(&folder(), &stage.id);
    let text =
        std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    answer::check_answers_from_str(&text).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// Where rounding decides, each of the correct answers passes. A number of it that is off, or an
/// answer of another kind, fails.
#[test]
fn where_rounding_decides_the_correct_answers_pass_and_no_other() {
    let checks = STAGES.iter().flat_map(|stage| stage.checks.iter().zip(check_answers(stage)));
    let undecided: Vec<_> = checks.filter(|(_, right)| !right.also.is_empty()).collect();
    assert!(undecided.len() >= 5, "{} checks have several correct answers", undecided.len());
    for (check, right) in undecided {
        let verdict = |given: &Answer| judge::unit(given, &right, check.ask.function()).verdict;
        for legal in std::iter::once(&right.answer).chain(&right.also) {
            assert_eq!(verdict(legal), Verdict::Pass, "{}: {legal:?}", check.id);
            let wrong = off(legal);
            assert_eq!(verdict(&wrong), Verdict::Fail, "{}: {wrong:?}", check.id);
        }
        let wrong = Answer::Found { t: 1e3, object: 77 };
        assert_eq!(verdict(&wrong), Verdict::Fail, "{}: {wrong:?}", check.id);
    }
}

/// Returns an answer that decides like `legal`, with a number that is off by 1 or without a sense.
fn off(legal: &Answer) -> Answer {
    match legal {
        Answer::Hit { t, normal } => Answer::Hit { t: t + 1.0, normal: *normal },
        Answer::Found { t, object } => Answer::Found { t: t + 1.0, object: *object },
        Answer::Vector(v) => Answer::Vector(*v + cases::glam::DVec3::Z),
        _ => Answer::Value(f64::NAN),
    }
}

/// The first stage is skipped, because it adds nothing to another one.
#[test]
fn no_case_passes_without_what_its_stage_adds() {
    let later = SET.stages.iter().enumerate().skip(1);
    none(
        later
            .flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, case)))
            .filter(|(n, case)| passes(case, &SET.without(*n, case)))
            .map(|(n, case)| format!("{} passes without {:?}", case.id, SET.stages[n].base))
            .collect(),
    );
}

/// An effect that a scene does not call for changes no bit of the picture. Without the effect, no
/// ray of its kind is cast.
#[test]
fn a_case_is_the_same_with_the_effects_it_does_not_call_for() {
    let cases = STAGES.iter().flat_map(|stage| stage.cases.iter().map(|case| (case, stage.allows)));
    none(
        cases
            .filter(|(case, allowed)| {
                let effects = case.scene.effects;
                let (special, rays) = rendered(case, effects);
                let casts = [
                    (Effect::Shadows, rays.shadow),
                    (Effect::Reflection, rays.reflected),
                    (Effect::Refraction, rays.refracted),
                ];
                let casts_more =
                    casts.iter().any(|(effect, n_cast)| *n_cast > 0 && !effects.has(*effect));
                casts_more || special.pixels() != rendered(case, *allowed).0.pixels()
            })
            .map(|(case, _)| format!("{} calls for more than its effects", case.id))
            .collect(),
    );
}

fn rendered(case: &Case, effects: Effects) -> (Image, Counts) {
    let world = World::<f64>::new(&case.scene);
    let (image, stats) =
        render::render(&world, Lecture, &Options { effects, ..Options::of(&world) }, |_| {});
    (image, stats.rays)
}

/// Fairness: the least and the greatest epsilon that students may choose cost no point.
#[test]
fn any_epsilon_that_students_may_choose_passes_every_case() {
    for t in [1e-6, 1e-3] {
        let rules = Rules { epsilon: Epsilon::Fixed(t), ..Rules::LECTURE.plain() };
        none(
            image_cases()
                .filter(|case| !forgives(case, &rules))
                .map(|case| format!("{} fails with epsilon {t}", case.id))
                .collect(),
        );
    }
}

/// Fairness: rounding to single precision costs no point.
#[test]
fn a_program_in_single_precision_passes_every_case() {
    none(
        image_cases()
            .filter(|case| {
                !passes(case, &picture::<f32, _>(&case.scene, Lecture, case.scene.effects))
            })
            .map(|case| format!("{} fails in single precision", case.id))
            .collect(),
    );
}

/// The variations that students may choose, each with each precision, with rays through the exact
/// centres of pixels.
#[test]
fn every_legal_way_of_computing_passes_every_check() {
    let centred = |mut way: Variation| {
        way.rules.style.nudge = [0.0; 2];
        way
    };
    let ways: Vec<Variation> = variations(&Rules::LECTURE).into_iter().map(centred).collect();
    let answer = |way: &Variation, ask: &Ask| match way.precision {
        Precision::F32 => answers::answer_in::<f32, _>(&way.rules, ask),
        Precision::F64 => answers::answer_in::<f64, _>(&way.rules, ask),
    };
    let in_single =
        |ask: &Ask| ("single precision".to_owned(), answers::answer_in::<f32, _>(Lecture, ask));
    let checks = STAGES.iter().flat_map(|stage| stage.checks.iter().zip(check_answers(stage)));
    let answered = checks.flat_map(|(check, right)| {
        let by_ways = ways.iter().map(|way| (way.name.clone(), answer(way, &check.ask)));
        let judged = |(way, given)| (check, judge::unit(&given, &right, check.ask.function()), way);
        by_ways.chain([in_single(&check.ask)]).map(judged).collect::<Vec<_>>()
    });
    none(
        answered
            .filter(|(_, judged, _)| judged.verdict != Verdict::Pass)
            .map(|(check, judged, way)| {
                let message = judged.finding.map(|finding| finding.message).unwrap_or_default();
                format!("{} fails with {way}: {message}", check.id)
            })
            .collect(),
    );
}

#[test]
fn the_stored_answers_are_what_the_reference_gives() {
    let stages = folder();
    let cases = SET
        .stages
        .iter()
        .enumerate()
        .flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, case)));
    let pictures = cases.flat_map(|(n, case)| {
        expect::of_case(&stages, &SET, n, case).unwrap_or_else(|why| panic!("{why}")).files
    });
    let checks = STAGES.iter().filter_map(|stage| {
        expect::of_checks(&stages, stage, &SET.course)
            .unwrap_or_else(|wrong| panic!("{}", say::paragraphs(&wrong)))
    });
    let mistakes = expect::mistakes(&stages, &SET.course).unwrap_or_else(|why| panic!("{why}"));
    none(
        pictures
            .chain(checks)
            .chain([mistakes])
            .filter(|expected| !expected.is_stored())
            .map(|expected| {
                format!("{} is not current: run `reference expect`", expected.path.display())
            })
            .collect(),
    );
}
