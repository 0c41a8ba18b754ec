//! Tests that every known mistake is visible: it changes the picture of some case or the answer to
//! some unit check.

use cases::Course;
use cases::course::{self, DECISIONS, Decision, Deviation, Legal};
use cases::film::{Image, level};
use cases::probe::Ask;
use cases::stage::{self, Stage};
use reference::rules::misconceptions::{self, Misconception};
use reference::rules::{Depth, Lecture, RuleSource, Rules};
use reference::trace::answers::answer;
use reference::trace::render::{Options, render};
use reference::world::World;

fn stages() -> Vec<Stage> {
    stage::load_all(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../cases/stages").as_ref(),
        &cases::Course::default(),
    )
    .unwrap()
}

/// Returns the id, the world and the lecture's picture of every public case, in a small size.
fn worlds(stages: &[Stage]) -> Vec<(String, World<f64>, Image)> {
    let cases = stages.iter().flat_map(|stage| stage.cases.clone());
    cases
        .map(|mut case| {
            (case.scene.render.width, case.scene.render.height) = (48, 36);
            let world = World::new(&case.scene);
            let image = picture(&world, Lecture);
            (case.id, world, image)
        })
        .collect()
}

fn picture(world: &World<f64>, rules: impl RuleSource) -> Image {
    render(world, rules, &Options::of(world), |_| {}).0
}

/// Returns the number of pixels that differ by more than a quarter of a level.
fn n_changed(one: &Image, other: &Image) -> usize {
    let is_close = |a: f64, b: f64| (level(a) - level(b)).abs() <= 0.25;
    let differs = |(a, b): (&glam::DVec3, &glam::DVec3)| (0..3).any(|c| !is_close(a[c], b[c]));
    one.pixels().iter().zip(other.pixels()).filter(|pair| differs(*pair)).count()
}

/// Returns a question whose normal faces away from the viewer, as an interpolated one may near a
/// silhouette: N·H = −0.2/√0.4 < 0.
fn turned_away() -> Ask {
    let material = r#"{"name":"gloss","ke":[0,0,0],"ka":[0,0,0],"kd":[0,0,0],"ks":[1,1,1],"kt":[0,0,0],"kr":[0,0,0],"ns":2,"index":1}"#;
    Ask::LightTerm {
        material: serde_json::from_str(material).unwrap(),
        arriving: glam::DVec3::ONE,
        normal: glam::DVec3::Z,
        to_viewer: glam::DVec3::NEG_Z,
        to_light: glam::DVec3::new(0.6, 0.0, 0.8),
    }
}

#[test]
fn every_misconception_changes_some_case_or_check() {
    let stages = stages();
    let worlds = worlds(&stages);
    let questions: Vec<_> =
        stages.iter().flat_map(|stage| &stage.checks).map(|check| &check.ask).collect();
    let turned_away = turned_away();
    for (id, world, lecture) in &worlds {
        let mine = picture(world, &reference::rules::Rules::LECTURE);
        assert_eq!(
            mine.pixels(),
            lecture.pixels(),
            "{id}: rules as a value give other bits than rules as a constant"
        );
    }
    let is_unseen = |m: &&'static Misconception| {
        let rules = m.on(&Rules::LECTURE);
        let mut questions = questions.iter().copied().chain([&turned_away]);
        let is_answer_changed = questions.any(|ask| answer(&rules, ask) != answer(Lecture, ask));
        !is_answer_changed
            && worlds
                .iter()
                .all(|(_, world, lecture)| n_changed(&picture(world, &rules), lecture) == 0)
    };
    let unseen: Vec<_> =
        misconceptions::of(&Rules::LECTURE).into_iter().filter(is_unseen).map(|m| m.id).collect();
    assert!(unseen.is_empty(), "no case and no check shows {unseen:?}");
}

#[test]
fn every_rule_has_a_misconception_and_every_id_is_its_own() {
    let all = misconceptions::of(&Rules::LECTURE);
    for rule in 1..=21 {
        assert!(all.iter().any(|m| m.rule == rule), "rule {rule} cannot be broken");
    }
    let mut ids: Vec<_> = everywhere().iter().map(|m| m.id).collect();
    let n_ids = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), n_ids);
    assert!(all.is_sorted_by_key(|m| m.rule));
}

/// Returns the courses that differ from the lecture in a rule of light, each by one key.
fn deviations() -> impl Iterator<Item = Deviation> {
    course::deviations().into_iter().filter(|deviation| deviation.decision.legal != Legal::Effects)
}

/// Returns every mistake of the lecture or of a course that deviates from it, each once.
fn everywhere() -> Vec<&'static Misconception> {
    let mut all = misconceptions::of(&Rules::LECTURE);
    for deviation in deviations() {
        let more = misconceptions::of(&Rules::of(&deviation.course));
        all.extend(
            more.into_iter().filter(|new| all.iter().all(|m| m.id != new.id)).collect::<Vec<_>>(),
        );
    }
    all
}

#[test]
fn the_default_course_is_the_lecture() {
    assert_eq!(Rules::of(&Course::default()), Rules::LECTURE);
}

#[test]
fn in_every_course_each_mistake_is_one_and_no_two_are_the_same() {
    for Deviation { line: name, course, .. } in deviations() {
        let rules = Rules::of(&course);
        assert_ne!(rules, Rules::LECTURE, "{name} changes nothing");
        let mistaken: Vec<_> =
            misconceptions::of(&rules).into_iter().map(|m| (m.id, m.on(&rules))).collect();
        for (n, (id, mistake)) in mistaken.iter().enumerate() {
            assert_ne!(*mistake, rules, "{id} is what the course with {name} requires");
            for (other, same) in &mistaken[..n] {
                assert_ne!(mistake, same, "in the course with {name}, {id} is {other}");
            }
        }
    }
}

/// Every other value that a course could have chosen is a mistake in it, except for the choices of
/// students. A program that counts rows from the other end draws the picture upside down, and one
/// that allows one more bounce does so at max_depth 0 too.
#[test]
fn every_other_choice_of_a_course_is_a_mistake_in_it() {
    let is_free =
        |decision: &&Decision| !["epsilon", "bytes", "always_simulated"].contains(&decision.key);
    let of = |text: &str| Rules::of(&course::parse("course.toml", text).unwrap());
    for decision in DECISIONS.iter().filter(is_free) {
        let Legal::OneOf(values) = decision.legal else {
            panic!("{} is not a choice among values", decision.key)
        };
        let courses: Vec<Rules> =
            values.iter().map(|(value, _)| of(&format!("{} = {value}", decision.key))).collect();
        for (rules, (value, _)) in courses.iter().zip(values) {
            let wrong: Vec<Rules> = misconceptions::of(rules).iter().map(|m| m.on(rules)).collect();
            for other in courses.iter().filter(|other| *other != rules) {
                let depth =
                    if other.depth == Depth::OneMore { Depth::LessOrEqual } else { other.depth };
                let program = Rules { picture_from_top: rules.picture_from_top, depth, ..*other };
                assert!(
                    wrong.contains(&program),
                    "{} = {value}: another choice is not a known mistake",
                    decision.key
                );
            }
        }
    }
}

#[test]
fn every_function_to_look_at_is_one_of_the_template() {
    let template = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../student_template/src");
    for m in everywhere() {
        let (file, function) = m.look_at.split_once(' ').unwrap();
        let text = std::fs::read_to_string(template.join(file))
            .unwrap_or_else(|why| panic!("{}: {file}: {why}", m.id));
        assert!(
            text.contains(&format!("pub fn {function}(")),
            "{}: {file} has no {function}",
            m.id
        );
    }
}
