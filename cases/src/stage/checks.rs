//! Reads unit checks: `stages/NN_name/checks/FILE.toml`.

use std::collections::{BTreeMap, HashSet};
use std::path::Path;

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::Check;
use super::allows::limit;
use super::ask;
use super::folder::stem;
use super::named::Named;
use crate::course::{Condition, Course};
use crate::effects::Effects;
use crate::probe::Answer;
use crate::problem::{Problems, Source};
use crate::scene::raw::numbers::{Depth, NonNegative, Rule, Side};
use crate::scene::raw::read::{At, Each, Maybe, Notes, Table, Value, table};
use crate::scene::raw::{
    RawCamera, RawLight, RawMaterial, RawRender, RawScene, numbers::Colour, objects::RawObject,
};
use crate::scene::{self, Material, Scene, resolve};

table! {
    /// A scene of a file of unit checks: as in a case, but camera and `render` may be left out.
    "a scene of a check" RawCheckScene {
        /// Settings that a question may depend on.
        render: RawCheckRender = "{}",
        /// The camera; most questions do not depend on it.
        camera: Maybe<RawCamera> = "{ eye = [0, 0, 10], look_at = [0, 0, 0], up = [0, 1, 0], \
            fov_y_deg = 45 }",
        /// Colour of a ray that hits nothing.
        background: Colour = "[0, 0, 0]",
        /// The sources of light.
        lights: Each<RawLight> = "[]",
        /// Materials by name; those of the file's `[materials]` need not be given again.
        materials: BTreeMap<String, Maybe<RawMaterial>> = "{}",
        /// The objects.
        objects: Each<At<RawObject>> = "[]",
    }
}

table! {
    /// Settings of a scene of a check.
    "the `render` of a check's scene" RawCheckRender {
        /// Width and height in pixels.
        size: At<[Side; 2]> = "[1, 1]",
        /// Depth at which a ray spawns no further rays. [rule 13]
        max_depth: Depth = "0",
        /// Weight below which a path ends; 0 switches this off. [rule 13]
        threshold: NonNegative = "0",
    }
}

/// Returns the checks of the file at `path` under `course`. Their scenes request every effect that
/// the stage allows, or that the programs of the course always simulate.
pub(super) fn load(
    path: &Path,
    stage: &str,
    allows: Effects,
    course: &Course,
) -> Result<Vec<Check>, Problems> {
    let (name, text) = (path.display().to_string(), scene::read(path)?);
    let source = Source::new(name, text);
    let (root, mut notes) = scene::root(&source);
    let checks = root.and_then(|root| {
        let table = Table::open(
            "a file of unit checks",
            &["scenes", "materials", "check"],
            &root,
            &mut notes,
        )?;
        let base = path.parent().unwrap_or(Path::new(""));
        let named = named(&table, base, allows, course, &mut notes);
        let Some(items) = table.entry("check") else {
            notes
                .add(0..0, "missing key `check`", "")
                .help("unit checks are written as `[[check]]`");
            return None;
        };
        let Some(items) = items.get_ref().as_array() else {
            notes.wrong(items, "a list of checks, written as `[[check]]`");
            return None;
        };
        let mut names = HashSet::new();
        let prefix = format!("{stage}/{}", stem(path));
        let read = |item| check(item, &prefix, &named, course, &mut names, &mut notes);
        // All checks are read before the first failure counts, so that all problems are noted.
        let checks: Vec<Option<Check>> = items.iter().map(read).collect();
        checks.into_iter().collect()
    });
    notes.finish(checks)
}

fn named(
    table: &Table<'_>,
    base: &Path,
    allows: Effects,
    course: &Course,
    notes: &mut Notes,
) -> Named {
    type Raw<T> = Option<BTreeMap<String, Maybe<T>>>;
    let scenes = table.field::<Raw<RawCheckScene>>("scenes", notes).flatten().unwrap_or_default();
    let materials =
        table.field::<Raw<RawMaterial>>("materials", notes).flatten().unwrap_or_default();
    let resolved: BTreeMap<String, Option<Material>> = materials
        .iter()
        .map(|(name, raw)| (name.clone(), resolve::material(name, raw, notes)))
        .collect();
    let scenes = scenes
        .into_iter()
        .map(|(name, raw)| {
            (name, raw.0.and_then(|raw| check_scene(raw, &materials, base, allows, course, notes)))
        })
        .collect();
    Named { scenes, materials: resolved }
}

fn check_scene(
    raw: RawCheckScene,
    materials: &BTreeMap<String, Maybe<RawMaterial>>,
    base: &Path,
    allows: Effects,
    course: &Course,
    notes: &mut Notes,
) -> Option<Scene> {
    let RawCheckRender { size, max_depth, threshold } = raw.render;
    let render = resolve::render(&RawRender { size, max_depth, threshold }, notes);
    let mut all = raw.materials;
    for (name, material) in materials {
        all.entry(name.clone()).or_insert_with(|| material.clone());
    }
    let raw = RawScene {
        camera: raw.camera,
        background: raw.background,
        lights: raw.lights,
        materials: all,
        objects: raw.objects,
    };
    let mut scene = resolve::scene(&raw, render, base, course, notes)?;
    limit(&mut scene, allows, course, notes);
    scene.effects = allows.union(course.always_simulated);
    Some(scene)
}

fn check(
    item: &Value<'_>,
    prefix: &str,
    named: &Named,
    course: &Course,
    names: &mut HashSet<String>,
    notes: &mut Notes,
) -> Option<Check> {
    let table =
        Table::open("a check", &["name", "about", "rules", "ask", "paper", "under"], item, notes)?;
    let name = table.field::<At<String>>("name", notes).and_then(|name| own(name, names, notes));
    let about = table.field::<String>("about", notes);
    let rules = table.field::<Vec<Rule>>("rules", notes);
    let ask = match table.entry("ask") {
        Some(value) => ask::read(value, named, notes),
        None => table.field::<Maybe<String>>("ask", notes).and(None),
    };
    let paper = paper(&table, course, notes);
    Some(Check {
        id: format!("{prefix}/{}", name?),
        about: about?,
        rules: rules?.into_iter().map(|rule| rule.0).collect(),
        ask: ask?,
        paper: paper?,
    })
}

/// Returns the name. One that is not made of letters, digits, `_` and `-`, or that another check of
/// the file has, is noted.
fn own(name: At<String>, names: &mut HashSet<String>, notes: &mut Notes) -> Option<String> {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '-');
    if name.is_empty() || !name.chars().all(is_plain) {
        notes.add(
            name.span,
            "this name cannot be part of an id",
            "letters, digits, `_` and `-` can",
        );
        return None;
    }
    if !names.insert(name.value.clone()) {
        notes.add(
            name.span,
            format!("two checks are called `{}`", name.value),
            "this name is taken",
        );
        return None;
    }
    Some(name.value)
}

/// Returns the answer on paper, if there is one and `under` does not restrict it to other courses.
/// The outer `None` means that a problem was noted.
fn paper(table: &Table<'_>, course: &Course, notes: &mut Notes) -> Option<Option<Answer>> {
    let under = table.field::<Option<At<Condition>>>("under", notes)?;
    let paper = table.entry("paper").map(|value| answer(value, notes));
    if let (Some(under), None) = (&under, &paper) {
        let label = "`under` says in which courses the `paper` answer holds";
        notes.add(under.span.clone(), "there is no answer on paper", label);
    }
    let holds = under.is_none_or(|under| under.holds(course));
    match paper {
        Some(answer) => answer.map(|answer| holds.then_some(answer)),
        None => Some(None),
    }
}

/// Reads an answer in the form of the protocol.
fn answer(value: &Value<'_>, notes: &mut Notes) -> Option<Answer> {
    let form = json(value.get_ref());
    let answer = serde_json::from_value::<Answer>(form.clone()).map_err(|why| why.to_string());
    // Keys that mean nothing are ignored when an answer is read. They are missing when it is
    // written again.
    let whole = answer.and_then(|answer| match (&answer, serde_json::to_value(&answer)) {
        (Answer::Todo(_) | Answer::Panic(_), _) => Err("this is no right answer".to_owned()),
        (_, Ok(again)) if alike(&again, &form) => Ok(answer),
        _ => Err("it has keys that mean nothing here".to_owned()),
    });
    whole
        .map_err(|why| {
            notes.add(value.span(), "this is no answer in the form of the protocol", why)
        })
        .ok()
}

/// Returns whether two values are equal, where 1 and 1.0 are the same number.
fn alike(a: &Json, b: &Json) -> bool {
    match (a, b) {
        (Json::Number(a), Json::Number(b)) => a.as_f64() == b.as_f64(),
        (Json::Array(a), Json::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Json::Object(a), Json::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| alike(a, b)))
        }
        _ => a == b,
    }
}

/// Returns the JSON form of a TOML value. A date, or a number that cannot be read, becomes null.
fn json(value: &DeValue<'_>) -> Json {
    match value {
        DeValue::String(text) => text.as_ref().into(),
        DeValue::Boolean(flag) => (*flag).into(),
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).map_or(Json::Null, |n| n.into())
        }
        DeValue::Float(float) => match float.as_str() {
            "inf" | "+inf" => "inf".into(),
            "-inf" => "-inf".into(),
            text => text.parse::<f64>().map_or(Json::Null, Into::into),
        },
        DeValue::Datetime(_) => Json::Null,
        DeValue::Array(items) => items.iter().map(|item| json(item.get_ref())).collect(),
        DeValue::Table(entries) => entries
            .iter()
            .map(|(key, item)| (key.get_ref().to_string(), json(Spanned::get_ref(item))))
            .collect(),
    }
}
