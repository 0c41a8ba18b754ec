//! Checks that the stored JSON Schema of a record is the one of the types, and that every stored
//! record conforms to it.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// Returns the root of the repository.
fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn stored() -> PathBuf {
    repository().join("docs/grade-record.schema.json")
}

#[test]
fn the_document_is_current() {
    let schema = format!("{:#}\n", grader::record::schema());
    if std::env::var_os("BLESS").is_some() {
        fs::write(stored(), &schema).unwrap();
    }
    let document = fs::read_to_string(stored()).unwrap_or_default();
    assert!(
        document == schema,
        "docs/grade-record.schema.json is not what `grader schema` prints: set BLESS=1"
    );
}

#[test]
fn every_stored_record_has_the_form() {
    let schema = grader::record::schema();
    let mut n_records = 0;
    for entry in fs::read_dir(repository().join("tests/submissions")).unwrap() {
        let path = entry.unwrap().path().join("record.json");
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let record: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(check(&record, &schema, &schema, "record"), Ok(()), "{}", path.display());
        n_records += 1;
    }
    assert!(n_records > 40, "{n_records} records");
}

#[test]
fn what_is_no_record_does_not_have_the_form() {
    let schema = grader::record::schema();
    let path = repository().join("tests/submissions/answers_nan/record.json");
    let right: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    assert!(right["interrupted"].is_boolean());
    let without = {
        let mut record = right.clone();
        record.as_object_mut().unwrap().remove("interrupted");
        record
    };
    assert!(
        check(&without, &schema, &schema, "record").unwrap_err().contains("record: no interrupted")
    );
    let table = [
        ("/schema", json!(2), "record.schema"),
        ("/stages/0/earned", json!(-1), "record.stages[0].earned"),
        ("/stages/0/checks/0/verdict", json!("perfect"), "record.stages[0].checks[0].verdict"),
        ("/stages/0/checks/0/rules", json!([256]), "record.stages[0].checks[0].rules[0]"),
        ("/build/finding", json!(7), "record.build.finding"),
    ];
    for (place, value, part) in table {
        let mut record = right.clone();
        *record.pointer_mut(place).unwrap() = value;
        assert_ne!(record, right, "nothing was changed");
        let said = check(&record, &schema, &schema, "record").unwrap_err();
        assert!(said.contains(part), "{said}");
    }
}

/// Checks that `value` conforms to `schema`; `Err` says where it does not. A keyword that our
/// schemas do not use is a panic, so that none is ignored.
fn check(value: &Value, schema: &Value, root: &Value, place: &str) -> Result<(), String> {
    let Some(words) = schema.as_object() else { return Ok(()) };
    let wrong = |word: &str| Err(format!("{place}: against {word} of {schema}: {value}"));
    let number = |word: &str| schema[word].as_f64().unwrap_or_else(|| panic!("{word} of {schema}"));
    for (word, about) in words {
        let holds = match word.as_str() {
            "$schema" | "$id" | "$defs" | "title" | "description" | "default" | "format" => true,
            "$ref" => {
                let path = about
                    .as_str()
                    .and_then(|path| path.strip_prefix('#'))
                    .expect("a place in the document");
                check(value, root.pointer(path).expect("a definition"), root, place)?;
                true
            }
            "type" => match about {
                Value::Array(kinds) => kinds.iter().any(|kind| is_a(value, kind)),
                kind => is_a(value, kind),
            },
            "const" => value == about,
            "enum" => about.as_array().expect("a list").contains(value),
            "anyOf" | "oneOf" => about
                .as_array()
                .expect("a list")
                .iter()
                .any(|one| check(value, one, root, place).is_ok()),
            "minimum" => value.as_f64().is_none_or(|x| x >= number(word)),
            "maximum" => value.as_f64().is_none_or(|x| x <= number(word)),
            "minItems" => value.as_array().is_none_or(|items| items.len() as f64 >= number(word)),
            "maxItems" => value.as_array().is_none_or(|items| items.len() as f64 <= number(word)),
            "items" => {
                for (n, item) in value.as_array().into_iter().flatten().enumerate() {
                    check(item, about, root, &format!("{place}[{n}]"))?;
                }
                true
            }
            "required" => {
                let keys = about.as_array().expect("a list").iter().filter_map(Value::as_str);
                for key in keys {
                    if value.get(key).is_none() {
                        return Err(format!("{place}: no {key}"));
                    }
                }
                true
            }
            "properties" => {
                for (key, form) in about.as_object().expect("a table") {
                    if let Some(part) = value.get(key) {
                        check(part, form, root, &format!("{place}.{key}"))?;
                    }
                }
                true
            }
            other => panic!("the schema says {other}, which nobody checks"),
        };
        if !holds {
            return wrong(word);
        }
    }
    Ok(())
}

fn is_a(value: &Value, kind: &Value) -> bool {
    match kind.as_str().expect("the name of a kind") {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("nobody checks {other}"),
    }
}
