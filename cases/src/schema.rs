//! The formats of files and messages, generated from the types that read them. There is JSON Schema
//! (draft 07, which editors understand), and the reference of the scene format for people.

use std::fmt::Write;

use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, json_schema};
use serde_json::{Map, Value, json};

use crate::course::RawCourse;
use crate::probe::{Question, Reply};
use crate::scene::Scene;
use crate::scene::raw::RawSceneFile;
use crate::stage::ask;
use crate::stage::raw::{RawCase, RawStage};

/// Returns the JSON Schema of a case file.
pub fn case_schema() -> Value {
    written::<RawCase>("A case of the ray-tracing assignment")
}

/// Returns the JSON Schema of a scene file outside any stage.
pub fn scene_file_schema() -> Value {
    written::<RawSceneFile>("A scene file")
}

/// Returns the JSON Schema of a `stage.toml`.
pub fn stage_schema() -> Value {
    written::<RawStage>("A stage of the ray-tracing assignment")
}

/// Returns the JSON Schema of a `course.toml`.
pub fn course_schema() -> Value {
    written::<RawCourse>("The choices of a course where courses differ")
}

/// Returns the JSON Schema of the resolved scene, `SCENE.json`.
pub fn scene_schema() -> Value {
    titled(
        SchemaSettings::draft07().into_generator().into_root_schema_for::<Scene>(),
        "A resolved scene",
    )
}

/// Returns the JSON Schema of a line of the probe protocol: a question (`definitions/Question`) or
/// a reply (`definitions/Reply`).
pub fn probe_schema() -> Value {
    let mut generator = SchemaSettings::draft07().into_generator();
    let lines = [generator.subschema_for::<Question>(), generator.subschema_for::<Reply>()];
    let mut schema =
        json_schema!({ "$schema": "http://json-schema.org/draft-07/schema#", "anyOf": lines });
    schema.insert("definitions".to_owned(), Value::Object(generator.take_definitions(true)));
    titled(schema, "A line of the probe protocol")
}

/// Returns the schema of a file that people write: no key is ever null, and a key with a default is
/// not required.
fn written<T: JsonSchema>(title: &str) -> Value {
    let settings = SchemaSettings::draft07()
        .with_transform(RecursiveTransform(without_null))
        .with_transform(Defaulted);
    titled(settings.into_generator().into_root_schema_for::<T>(), title)
}

fn titled(mut schema: Schema, title: &str) -> Value {
    schema.insert("title".to_owned(), title.into());
    schema.to_value()
}

/// Removes null from a schema. An optional key is left out, because TOML has no null.
fn without_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [one] = types.as_slice() {
            let one = one.clone();
            schema.insert("type".to_owned(), one);
        }
    }
    if let Some(Value::Array(any)) = schema.get_mut("anyOf") {
        any.retain(|one| one != &json!({ "type": "null" }));
        if let [one] = any.as_slice() {
            let one = one.clone();
            schema.remove("anyOf");
            schema.insert("allOf".to_owned(), json!([one]));
        }
    }
}

/// A transform that makes keys with a default optional.
#[derive(Clone)]
struct Defaulted;

impl Transform for Defaulted {
    fn transform(&mut self, schema: &mut Schema) {
        let has_default = |key: &Value, all: &Map<String, Value>| {
            key.as_str()
                .and_then(|key| all.get(key))
                .is_some_and(|property| property.get("default").is_some())
        };
        if let Some(all) = schema.get("properties").and_then(Value::as_object).cloned()
            && let Some(Value::Array(required)) = schema.get_mut("required")
        {
            required.retain(|key| !has_default(key, &all));
        }
        transform_subschemas(self, schema);
    }
}

/// Returns `docs/scene-format.md`: every table of a case file with its keys, from the same types.
pub fn scene_format_markdown() -> String {
    let mut text = include_str!("schema/scene-format.head.md").to_owned();
    let case = case_schema();
    let free = scene_file_schema();
    let _ = writeln!(text, "\n## Every table and key\n");
    table(&mut text, "A case", &case);
    table(&mut text, "A scene file", &free);
    for (name, heading) in HEADINGS {
        table(&mut text, heading, &case["definitions"][name]);
    }
    text += include_str!("schema/scene-format.checks.md");
    for (function, keys) in ask::FUNCTIONS {
        let mut said: Vec<String> =
            keys.iter().map(|(key, takes)| format!("`{key}`: {takes}")).collect();
        said.dedup();
        let _ = writeln!(text, "| `{function}` | {} |", said.join("; "));
    }
    let _ = writeln!(text, "\n## Stages: `stage.toml`\n");
    table(&mut text, "A stage", &stage_schema());
    text.trim_end().to_owned() + "\n"
}

/// Headings of the types for people, in the order in which they are read.
const HEADINGS: &[(&str, &str)] = &[
    ("RawRender", "`[render]`"),
    ("RawVary", "`[vary]`"),
    ("RawScene", "`[scene]`"),
    ("RawCamera", "`[scene.camera]`"),
    ("RawLight", "A light, `[[scene.lights]]`"),
    ("RawPointLight", "`point`"),
    ("RawAttenuation", "`attenuation`"),
    ("RawDirectionalLight", "`directional`"),
    ("RawMaterial", "A material, `[scene.materials]`"),
    ("RawObject", "An object, `[[scene.objects]]`"),
    ("RawSphere", "`sphere`"),
    ("RawSquare", "`square`"),
    ("RawBox", "`box`"),
    ("RawPlane", "`plane`"),
    ("RawCylinder", "`cylinder`"),
    ("RawCone", "`cone`"),
    ("RawMesh", "`mesh`"),
    ("RawMeshInline", "`mesh`, inline"),
    ("RawMeshFile", "`mesh` from a file"),
    ("RawTransform", "A transform"),
    ("RawRotation", "`rotate`"),
    ("RawShear", "`shear`"),
];

fn heading(name: &str) -> &str {
    HEADINGS.iter().find(|(known, _)| *known == name).map_or(name, |(_, heading)| heading)
}

fn table(text: &mut String, heading: &str, schema: &Value) {
    let _ = writeln!(text, "### {heading}\n");
    if let Some(said) = schema["description"].as_str() {
        let _ = writeln!(text, "{}\n", one_line(said));
    }
    let rows: Vec<String> = match (schema["properties"].as_object(), schema["oneOf"].as_array()) {
        (Some(keys), _) => keys
            .iter()
            .map(|(key, property)| row(key, property, default(key, property, schema)))
            .collect(),
        (None, Some(choices)) => choices.iter().flat_map(choice).collect(),
        _ => vec![],
    };
    if !rows.is_empty() {
        let _ = writeln!(
            text,
            "| key | takes | if left out | |\n|---|---|---|---|\n{}\n",
            rows.join("\n")
        );
    }
}

/// Returns the row of the one key of a choice.
fn choice(choice: &Value) -> Option<String> {
    let (key, property) = choice["properties"].as_object()?.iter().next()?;
    let mut property = property.clone();
    property["description"] = choice["description"].clone();
    Some(row(key, &property, "one of these is needed".to_owned()))
}

fn row(key: &str, property: &Value, default: String) -> String {
    let said = one_line(property["description"].as_str().unwrap_or_default());
    format!("| `{key}` | {} | {default} | {said} |", takes(property).replace('|', "\\|"))
}

fn default(key: &str, property: &Value, schema: &Value) -> String {
    let is_required =
        schema["required"].as_array().is_some_and(|keys| keys.iter().any(|name| name == key));
    match (&property["default"], is_required) {
        (Value::Null, true) => "needed".to_owned(),
        (Value::Null, false) => "–".to_owned(),
        (default, _) => format!("`{}`", toml(default)),
    }
}

/// Returns a default as it is written in a file.
fn toml(value: &Value) -> String {
    match value {
        Value::Array(items) => {
            format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", "))
        }
        Value::Object(entries) if entries.is_empty() => "{}".to_owned(),
        Value::Object(entries) => {
            let entries: Vec<String> =
                entries.iter().map(|(key, value)| format!("{key} = {}", toml(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        other => other.to_string(),
    }
}

/// Describes the values of a key in words.
fn takes(schema: &Value) -> String {
    if let Some(name) = schema["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
        return heading(name).to_owned();
    }
    for several in ["allOf", "anyOf"] {
        if let Some(all) = schema[several].as_array() {
            return all.iter().map(takes).collect::<Vec<_>>().join(" or ");
        }
    }
    match schema["type"].as_str() {
        Some("number" | "integer") => number(schema),
        Some("boolean") => "`true` or `false`".to_owned(),
        Some("string") => "a text".to_owned(),
        Some("array") => match (schema["minItems"].as_u64(), schema["items"].as_object()) {
            (Some(n), Some(_)) => format!("{n} × {}", takes(&schema["items"])),
            _ => format!("a list of: {}", takes(&schema["items"])),
        },
        Some("object") => match schema["additionalProperties"].as_object() {
            Some(_) => format!("names, each with: {}", takes(&schema["additionalProperties"])),
            None => "a table".to_owned(),
        },
        _ => match schema["enum"].as_array() {
            Some(words) => {
                words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
            }
            None => "a table".to_owned(),
        },
    }
}

fn number(schema: &Value) -> String {
    let kind = if schema["type"] == "integer" { "a whole number" } else { "a number" };
    let bound = |key: &str, word: &str| schema[key].as_f64().map(|bound| format!("{word} {bound}"));
    let bounds: Vec<String> = [
        bound("minimum", "at least"),
        bound("exclusiveMinimum", "above"),
        bound("maximum", "at most"),
        bound("exclusiveMaximum", "below"),
        schema["not"]["const"].as_f64().map(|bound| format!("not {bound}")),
    ]
    .into_iter()
    .flatten()
    .collect();
    if bounds.is_empty() { kind.to_owned() } else { format!("{kind}, {}", bounds.join(", ")) }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_has_a_heading() {
        let case = case_schema();
        let mut defined: Vec<&str> =
            case["definitions"].as_object().unwrap().keys().map(String::as_str).collect();
        let mut headed: Vec<&str> = HEADINGS.iter().map(|(name, _)| *name).collect();
        defined.sort_unstable();
        headed.sort_unstable();
        assert_eq!(defined, headed);
    }

    #[test]
    fn optional_keys_are_neither_null_nor_required() {
        for schema in [case_schema(), scene_file_schema(), stage_schema()] {
            assert!(!schema.to_string().contains("null"), "{schema}");
        }
        let case = case_schema();
        let sphere = &case["definitions"]["RawSphere"];
        assert!(sphere["required"].as_array().is_none_or(Vec::is_empty), "{sphere}");
        assert_eq!(sphere["additionalProperties"], false);
        assert_eq!(case["definitions"]["RawCamera"]["required"].as_array().unwrap().len(), 4);
    }
}
