//! Tests of the class table: rows are ordered by name whatever the order of the entries, and no
//! name can do harm.

use super::*;
use crate::collect::roll::{Decision, NotCounted, Standing};
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
    let text = csv(entries, None);
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
    assert_eq!(csv(&turned, None), csv(&entries(), None));
    assert_eq!(page(&turned, &[], None), page(&entries(), &[], None));
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
    let page = page(&[entry("x", HOSTILE)], &[], None);
    assert_eq!(page.matches("<script").count(), 1);
    assert!(!page.contains("<img src=x"));
    assert!(page.contains("&lt;script&gt;document.title"));
}

#[test]
fn the_page_links_to_the_reports_and_names_who_is_missing() {
    let page = page(&entries(), &[], None);
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
    assert!(page(&entries, &[], None).contains(row));
    entries[1].record.as_mut().unwrap().diagnoses[0].confidence = Confidence::Perhaps;
    assert!(page(&entries, &[], None).contains("<td class=\"number\">2, 1 perhaps</td>"));
    assert!(!page(&[], &[], None).contains("The most common mistakes"));
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
    assert!(page(&[], &[], None).contains("0 submissions"));
}

/// Returns a roll in which alice has 1.25 points less, erin handed in nothing, and dave's hand-in
/// is nobody's.
fn roll() -> Roll {
    let alice = Member {
        id: "17".to_owned(),
        name: "Alice Lee".to_owned(),
        section: "=A".to_owned(),
        standing: Standing::Graded,
        submission: Some("alice".to_owned()),
        handed_in: Some("2026-10-06 00:30:00 +02:00".to_owned()),
        late_s: Some(1_860),
        deduction: Some(1_250),
        total: Some(5_500),
        ..Member::default()
    };
    let erin = Member { id: "18".to_owned(), name: "Erin".to_owned(), ..Member::default() };
    let twin = Member { id: "19".to_owned(), name: "Twin".to_owned(), ..alice.clone() };
    let (hand_ins, students) = (vec!["dave".to_owned()], vec![HOSTILE.to_owned()]);
    let why = "no student has this name".to_owned();
    let decisions = vec![Decision { hand_ins, students, why }];
    let not_counted = vec![NotCounted {
        hand_in: "old.zip".to_owned(),
        students: vec!["17".to_owned()],
        why: "a later hand-in counts".to_owned(),
    }];
    Roll { members: vec![erin, alice, twin], decisions, not_counted, ..Roll::default() }
}

#[test]
fn a_roster_gives_each_student_a_row_and_each_row_all_columns() {
    let (entries, roll) = (entries(), roll());
    let page = page(&entries, &[], Some(&roll));
    let table = page.split("<table class=\"class\">").nth(1).unwrap().split("</table>").next();
    let n_cells = |row: &str| row.matches("<th ").count() + row.matches("<td").count();
    let rows: Vec<usize> = table.unwrap().split("<tr>").skip(1).map(n_cells).collect();
    assert_eq!(rows, [12; 7], "the head, three students, and three hand-ins of nobody");
    for part in ["To be decided: 1", "Hand-ins that do not count: 1", "nothing handed in", "5.5"] {
        assert!(page.contains(part), "no {part:?} in {page}");
    }
    assert_eq!(page.matches("alice.html#01_ray_casting&#x2f;contested").count(), 1);
    assert_eq!(page.matches("<script").count(), 1);

    let text = csv(&entries, Some(&roll));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let alice: Vec<&str> = rows[0].iter().take(13).collect();
    let handed_in = "2026-10-06 00:30:00 +02:00";
    let expected = [
        "alice",
        "Alice Lee",
        "6.75",
        "16",
        "worked",
        "17",
        "'=A",
        "",
        handed_in,
        "31 min",
        "1.25",
        "5.5",
        "graded",
    ];
    assert_eq!(alice, expected);
    let names: Vec<&str> = rows.iter().map(|row| &row[1]).collect();
    assert_eq!(names, ["Alice Lee", "Erin", "Twin", "bob", "carol", "dave"]);
    assert_eq!(&rows[1][12], "nothing handed in");
    assert!(decisions_csv(&roll).contains("not counted,old.zip,17,a later hand-in counts"));
}
