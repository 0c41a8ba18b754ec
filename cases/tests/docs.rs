//! Tests that `docs/scene-format.md` is generated from the current types. `UPDATE_EXPECTED=1`
//! writes it again, and then fails because nothing was tested.

use std::path::Path;

use serde_json::Value;

#[test]
fn the_scene_format_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scene-format.md");
    let made = cases::schema::scene_format_markdown();
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, made).unwrap();
        panic!("written; read it, then run without UPDATE_EXPECTED");
    }
    assert_eq!(
        std::fs::read_to_string(path).unwrap(),
        made,
        "run with UPDATE_EXPECTED=1 to write it again"
    );
}

#[test]
fn the_handout_is_that_of_the_committed_course() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let course = cases::course::load(&folder.join("course.toml"))
        .unwrap_or_else(|problems| panic!("{problems}"));
    let page = std::fs::read_to_string(folder.join("../docs/course.md")).unwrap();
    assert_eq!(page, cases::course::markdown(&course), "run `reference course > docs/course.md`");
}

#[test]
fn a_row_of_the_handout_has_as_many_cells_as_its_head() {
    let page = cases::course::markdown(&cases::Course::default());
    let n_bars = |line: &str| line.replace("\\|", "").matches('|').count();
    let mut head = None;
    for line in page.lines() {
        head = line.starts_with('|').then(|| head.unwrap_or_else(|| n_bars(line)));
        assert!(head.is_none_or(|n| n == n_bars(line)), "{line}");
    }
    assert!(page.contains("\\|N·L\\|"), "the page has no cell with a bar");
}

#[test]
fn the_example_of_the_scene_format_is_a_scene() {
    let text = cases::schema::scene_format_markdown();
    let example = text.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let scene = cases::scene::parse("example", example, Path::new(""), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let center = scene.objects[1].world_from_object.transform_point3([0.0; 3].into());
    assert_eq!(center.to_array(), [0.0, 0.2, 0.0], "as the text says");
}

/// Tests that every required key of every table is a property.
#[test]
fn schemas_are_whole() {
    use cases::schema::{
        case_schema, course_schema, probe_schema, scene_file_schema, scene_schema, stage_schema,
    };
    let (mut n_properties, draft) = (0, "http://json-schema.org/draft-07/schema#");
    for schema in [
        case_schema(),
        course_schema(),
        scene_file_schema(),
        stage_schema(),
        scene_schema(),
        probe_schema(),
    ] {
        assert_eq!(schema["$schema"], draft);
        walk(&schema, &mut |table| {
            let Some(properties) = table["properties"].as_object() else { return };
            n_properties += properties.len();
            for key in table["required"].as_array().into_iter().flatten() {
                assert!(properties.contains_key(key.as_str().unwrap()), "{key} in {table}");
            }
        });
    }
    assert!(n_properties > 150, "{n_properties}");
}

fn walk(value: &Value, see: &mut impl FnMut(&Value)) {
    see(value);
    match value {
        Value::Array(items) => items.iter().for_each(|item| walk(item, see)),
        Value::Object(entries) => entries.values().for_each(|item| walk(item, see)),
        _ => {}
    }
}
