//! Tests that a slip in any single value of a case or of a file of unit checks is reported with its
//! place. The rest of the file is read as well.

use std::fs;
use std::path::{Path, PathBuf};

use cases::problem::Problems;
use cases::stage::{self, Stage};
use cases::{Course, Effects};
use toml::Value;

/// Returns what people write by mistake: another type, a list of another length, a number out of
/// range, nothing.
fn slips() -> Vec<Value> {
    let list = |items: &[f64]| Value::Array(items.iter().map(|item| Value::Float(*item)).collect());
    vec![
        Value::Float(0.85),
        Value::Float(-1e300),
        Value::Integer(-3),
        Value::String("brik".to_owned()),
        Value::Boolean(true),
        list(&[]),
        list(&[0.85, 0.7]),
        list(&[0.1, 0.2, 0.3, 0.4]),
        Value::Table(toml::Table::new()),
    ]
}

/// Returns the places of all values in `value`, each as the keys and indices that lead to it.
fn places(value: &Value) -> Vec<Vec<String>> {
    let inner: Vec<(String, &Value)> = match value {
        Value::Table(table) => table.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(items) => {
            items.iter().enumerate().map(|(n, value)| (n.to_string(), value)).collect()
        }
        _ => vec![],
    };
    let mut all = vec![];
    for (step, value) in inner {
        all.push(vec![step.clone()]);
        all.extend(places(value).into_iter().map(|behind| [vec![step.clone()], behind].concat()));
    }
    all
}

/// Returns the value at `place`.
fn at<'a>(value: &'a mut Value, place: &[String]) -> &'a mut Value {
    place.iter().fold(value, |value, step| match value {
        Value::Array(items) => &mut items[step.parse::<usize>().unwrap()],
        other => &mut other[step.as_str()],
    })
}

/// Replaces every value of the file at `path` by every slip in turn. Returns how many were refused.
fn check<T>(path: &Path, read: impl Fn(&str) -> Result<T, Problems>) -> usize {
    let text = fs::read_to_string(path).unwrap();
    let right: Value = Value::Table(text.parse().unwrap());
    let document = |value: &Value| value.as_table().unwrap().to_string();
    read(&document(&right)).map(drop).unwrap_or_else(|problems| panic!("{problems}"));
    let mut n_refused = 0;
    for place in places(&right) {
        for slip in slips() {
            let mut wrong = right.clone();
            *at(&mut wrong, &place) = slip.clone();
            let Err(problems) = read(&document(&wrong)) else { continue };
            n_refused += 1;
            let said = problems.to_string();
            assert!(
                problems.iter().all(|problem| !problem.message.is_empty()),
                "{place:?} = {slip}: {said}"
            );
            assert!(
                problems.iter().any(|problem| problem.span.is_some()),
                "{place:?} = {slip} has no place: {said}"
            );
        }
    }
    n_refused
}

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(path)
}

#[test]
fn in_a_case() {
    let path = here("stages/01_first/mirror.toml");
    let (allows, course) = (Effects::ALL, Course::default());
    let n = check(&path, |text| stage::parse_case(&path, text, "01_first", allows, &course));
    assert!(n > 300, "{n}");
}

#[test]
fn in_a_file_of_unit_checks() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("01_first");
    fs::create_dir_all(target.join("checks")).unwrap();
    fs::copy(here("stages/01_first/stage.toml"), target.join("stage.toml")).unwrap();
    let read = |text: &str| -> Result<Vec<Stage>, Problems> {
        fs::write(target.join("checks/every_function.toml"), text).unwrap();
        stage::load_all(folder.path(), &Course::default())
    };
    let n = check(&here("stages/01_first/checks/every_function.toml"), read);
    assert!(n > 300, "{n}");
}
