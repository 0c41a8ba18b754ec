//! Tests that the reference renders and answers as a course decides.

use crate::common::{Random, random};
use cases::course::{self, Course};
use cases::film::Image;
use cases::probe::{Answer, Ask};
use cases::stage::{self, Case};
use glam::DVec3;
use pages::say;
use rayon::prelude::*;
use reference::expect;
use reference::rules::misconceptions;
use reference::rules::{Lecture, Rules};
use reference::trace::answers::answer;
use reference::trace::render::{Options, render, render_by};
use reference::world::World;

fn rules(text: &str) -> Rules {
    Rules::of(&course::parse("course.toml", text).unwrap_or_else(|problems| panic!("{problems}")))
}

fn case(id: &str) -> Case {
    let path = format!("{}/../cases/stages/{id}.toml", env!("CARGO_MANIFEST_DIR"));
    stage::load_case(path.as_ref(), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

fn picture(case: &Case, rules: &Rules) -> Image {
    let world = World::<f64>::new(&case.scene);
    render_by(&world, rules, &Options::of(&world), |_| {}).0
}

/// A choice gives one picture, whether a course makes it or a mistake does. The lecture gives a
/// different one.
#[test]
fn what_is_a_mistake_in_one_course_is_the_picture_of_another() {
    let table = [
        ("depth = \"<=\"", "one_bounce_too_many", "03_reflection/one_bounce_only"),
        ("pixel = \"corner\"", "pixel_corner", "03_reflection/golden_ball"),
        ("highlight = \"phong\"", "phong_highlight", "03_reflection/gloss_is_no_mirror"),
        ("index_of_air = 1", "air_is_one", "04_refraction/crystal_ball"),
        ("tint = \"none\"", "glass_casts_no_shadow", "04_refraction/crystal_ball"),
    ];
    for (text, mistake, id) in table {
        let (case, course) = (case(id), rules(text));
        let known = misconceptions::of(&Rules::LECTURE);
        let mistake =
            known.iter().find(|known| known.id == mistake).unwrap_or_else(|| panic!("{mistake}"));
        let by_course = picture(&case, &course);
        assert!(
            by_course.pixels() == picture(&case, &mistake.on(&Rules::LECTURE)).pixels(),
            "{text}: {id}"
        );
        assert!(
            by_course.pixels() != picture(&case, &Rules::LECTURE).pixels(),
            "{text} changes nothing in {id}"
        );
        assert!(
            misconceptions::of(&course).iter().all(|known| known.id != mistake.id),
            "{} is a mistake, although the course requires it",
            mistake.id
        );
    }
}

#[test]
fn the_default_course_is_rendered_by_the_kernel_of_the_lecture() {
    let case = case("04_refraction/crystal_ball");
    let world = World::<f64>::new(&case.scene);
    let lecture = render(&world, Lecture, &Options::of(&world), |_| {}).0;
    assert!(picture(&case, &Rules::of(&Course::default())).pixels() == lecture.pixels());
}

/// The picture stays upright. With rays through centres it changes only by rounding, and with rays
/// through corners it moves by a row.
#[test]
fn rows_from_the_bottom_leave_the_picture_upright() {
    let case = case("03_reflection/golden_ball");
    let n_different = |one: &str, other: &str| {
        let (one, other) = (picture(&case, &rules(one)), picture(&case, &rules(other)));
        one.pixels()
            .iter()
            .zip(other.pixels())
            .filter(|(a, b)| (**a - **b).abs().max_element() > 1e-6)
            .count()
    };
    assert!(n_different("# lecture", "row_0 = \"bottom\"") <= 3, "only silhouettes may differ");
    assert!(n_different("pixel = \"corner\"", "pixel = \"corner\"\nrow_0 = \"bottom\"") > 100);
    // Row 0 of 4 at the bottom, 90 degrees: y = 2 (0 + 1/2)/4 − 1 = −3/4, and from the corner −1.
    let camera = case.scene.camera;
    let camera = cases::Camera { fov_y_deg: 90.0, ..camera };
    let ask = Ask::EyeRay { camera, width: 4, height: 4, pixel: [0, 0] };
    let slope = |text: &str| match answer(&rules(text), &ask) {
        Answer::Ray { direction, .. } => direction.dot(camera.up) / direction.dot(camera.forward),
        other => panic!("{other:?}"),
    };
    for (text, y) in [
        ("# lecture", 0.75),
        ("row_0 = \"bottom\"", -0.75),
        ("pixel = \"corner\"", 1.0),
        ("pixel = \"corner\"\nrow_0 = \"bottom\"", -1.0),
    ] {
        assert!((slope(text) - y).abs() < 1e-12, "{text}: {} is not {y}", slope(text));
    }
}

/// N·L = −0.6 and there is no highlight. If the course lights surfaces from behind, the term is
/// |N·L| kd = 0.6 · 0.5.
#[test]
fn light_from_behind_is_for_those_whom_the_course_gives_it() {
    let term = |text: &str, kt: f64| {
        let material = format!(
            r#"{{"name":"m","ke":[0,0,0],"ka":[0,0,0],"kd":[0.5,0.5,0.5],"ks":[0,0,0],"kt":[{kt},0,0],"kr":[0,0,0],"ns":1,"index":1.5}}"#
        );
        let ask = Ask::LightTerm {
            material: serde_json::from_str(&material).unwrap(),
            arriving: DVec3::ONE,
            normal: DVec3::Z,
            to_viewer: DVec3::Z,
            to_light: DVec3::new(0.8, 0.0, -0.6),
        };
        match answer(&rules(text), &ask) {
            Answer::Colour(colour) => colour,
            other => panic!("{other:?}"),
        }
    };
    for (course, kt, expected) in [
        ("two_sided = \"never\"", 0.0, 0.0),
        ("two_sided = \"never\"", 0.9, 0.0),
        ("two_sided = \"transmissive\"", 0.0, 0.0),
        ("two_sided = \"transmissive\"", 0.9, 0.3),
        ("two_sided = \"always\"", 0.0, 0.3),
        ("two_sided = \"always\"", 0.9, 0.3),
    ] {
        assert_eq!(term(course, kt), DVec3::splat(expected), "{course}, kt {kt}");
    }
}

#[test]
fn answers_follow_the_course() {
    let goes_on =
        Ask::GoesOn { depth: 3, max_depth: 3, weight: DVec3::new(0.5, 0.1, 0.5), threshold: 0.2 };
    let shallow =
        Ask::GoesOn { depth: 2, max_depth: 3, weight: DVec3::new(0.5, 0.1, 0.5), threshold: 0.2 };
    for (text, expected) in [
        ("# lecture", [false, true]),
        ("depth = \"<=\"", [true, true]),
        ("cutoff = \"any_channel\"", [false; 2]),
    ] {
        let found = [&goes_on, &shallow].map(|ask| answer(&rules(text), ask));
        assert_eq!(found, expected.map(Answer::GoesOn), "{text}");
    }
    let indices = Ask::Indices { inside: true, index: 1.5 };
    assert_eq!(
        answer(&rules("index_of_air = 1"), &indices),
        Answer::Indices { eta_i: 1.5, eta_t: 1.0 }
    );
}

/// Answers on paper name the courses for which they hold, so one command sets up any legal course.
/// This test covers each course that differs from the lecture in one key, one that differs in
/// three, as a real course does, and random ones.
#[test]
fn every_legal_course_has_answers_to_all_unit_checks() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let three = "highlight = \"phong\"\npixel = \"corner\"\nindex_of_air = 1.0";
    let mut courses = vec![("# lecture".to_owned(), Course::default())];
    courses.push((three.to_owned(), course::parse("three", three).unwrap()));
    courses.extend(
        course::deviations().into_iter().map(|deviation| (deviation.line, deviation.course)),
    );
    courses.extend((1..=40).map(|seed| {
        let course = random::course(&mut Random(0x9e37_79b9_7f4a_7c15u64.wrapping_mul(seed)));
        (format!("random course {seed}: {:?}", course.written()), course)
    }));
    let wrong: Vec<String> = courses
        .par_iter()
        .flat_map_iter(|(name, course)| {
            let stages = stage::load_all(&folder, course)
                .unwrap_or_else(|problems| panic!("{name}: {problems}"));
            let rules = Rules::of(course);
            let checks = stages.iter().flat_map(|stage| &stage.checks);
            let failed = checks.filter_map(|check| expect::right_answer(check, &rules).err());
            failed.map(|why| format!("{name}: {}", say::chain(&why))).collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// An answer on paper that holds in only one course still has to be correct in that one.
#[test]
fn an_answer_on_paper_is_checked_where_it_holds() {
    let text = |paper: &str| {
        format!(
            "[[check]]\nname = \"into_water\"\nabout = \"a\"\nrules = [9]\n\
             ask = {{ fn = \"indices\", inside = false, index = 1.33 }}\n{paper}\n"
        )
    };
    let right = "paper = { indices = { eta_i = 1.0003, eta_t = 1.33 } }";
    let wrong = "paper = { indices = { eta_i = 1.5, eta_t = 1.33 } }";
    let table = [
        (right.to_owned(), "# lecture", true),
        (right.to_owned(), "index_of_air = 1", false),
        (format!("{right}\nunder = {{ index_of_air = 1.0003 }}"), "index_of_air = 1", true),
        (format!("{right}\nunder = {{ index_of_air = [1.0, 1.0003] }}"), "index_of_air = 1", false),
        (
            format!("{right}\nunder = {{ index_of_air = 1.0003, tint = \"opaque\" }}"),
            "# lecture",
            true,
        ),
        (format!("{wrong}\nunder = {{ index_of_air = 1.0003 }}"), "# lecture", false),
        (format!("{wrong}\nunder = {{ index_of_air = 1.0003 }}"), "index_of_air = 1", true),
    ];
    for (paper, line, is_right) in table {
        let folder = tempfile::tempdir().unwrap();
        let stage = folder.path().join("01_a");
        std::fs::create_dir_all(stage.join("checks")).unwrap();
        let about = "title = \"a\"\nabout = \"a\"\nallows = []\nunit_points = 1\n";
        std::fs::write(stage.join("stage.toml"), about).unwrap();
        std::fs::write(stage.join("checks/indices.toml"), text(&paper)).unwrap();
        let course = course::parse("course", line).unwrap();
        let stages =
            stage::load_all(folder.path(), &course).unwrap_or_else(|problems| panic!("{problems}"));
        let answered = expect::of_checks(folder.path(), &stages[0], &course);
        assert_eq!(answered.is_ok(), is_right, "{paper} under {line}: {answered:?}");
    }
}
