//! Tests of the judge: correct programs that are written differently lose nothing, and programs
//! with a single bug lose points where the bug is.
//!
//! One in 27 of `tests/mutants` by name is tested. `MUTANTS=N` tests every N-th instead, as the
//! gate does with 3; `cargo run --release -p tests --bin judge` tests all of them.

use std::collections::BTreeSet;
use std::fs;

use reference::rules::Rules;
use reference::rules::misconceptions;
use tests::lab::{Lab, cores};
use tests::variants::{self, Edit, Nature, Variant};
use tests::{bars, files, workspace};

fn all() -> Vec<Variant> {
    variants::all().unwrap_or_else(|why| panic!("{why}"))
}

/// Returns every n-th of `variants`, where n is the value of `MUTANTS`, or 27.
fn sample(variants: Vec<Variant>) -> Vec<Variant> {
    let step = match std::env::var("MUTANTS") {
        Ok(n) => n
            .parse()
            .ok()
            .filter(|n| *n > 0)
            .unwrap_or_else(|| panic!("MUTANTS={n}: the value is a whole number above 0")),
        Err(_) => 27,
    };
    variants.into_iter().step_by(step).collect()
}

#[test]
fn the_judge_reaches_its_bars() {
    let lab = Lab::open(None).unwrap_or_else(|why| panic!("{why}"));
    let trials = lab
        .try_all(&sample(all()), cores(), &|_| {})
        .unwrap_or_else(|faults| panic!("{}", faults.join("\n")));
    let faults = bars::faults(&trials);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_edit_fits() {
    let unfit: Vec<String> = all().iter().filter_map(|variant| variant.make().err()).collect();
    assert!(unfit.is_empty(), "{}", unfit.join("\n"));
    let n_right = all().iter().filter(|variant| variant.nature == Nature::Right).count();
    assert!(n_right >= 25, "{n_right} right ways to write it");
    assert!(all().len() - n_right >= 120, "{} bugs", all().len() - n_right);
}

#[test]
fn an_edit_that_does_not_fit_is_refused() {
    let check = |search: Option<&str>, replace: &str, expected: Result<&str, &str>| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.rs");
        fs::write(&path, "one two two").expect("a file");
        let edit = Edit {
            file: "a.rs".to_owned(),
            search: search.map(str::to_owned),
            replace: replace.to_owned(),
        };
        match (edit.make(folder.path()), expected) {
            (Ok(()), Ok(text)) => assert_eq!(fs::read_to_string(&path).expect("a file"), text),
            (Err(why), Err(start)) => assert!(why.starts_with(start), "{why}"),
            (made, _) => panic!("{made:?}, expected {expected:?}"),
        }
    };
    check(Some("one"), "three", Ok("three two two"));
    check(None, "whole", Ok("whole"));
    check(Some("two"), "three", Err("the text to search for occurs 2 times, not once: two"));
    check(Some("four"), "three", Err("the text to search for occurs 0 times"));
    check(Some("one"), "one", Err("nothing changes"));
}

/// Returns the names of the functions that students write.
fn functions() -> BTreeSet<String> {
    let text = fs::read_to_string(workspace().join("student_template/template.toml"))
        .expect("the list of files");
    let lists: toml::Table = text.parse().expect("TOML");
    let paths = lists["student"].as_array().expect("a list").iter();
    let sources =
        paths.map(|path| workspace().join("tests/solution").join(path.as_str().expect("a path")));
    let text: String =
        sources.map(|path| fs::read_to_string(path).expect("a source file")).collect();
    text.lines()
        .filter_map(|line| line.strip_prefix("pub fn ")?.split('(').next())
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_function_has_bugs_and_every_rule_is_broken() {
    let stem =
        |path: std::path::PathBuf| path.file_stem().expect("a name").to_string_lossy().into_owned();
    let with_bugs: BTreeSet<String> =
        files("tests/mutants/wrong", "toml").into_iter().map(stem).collect();
    assert_eq!(with_bugs, functions());
    let stages: BTreeSet<String> = files("cases/stages", "toml")
        .iter()
        .filter(|path| path.ends_with("stage.toml"))
        .filter_map(|path| Some(path.parent()?.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let known = misconceptions::of(&Rules::LECTURE);
    let mut rules = BTreeSet::new();
    for variant in all() {
        let Nature::Wrong { stage, diagnosis } = &variant.nature else { continue };
        assert!(stages.contains(stage), "{}: there is no stage {stage}", variant.name);
        let Some(id) = diagnosis else { continue };
        let named = known.iter().find(|known| known.id == id);
        rules.insert(
            named
                .unwrap_or_else(|| panic!("{}: no misconception is called {id}", variant.name))
                .rule,
        );
    }
    assert_eq!(rules, (1..=21).collect(), "rules that a bug with a name breaks");
}
