//! Every report of every readable record: no report panics, breaks its document, or gives a command
//! to a log.
//!
//! The records are drawn from the JSON Schema of a record, so that no field is forgotten.

use proptest::prelude::*;
use proptest::sample::select;
use serde_json::{Map, Value, json};

use super::class::{self, Entry};
use super::{gradebook, gradescope, html, junit, prairielearn, sample, terminal};
use crate::collect::roll::{Decision, Member, Roll};
use crate::graded::Graded;
use crate::plain::is_hidden;
use crate::record::{self, Record};

/// The nesting depth of a question, which may be any JSON.
const DEPTH: u32 = 3;

/// Returns text made of the pieces that attacks use, or any text.
fn text() -> BoxedStrategy<Value> {
    let commands = [
        "::error::x",
        "\n::stop-commands::x",
        "##[error]",
        "#",
        "##vso[task.x]",
        "\r::x::",
        "\u{200b}",
    ];
    let markup = [
        "]]>",
        "<script>",
        "&",
        "\"",
        "'",
        "{{ 7*7 }}",
        "--",
        "=1+1",
        "\u{1b}[31m",
        "\u{fffe}",
        "\u{0}",
        "\u{1ffff}",
    ];
    let words = [
        "sphere",
        "01_ray_casting/sphere",
        "still to be written: ",
        "\n",
        " ",
        "\t",
        "e\u{301}",
        "one",
    ];
    let pieces: Vec<&str> = commands.into_iter().chain(markup).chain(words).collect();
    let attack = proptest::collection::vec(select(pieces), 0..6).prop_map(|parts| parts.concat());
    prop_oneof![attack, any::<String>()].prop_map(Value::from).boxed()
}

/// Returns any JSON, often a question to a function.
fn anything() -> BoxedStrategy<Value> {
    let leaf =
        prop_oneof![Just(Value::Null), any::<bool>().prop_map(Value::from), text(), number()];
    let nested = leaf.prop_recursive(DEPTH, 12, 3, |inner| {
        let list = proptest::collection::vec(inner.clone(), 0..3).prop_map(Value::Array);
        let keys = proptest::collection::vec((text(), inner), 0..3);
        let table = keys.prop_map(|pairs| {
            pairs.into_iter().map(|(key, value)| (key.as_str().unwrap_or("").to_owned(), value))
        });
        prop_oneof![list, table.prop_map(|pairs| Value::Object(pairs.collect()))]
    });
    prop_oneof![nested, text().prop_map(|name| json!({ "fn": name }))].boxed()
}

fn number() -> BoxedStrategy<Value> {
    let odd = select(vec![
        0.0,
        -0.0,
        1e300,
        -1e300,
        f64::MAX,
        f64::MIN,
        5e-324,
        -1.0,
        1.5,
        1e19,
        1.8446744073709552e19,
    ]);
    let finite = any::<f64>().prop_map(|x| if x.is_finite() { x } else { 0.0 });
    prop_oneof![odd, finite].prop_map(Value::from).boxed()
}

fn whole(schema: &Value) -> BoxedStrategy<Value> {
    let most = schema["maximum"].as_u64().unwrap_or(match schema["format"].as_str() {
        Some("uint8") => u64::from(u8::MAX),
        Some("uint32") => u64::from(u32::MAX),
        _ => u64::MAX,
    });
    prop_oneof![Just(0), Just(most), 0..=most, 0..=most.min(3000)].prop_map(Value::from).boxed()
}

/// Returns values of `schema`. Its references lead into `root`.
fn of(schema: &Value, root: &Value) -> BoxedStrategy<Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
        return of(&root["$defs"][name], root);
    }
    if let Some(only) = schema.get("const") {
        return Just(only.clone()).boxed();
    }
    if let Some(words) = schema["enum"].as_array() {
        return select(words.clone()).boxed();
    }
    if let Some(choices) = schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        let all: Vec<_> = choices.iter().map(|choice| of(choice, root)).collect();
        return proptest::strategy::Union::new(all).boxed();
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => return anything(),
    };
    proptest::strategy::Union::new(kinds.into_iter().map(|kind| of_kind(kind, schema, root)))
        .boxed()
}

fn of_kind(kind: &str, schema: &Value, root: &Value) -> BoxedStrategy<Value> {
    match kind {
        "null" => Just(Value::Null).boxed(),
        "boolean" => any::<bool>().prop_map(Value::from).boxed(),
        "string" => text(),
        "number" => number(),
        "integer" => whole(schema),
        "array" => {
            let size = |key: &str, default: u64| schema[key].as_u64().unwrap_or(default) as usize;
            let sizes = size("minItems", 0)..=size("maxItems", 3);
            proptest::collection::vec(of(&schema["items"], root), sizes)
                .prop_map(Value::Array)
                .boxed()
        }
        "object" => object(schema, root),
        other => panic!("the record has a part of the kind {other}, which this test does not draw"),
    }
}

fn object(schema: &Value, root: &Value) -> BoxedStrategy<Value> {
    let is_needed = |name: &str| {
        schema["required"].as_array().is_some_and(|keys| keys.iter().any(|key| key == name))
    };
    let part = |(name, part): (&String, &Value)| {
        let value = of(part, root);
        let value = if is_needed(name) {
            value.prop_map(Some).boxed()
        } else {
            proptest::option::of(value).boxed()
        };
        (Just(name.clone()), value)
    };
    let parts: Vec<_> = schema["properties"]
        .as_object()
        .expect("an object has properties")
        .iter()
        .map(part)
        .collect();
    let object = |parts: Vec<(String, Option<Value>)>| {
        Value::Object(
            parts
                .into_iter()
                .filter_map(|(name, value)| Some((name, value?)))
                .collect::<Map<_, _>>(),
        )
    };
    parts.prop_map(object).boxed()
}

fn records() -> BoxedStrategy<Value> {
    let schema = record::schema();
    of(&schema, &schema)
}

/// Returns whether a reader of logs obeys a line of `text`.
fn is_obeyed(text: &str) -> bool {
    text.split(['\n', '\r']).any(|line| {
        line.trim_start().starts_with("::") || line.contains("##[") || line.contains("##vso[")
    })
}

fn is_harmless(text: &str) -> bool {
    !is_obeyed(text) && text.chars().all(|c| !is_hidden(c) || matches!(c, '\n' | '\t'))
}

/// Returns the texts of an XML document, and the number of its test cases.
fn read_xml(xml: &str) -> Result<(String, usize), quick_xml::Error> {
    use quick_xml::events::Event;
    let mut reader = quick_xml::Reader::from_str(xml);
    reader.config_mut().check_end_names = true;
    let (mut text, mut n_cases) = (String::new(), 0);
    loop {
        match reader.read_event()? {
            Event::Eof => return Ok((text, n_cases)),
            Event::Start(tag) | Event::Empty(tag) => {
                n_cases += usize::from(tag.name().as_ref() == b"testcase");
                for attribute in tag.attributes() {
                    text += &attribute?.normalized_value(quick_xml::XmlVersion::Explicit1_0)?;
                    text.push('\n');
                }
            }
            Event::Text(part) => text += &part.decode()?,
            Event::GeneralRef(part) => {
                text += &quick_xml::escape::unescape(&format!("&{};", part.decode()?))?;
            }
            _ => {}
        }
    }
}

/// Returns a roll with `text` wherever a student or an export can put text.
fn hostile_roll(text: &str) -> Roll {
    let student = || Member {
        id: text.to_owned(),
        name: text.to_owned(),
        email: text.to_owned(),
        section: text.to_owned(),
        group: text.to_owned(),
        ..Member::default()
    };
    let graded = Member { submission: Some("a".to_owned()), ..student() };
    let texts = || vec![text.to_owned()];
    let decision = Decision { hand_ins: texts(), students: texts(), why: text.to_owned() };
    Roll { members: vec![student(), graded], decisions: vec![decision], ..Roll::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn every_record_is_reported_without_harm(
        value in records(), name in text(), is_verbose: bool, columns in 40..200usize,
    ) {
        let record: Record = serde_json::from_value(value.clone()).expect("the schema describes \
            what is read");
        let again: Record = serde_json::from_str(&record.to_json()).expect("what is written can \
            be read");
        prop_assert_eq!(&again, &record);
        prop_assert!(!is_obeyed(&record.to_json()));

        let shown = terminal::render(&record, terminal::Look { is_verbose, columns });
        let plain = anstream::adapter::strip_str(&shown).to_string();
        prop_assert!(is_harmless(&plain), "{plain}");

        let xml = junit::to_string(&record).expect("a document");
        let (texts, n_cases) = read_xml(&xml).expect("well-formed XML");
        prop_assert!(is_harmless(&texts) && is_harmless(&xml), "{xml}");
        let n_checks = record.stages.iter().map(|stage| stage.checks.len()).sum::<usize>();
        prop_assert_eq!(n_cases, n_checks + 1);

        let pictures = sample::graded("x").pictures;
        let page = html::render(&Graded { record: record.clone(), pictures });
        prop_assert_eq!(page.matches("<script").count(), 1);
        prop_assert!(is_harmless(&page));

        for text in [gradescope::to_string(&record), prairielearn::to_string(&record)] {
            prop_assert!(is_harmless(&text), "{text}");
            prop_assert!(serde_json::from_str::<Value>(&text).is_ok(), "{text}");
        }

        let name = name.as_str().unwrap_or_default().to_owned();
        let roll = hostile_roll(&name);
        let entries = [
            Entry { id: "a".to_owned(), name: name.clone(), record: Some(record) },
            Entry { id: name.clone(), name, record: None },
        ];
        for (roll, n_rows) in [(None, 2), (Some(&roll), 3)] {
            let (table, page) = (class::csv(&entries, roll), class::page(&entries, &[], roll));
            prop_assert_eq!(page.matches("<script").count(), 1);
            prop_assert!(is_harmless(&table) && is_harmless(&page), "{table}");
            let mut rows = csv::Reader::from_reader(table.as_bytes());
            prop_assert_eq!(rows.records().filter_map(Result::ok).count(), n_rows);
        }
        prop_assert!(is_harmless(&class::decisions_csv(&roll)));
        prop_assert!(is_harmless(&gradebook::plain(&roll)));
    }
}

#[test]
fn the_checks_find_what_they_look_for() {
    for text in ["::x::", "a\n  ::x::", "a ##[x]", "a\r::x::", "\u{202e}"] {
        assert!(!is_harmless(text), "{text:?}");
    }
    assert!(read_xml("<a><b></a>").is_err() && read_xml("<a b=\"1\" b=\"2\"/>").is_err());
}
