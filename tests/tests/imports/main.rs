//! Tests that source files import each other in one direction only.

mod graph;

use graph::Graph;

/// The only files that need each other: the recursion of the tracer, which is part of the template.
const RECURSION: &[&str] = &["student_template/src"];

#[test]
fn no_two_files_need_each_other() {
    for folder in [
        "cases/src",
        "reference/src",
        "grader/src",
        "grader/layers/src",
        "grader/pages/src",
        "tests/src",
    ] {
        let graph = Graph::of(folder);
        assert!(!graph.imports().is_empty(), "{folder}: the search finds no imports");
        let cycles = graph.cycles();
        let lines = cycles.iter().flat_map(|cycle| {
            let line = |import: &graph::Import| {
                format!("    {} needs {} for {}", import.from, import.to, import.item)
            };
            std::iter::once("a cycle:".to_owned()).chain(cycle.iter().map(line))
        });
        let said: Vec<String> = lines.collect();
        assert!(said.is_empty(), "{folder}\n{}", said.join("\n"));
    }
}

/// The wings of the reference. Each may import only from the ones before it.
const WINGS: &[&str] = &[
    "numbers", "lanes.rs", "rules", "rays", "bvh", "shapes", "watch", "light", "world", "trace",
    "hard", "expect", "cost", "vary", "cli", "main.rs",
];

/// Returns the imports of `graph` that lead from a wing to a later one.
fn wrong_ways(graph: &Graph, wings: &[&str]) -> Vec<String> {
    let wing = |file: &str| {
        let first = file.split('/').next().expect("a path");
        wings.iter().position(|wing| *wing == first).unwrap_or_else(|| panic!("{file}: no wing"))
    };
    let is_part = |file: &str| !["lib.rs", "testing.rs"].contains(&file);
    let imports = graph.imports();
    let among = imports.iter().filter(|one| is_part(&one.from) && is_part(&one.to));
    among
        .filter(|one| wing(&one.from) < wing(&one.to))
        .map(|one| format!("{} needs {} for {}", one.from, one.to, one.item))
        .collect()
}

#[test]
fn a_wing_of_the_reference_knows_only_wings_before_it() {
    let found = wrong_ways(&Graph::of("reference/src"), WINGS);
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn an_import_of_a_later_wing_is_found() {
    let texts = [
        ("lib.rs", "mod a;\nmod b;"),
        ("a/mod.rs", "use crate::b::B;\npub struct A;"),
        ("b/mod.rs", "pub struct B;"),
    ];
    let owned = |(file, text): (&str, &str)| (file.to_owned(), text.to_owned());
    let graph = Graph::read(texts.into_iter().map(owned));
    assert_eq!(wrong_ways(&graph, &["a", "b"]), ["a/mod.rs needs b/mod.rs for crate::b::B"]);
    assert!(wrong_ways(&graph, &["b", "a"]).is_empty());
}

#[test]
fn the_recursion_is_the_only_exception() {
    for folder in RECURSION {
        let cycles = Graph::of(folder).cycles();
        assert_eq!(cycles.len(), 1, "{folder} needs no exception any more, or has another cycle");
        assert!(cycles[0].iter().any(|import| import.item.ends_with("trace")), "{cycles:?}");
    }
}

/// Checks the imports between files with these texts.
fn check(texts: &[(&str, &str)], imports: &[&str], n_cycles: usize) {
    let graph =
        Graph::read(texts.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())));
    let found: Vec<String> =
        graph.imports().iter().map(|one| format!("{} {} {}", one.from, one.to, one.item)).collect();
    assert_eq!(found, imports);
    assert_eq!(graph.cycles().len(), n_cycles);
}

#[test]
fn an_import_leads_to_the_file_that_defines_the_item() {
    let lib = ("lib.rs", "mod a;\nmod b;");
    check(
        &[lib, ("a.rs", "pub struct A;"), ("b.rs", "use crate::a::A;")],
        &["b.rs a.rs crate::a::A"],
        0,
    );
    check(
        &[lib, ("a.rs", "pub fn a() {}"), ("b.rs", "use crate::a;\nfn b() { a::a() }")],
        &["b.rs a.rs a::a"],
        0,
    );
    check(
        &[lib, ("a.rs", "pub fn a() {}"), ("b.rs", "fn b() { super::a::a() }")],
        &["b.rs a.rs super::a::a"],
        0,
    );
    let within = ("b.rs", "fn b() { use crate::a::a; a() }");
    check(&[lib, ("a.rs", "pub fn a() {}"), within], &["b.rs a.rs crate::a::a"], 0);
    let named = ("b.rs", "pub struct B { #[serde(with = \"super::a::a\")] b: f64 }");
    check(&[lib, ("a.rs", "pub fn a() {}"), named], &["b.rs a.rs super::a::a"], 0);
    let in_macro = ("b.rs", "fn b() { print!(\"{}\", crate::a::a()) }");
    check(&[lib, ("a.rs", "pub fn a() {}"), in_macro], &["b.rs a.rs crate::a::a"], 0);
    let test = "#[cfg(test)]\nmod tests { use crate::b::B; }\npub struct A;";
    check(
        &[lib, ("a.rs", test), ("b.rs", "use crate::a::A;\npub struct B;")],
        &["b.rs a.rs crate::a::A"],
        0,
    );
    let both = [
        lib,
        ("a.rs", "use crate::b::B;\npub struct A;"),
        ("b.rs", "use crate::a::A;\npub struct B;"),
    ];
    check(&both, &["a.rs b.rs crate::b::B", "b.rs a.rs crate::a::A"], 1);
}

#[test]
fn a_re_export_is_followed_and_needs_nothing() {
    let folder = ("a/mod.rs", "mod x;\nmod y;\npub use x::X;\npub struct A;");
    let x = ("a/x.rs", "pub struct X;");
    check(&[folder, x, ("a/y.rs", "use super::X;")], &["a/y.rs a/x.rs super::X"], 0);
    check(&[folder, ("a/x.rs", "use super::A;\npub struct X;")], &["a/x.rs a/mod.rs super::A"], 0);
    let uses = ("a/mod.rs", "mod x;\npub use x::X;\npub struct A;\nfn f(_: X) {}");
    let tied = ["a/mod.rs a/x.rs X", "a/x.rs a/mod.rs super::A"];
    check(&[uses, ("a/x.rs", "use super::A;\npub struct X;")], &tied, 1);
    let glob = ("a/mod.rs", "mod x;\npub use x::*;\npub fn load() {}");
    let made = ("a/x.rs", "make! { X }");
    check(&[glob, made, ("b.rs", "use crate::a::X;")], &["b.rs a/x.rs crate::a::X"], 0);
    check(&[glob, made, ("b.rs", "use crate::a::load;")], &["b.rs a/mod.rs crate::a::load"], 0);
}
