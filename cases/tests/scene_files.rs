//! Tests of scene files without mistakes.

use std::path::Path;

use cases::scene::{self, Scene};
use cases::stage;

fn good(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good").join(name);
    stage::load_scene(&path, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

#[test]
fn names_become_indices_in_order() {
    let scene = good("ball_beyond_lamp.toml");
    let names: Vec<&str> = scene.materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["brick", "chalk"]);
    assert_eq!(scene.objects.iter().map(|object| object.material).collect::<Vec<_>>(), [1, 0, 0]);
    assert_eq!(scene.objects[2].name, "objects[2]");
    assert_eq!((scene.render.width, scene.render.height, scene.render.max_depth), (160, 120, 0));
}

#[test]
fn json_gives_the_same_scene_bit_for_bit() {
    for name in ["ball_beyond_lamp.toml", "everything.toml"] {
        let scene = good(name);
        let text = scene::json::to_string(&scene);
        assert_eq!(scene::parse_json(name, &text).unwrap(), scene, "{name}");
        assert_eq!(scene::json::to_string(&scene::json::from_str(&text).unwrap()), text, "{name}");
    }
}
