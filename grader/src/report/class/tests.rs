//! Tests of the class table: rows are ordered by name whatever the order of the entries, and no
//! name can do harm.

use super::*;
use crate::record::{Confidence, Verdict};
use crate::report::sample::{self, HOSTILE};

fn entry(id: &str, name: &str) -> Entry {
    Entry { id: id.to_owned(), name: name.to_owned(), record: Some(sample::record(name)) }
}

fn entries() -> Vec<Entry> {
    let mut broken = entry("carol", "carol");
    let record = broken.record.as_mut().unwrap();
    record.build.verdict = Verdict::Fail;
    record.build.finding = Some(sample::finding(FindingKind::Build));
    record.score.earned = 0;
    record.stages[0].earned = 0;
    let mut perfect = entry("bob", "bob");
    let record = perfect.record.as_mut().unwrap();
    record.score.earned = record.score.possible;
    record.stages[0].earned = record.stages[0].possible;
    vec![Entry { record: None, ..entry("dave", "dave") }, broken, entry("alice", "alice"), perfect]
}

fn table(entries: &[Entry]) -> Vec<Vec<String>> {
    let text = csv(entries);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

#[test]
fn the_table_says_what_the_records_say() {
    let table = table(&entries());
    assert_eq!(
        table[0][..7],
        ["id", "name", "points", "possible", "build", "01_ray_casting", "wrong"]
    );
    assert_eq!(table[1][..7], ["alice", "alice", "6.75", "16", "worked", "6.75", "3"]);
    assert_eq!(table[2][..6], ["bob", "bob", "16", "16", "worked", "16"]);
    assert_eq!(table[3][..6], ["carol", "carol", "0", "16", "failed", "0"]);
    assert_eq!(table[4][..6], ["dave", "dave", "", "", "not graded", ""]);
    let column = table[0].iter().position(|head| head == "does not build").unwrap();
    let counts: Vec<&str> = table[1..].iter().map(|row| &*row[column]).collect();
    assert_eq!(counts, ["0", "0", "1", "0"]);
}

#[test]
fn every_kind_of_finding_has_a_column() {
    for kind in KINDS {
        let counted = KINDS.iter().filter(|other| **other == kind).count();
        assert_eq!(counted, 1, "{kind:?}");
    }
    assert_eq!(table(&entries())[0].len(), 6 + KINDS.len());
}

#[test]
fn the_order_of_the_entries_does_not_matter() {
    let mut turned = entries();
    turned.reverse();
    assert_eq!(csv(&turned), csv(&entries()));
    assert_eq!(page(&turned, &[]), page(&entries(), &[]));
}

#[test]
fn no_name_becomes_a_formula() {
    for name in ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "=HYPERLINK(\"http://x\",\"a,b\")"] {
        let table = table(&[entry("x", name)]);
        assert_eq!(table[1][1], format!("'{name}"), "{name}");
    }
    assert_eq!(
        table(&[entry("x", "o'hara, \"z\"\n=2")])[1][1],
        "o'hara, \"z\"\n=2",
        "the control: quoted, not changed"
    );
}

#[test]
fn no_name_becomes_markup() {
    let page = page(&[entry("x", HOSTILE)], &[]);
    assert_eq!(page.matches("<script").count(), 1);
    assert!(!page.contains("<img src=x"));
    assert!(page.contains("&lt;script&gt;document.title"));
}

#[test]
fn the_page_links_to_the_reports_and_names_who_is_missing() {
    let page = page(&entries(), &[]);
    assert!(page.contains("<a href=\"reports/alice.html\">alice</a>"));
    assert!(!page.contains("reports/dave.html"));
    assert!(page.contains("Not graded"));
    assert!(page.contains("3 submissions"));
    assert!(page.contains("To be looked at: 3"));
    assert!(page.contains(
        "<a href=\"reports/alice.html#01_ray_casting&#x2f;contested\">alice: \
            01_ray_casting&#x2f;contested</a>"
    ));
    assert!(page.contains("0 of 3, 3 partly"));
}

#[test]
fn the_page_counts_the_mistakes_that_are_made() {
    let mut entries = entries();
    entries[2].record.as_mut().unwrap().diagnoses.clear();
    let row = "<tr><th scope=\"row\">the one is &lt;wrong&gt;</th><td class=\"number\">3</td><td \
        class=\"number\">2</td>";
    assert!(page(&entries, &[]).contains(row));
    entries[1].record.as_mut().unwrap().diagnoses[0].confidence = Confidence::Perhaps;
    assert!(page(&entries, &[]).contains("<td class=\"number\">2, 1 perhaps</td>"));
    assert!(!page(&[], &[]).contains("The most common mistakes"));
}

#[test]
fn bars_count_tenths_and_full_marks() {
    let scores = [(0, 10), (9, 100), (10, 100), (99, 100), (100, 100), (5, 0)];
    let bars = histogram::of("x".to_owned(), scores.into_iter()).bars;
    let counts: Vec<usize> = bars.iter().map(|bar| bar.count).collect();
    assert_eq!(counts, [2, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1]);
    assert_eq!(bars[10].label, "all");
}

#[test]
fn an_empty_class_has_an_empty_table() {
    assert_eq!(table(&[]).len(), 1);
    assert!(page(&[], &[]).contains("0 submissions"));
}
