//! Anti-aliased pictures are told from wrong ones, on every public case.

use cases::film::Image;
use cases::stage::Case;
use grader::judge::{self, Judgement};
use grader::record::{FindingKind, Verdict};
use reference::misconceptions;
use reference::render::{self, Options};
use reference::rules::{Lecture, RuleSource, Rules};
use reference::world::World;
use tests::public_stages;

fn public_cases() -> Vec<Case> {
    let stages =
        cases::stage::load_all(&public_stages()).unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    stages.into_iter().flat_map(|stage| stage.cases).collect()
}

fn stored(case: &Case) -> cases::answer::ImageAnswer {
    let bytes = std::fs::read(cases::answer::image_answer_path(&public_stages(), &case.id)).expect("an answer");
    cases::answer::ImageAnswer::decode(&bytes, case.scene.render.width, case.scene.render.height).expect("an answer")
}

fn judged<R: RuleSource>(case: &Case, rules: R, samples: u32) -> Judgement {
    let world = World::<f64>::new(&case.scene);
    let picture: Image = render::render(&world, rules, &Options { samples, ..Options::of(&world) }, |_| {}).0;
    judge::picture(&picture, &stored(case))
}

/// Fails with all the lines there are.
fn none(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// Several rays a pixel: named, never failed. Few pixels of a case that has few edges may pass.
#[test]
fn anti_aliased_pictures_are_named_on_every_case() {
    let tries = public_cases().into_iter().flat_map(|case| [2, 3, 4].map(|samples| (case.clone(), samples)));
    let judged = tries.map(|(case, samples)| (judged(&case, Lecture, samples), case.id, samples));
    let is_named = |judgement: &Judgement| match &judgement.finding {
        Some(finding) => finding.kind == FindingKind::Antialiased,
        None => judgement.verdict == Verdict::Pass,
    };
    none(
        judged
            .filter(|(one, ..)| !is_named(one))
            .map(|(one, id, n)| format!("{id}, {n} × {n} rays: {one:?}"))
            .collect(),
    );
}

/// A shift of half a pixel stays between the neighbours too, but is no mean of them.
#[test]
fn a_shift_is_not_taken_for_anti_aliasing() {
    let wrong = misconceptions::of(&Rules::LECTURE).into_iter().find(|wrong| wrong.id == "pixel_corner");
    let rules = wrong.expect("the mistake is known").on(&Rules::LECTURE);
    let judged = public_cases().into_iter().map(|case| (judged(&case, &rules, 1), case.id));
    let is_told = |judgement: &Judgement| judgement.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Wrong);
    none(judged.filter(|(one, _)| !is_told(one)).map(|(one, id)| format!("{id}: {one:?}")).collect());
}
