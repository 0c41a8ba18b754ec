//! Tests that the template is the solution without its function bodies, and that `template.toml`
//! says whether a file is given or the student's.
//!
//! The grader carries the template in `grader/given`, which no student edits. After a change there,
//! `BLESS=1 cargo test -p tests --test template` copies it to the template, and its given files to
//! the solution.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use grader::functions::{FUNCTIONS, Function};
use grader::submission::{Language, Template};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    pristine: Vec<String>,
    student: Vec<String>,
    stages: BTreeMap<String, Vec<String>>,
}

fn root(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn text(path: &str) -> String {
    fs::read_to_string(root(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

fn manifest() -> Manifest {
    toml::from_str(&text("student_template/template.toml")).unwrap()
}

/// Returns the names of the files in a folder, as paths below `src`.
fn sources(folder: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(root(folder)).unwrap();
    entries
        .map(|entry| format!("src/{}", entry.unwrap().file_name().into_string().unwrap()))
        .collect()
}

/// Returns the doc comment and the signature of every public function of a file.
fn contracts(source: &str) -> Vec<String> {
    let mut found = vec![];
    let mut contract = String::new();
    for line in source.lines() {
        let is_open = contract.contains("pub fn ");
        if line.starts_with("///") || line.starts_with("pub fn ") || is_open {
            contract += line;
            contract += "\n";
        } else {
            contract.clear();
        }
        if contract.contains("pub fn ") && line.ends_with('{') {
            found.push(std::mem::take(&mut contract));
        }
    }
    found
}

#[test]
fn every_file_is_either_given_or_the_students() {
    let manifest = manifest();
    let listed = || manifest.pristine.iter().chain(&manifest.student);
    let sources = sources("student_template/src");
    assert_eq!(
        listed().filter(|file| file.starts_with("src/")).cloned().collect::<BTreeSet<_>>(),
        sources
    );
    assert_eq!(listed().count(), listed().collect::<BTreeSet<_>>().len(), "a file is listed twice");
    for file in listed() {
        assert!(root("student_template").join(file).is_file(), "{file}");
    }
}

#[test]
fn every_file_of_the_students_belongs_to_one_stage() {
    let manifest = manifest();
    let by_stage: Vec<&String> = manifest.stages.values().flatten().collect();
    assert_eq!(by_stage.len(), manifest.student.len());
    assert_eq!(by_stage.into_iter().collect::<BTreeSet<_>>(), manifest.student.iter().collect());
    for stage in manifest.stages.keys() {
        assert!(root("cases/stages").join(stage).join("stage.toml").is_file(), "{stage}");
    }
}

/// Returns a complaint if the file at `path` differs from the text that the grader carries.
///
/// If `BLESS` is set, that text is written there first.
fn copied(path: &str, carried: &str) -> Option<String> {
    if std::env::var_os("BLESS").is_some() {
        fs::write(root(path), carried).unwrap_or_else(|why| panic!("{path}: {why}"));
    }
    (fs::read_to_string(root(path)).unwrap_or_default() != carried)
        .then(|| format!("{path} differs"))
}

#[test]
fn the_grader_carries_the_template_that_is_handed_out() {
    let carried = Template::carried();
    let mut differ: Vec<String> = vec![];
    for (file, text) in carried.pristine.iter().chain(&carried.student) {
        differ.extend(copied(&format!("student_template/{file}"), text));
    }
    for (file, text) in carried
        .pristine
        .iter()
        .filter(|(file, _)| file.starts_with("src/") || *file == "clippy.toml")
    {
        differ.extend(copied(&format!("tests/solution/{file}"), text));
    }
    assert!(differ.is_empty(), "not as in grader/given: {}", differ.join(", "));
    let carries: BTreeSet<String> =
        carried.pristine.keys().chain(carried.student.keys()).cloned().collect();
    assert_eq!(carries, below("grader/given"));
}

#[test]
fn the_lists_of_the_grader_are_those_of_the_template() {
    let (carried, listed) = (Template::carried(), manifest());
    let mut pristine: BTreeSet<String> = listed.pristine.into_iter().collect();
    assert!(pristine.insert("template.toml".to_owned()), "the list does not name itself");
    assert_eq!(carried.pristine.into_keys().collect::<BTreeSet<_>>(), pristine);
    assert_eq!(
        carried.student.into_keys().collect::<BTreeSet<_>>(),
        listed.student.into_iter().collect()
    );
    let manifest: toml::Table = text("student_template/Cargo.toml").parse().unwrap();
    let dependencies: Vec<String> =
        manifest["dependencies"].as_table().unwrap().keys().cloned().collect();
    assert_eq!(carried.dependencies, dependencies);
}

/// Returns the files below a folder, relative to it.
fn below(folder: &str) -> BTreeSet<String> {
    let files = grader::files::below(&root(folder)).unwrap();
    files
        .iter()
        .map(|file| file.strip_prefix(root(folder)).unwrap().to_str().unwrap().to_owned())
        .collect()
}

#[test]
fn the_solution_keeps_the_contracts_of_the_template() {
    let mut n_functions = 0;
    for file in manifest().student {
        let handed_out = contracts(&text(&format!("student_template/{file}")));
        assert_eq!(handed_out, contracts(&text(&format!("tests/solution/{file}"))), "{file}");
        n_functions += handed_out.len();
    }
    assert_eq!(n_functions, 26);
}

/// Reports take the names and files of functions from this table.
#[test]
fn the_functions_that_reports_name_are_where_the_table_says() {
    let manifest = manifest();
    for Function { key, name, stem, is_given, .. } in FUNCTIONS {
        let file = Language::Rust.path(stem);
        let source = text(&format!("student_template/{file}"));
        assert!(source.contains(&format!("\npub fn {name}(")), "{file} has no function {name}");
        let whose = if is_given { &manifest.pristine } else { &manifest.student };
        assert!(whose.contains(&file), "{key}: {file}");
    }
    let n_of = |key: &str| FUNCTIONS.iter().filter(|function| function.key == key).count();
    let schema = cases::schema::probe_schema();
    let questions =
        schema["definitions"]["Question"]["oneOf"].as_array().expect("a form for each function");
    let keys: Vec<&str> =
        questions.iter().filter_map(|one| one["properties"]["fn"]["const"].as_str()).collect();
    assert_eq!(keys.len(), FUNCTIONS.len());
    assert!(keys.iter().all(|key| n_of(key) == 1), "{keys:?}");
}

/// A body names its function, its rule and its file, and contains nothing else.
#[test]
fn nothing_in_the_template_is_written_yet() {
    for file in manifest().student {
        let source = text(&format!("student_template/{file}"));
        let names = source
            .lines()
            .filter_map(|line| line.strip_prefix("pub fn ")?.split_once('('))
            .map(|(name, _)| name);
        for name in names {
            let opening = format!("    todo!(\"{name} [rule ");
            let body = source.lines().find(|line| line.starts_with(&opening));
            assert!(
                body.is_some_and(|line| line.ends_with(&format!("]: {file}\")"))),
                "{file}: {name}"
            );
        }
        assert_eq!(
            source.matches("todo!(").count(),
            source.matches("\nfn ").count() + source.matches("pub fn ").count()
        );
    }
}
