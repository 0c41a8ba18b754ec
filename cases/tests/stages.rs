//! Tests of stages: the content of a folder of stages, and the errors of one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use cases::probe::{Ask, Question};
use cases::stage::{self, Stage};
use cases::{Effect, Effects, Ray};

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(path)
}

fn stages() -> Vec<Stage> {
    stage::load_all(&here("stages"), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

#[test]
fn ids_are_paths_and_points_are_exact() {
    let stages = stages();
    assert_eq!(
        stages.iter().map(|stage| stage.id.as_str()).collect::<Vec<_>>(),
        ["01_first", "02_second"]
    );
    assert_eq!(stages[0].unit_points, 1125);
    assert_eq!(stages[1].needs, ["01_first"]);
    let case = &stages[0].cases[0];
    assert_eq!(
        (case.id.as_str(), case.points, case.rules.as_slice()),
        ("01_first/mirror", 2500, &[3, 5][..])
    );
    assert_eq!(stages[0].checks[1].id, "01_first/every_function/sphere");
}

#[test]
fn a_case_has_the_effects_that_it_calls_for_and_its_stage_allows() {
    let only_shadows = Effects::NONE.with(Effect::Shadows);
    assert_eq!(stages()[0].cases[0].scene.effects, only_shadows);
    let path = here("stages/01_first/mirror.toml");
    assert_eq!(
        stage::load_case(&path, &cases::Course::default()).unwrap().scene.effects,
        only_shadows
    );
    assert_eq!(
        cases::stage::load_scene(&path, &cases::Course::default()).unwrap().effects,
        only_shadows
    );
    let free = std::fs::read_to_string(&path).unwrap();
    let free =
        cases::scene::parse("mirror", &free, Path::new(""), &cases::Course::default()).unwrap();
    assert_eq!(free.effects, only_shadows.with(Effect::Reflection));
}

#[test]
fn every_function_can_be_called() {
    let stages = stages();
    let checks = &stages[0].checks;
    let asked: BTreeSet<&str> = checks.iter().map(|check| check.ask.function()).collect();
    assert_eq!((asked.len(), checks.len()), (26, 26));
    for check in checks {
        let question = Question { id: check.id.clone(), ask: check.ask.clone() };
        let line = serde_json::to_string(&question).unwrap();
        assert_eq!(serde_json::from_str::<Question>(&line).unwrap(), question, "{line}");
        assert!(line.contains(&format!("\"fn\":\"{}\"", check.ask.function())), "{line}");
    }
}

#[test]
fn arguments_are_resolved() {
    let stages = stages();
    let ask =
        |name: &str| &stages[0].checks.iter().find(|check| check.id.ends_with(name)).unwrap().ask;
    let Ask::Sphere { ray, radius, .. } = ask("/sphere") else { panic!() };
    assert_eq!(*ray, Ray::new([0.0, 0.0, 2.0].into(), [0.0, 0.0, -1.0].into()));
    assert_eq!(*radius, 0.5);
    let Ask::RayToObject { object_from_world, .. } = ask("/ray_to_object") else { panic!() };
    assert_eq!(object_from_world.transform_point3([2.0, 4.0, 6.0].into()), [1.0, 2.0, 3.0].into());
    let Ask::Shade { scene, object, .. } = ask("/shade") else { panic!() };
    assert_eq!(scene.objects[*object].name, "ball");
    assert_eq!(scene.effects, stages[0].allows, "a check's scene simulates what its stage allows");
    let Ask::Reflect { direction, .. } = ask("/reflect") else { panic!() };
    assert!((direction.length() - 1.0).abs() < 1e-15);
}

#[test]
fn bounds_are_read_and_what_they_keep_must_be_there() {
    let path = here("stages/01_first/mirror.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let case = |vary: &str| {
        stage::parse_case(
            &path,
            &format!("{text}\n[vary]\n{vary}\n"),
            "01_first",
            Effects::all(),
            &cases::Course::default(),
        )
    };
    assert_eq!(stage::load_case(&path, &cases::Course::default()).unwrap().bounds, None);
    let bounds = case("eye = 0.5\nlights = [0.1, 0, 0.2]\nradii = 0.25\nkeep = [\"tin\"]")
        .unwrap()
        .bounds
        .unwrap();
    assert_eq!((bounds.eye.to_array(), bounds.lights.to_array()), ([0.5; 3], [0.1, 0.0, 0.2]));
    assert_eq!((bounds.radii, bounds.colours), (0.25, 0.0), "what is left out moves nothing");
    let problems = case("eye = 0.5\nkeep = [\"tinn\"]").unwrap_err().to_string();
    assert!(problems.contains("no material and no object is called `tinn`"), "{problems}");
    assert!(problems.contains("did you mean `tin`?"), "{problems}");
}
