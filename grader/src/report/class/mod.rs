//! The table of a class: a row for each submission, as CSV and as a page that sorts, filters and
//! links to the reports.
//!
//! The table does not depend on time, machine or order of work: the same records give the same
//! bytes.

use pages::page::{Layout, Serde, Value, context};

use crate::alike::Pair;
use crate::collect::roll::{Member, Roll};
use crate::plain::{csv_cell, shown};
use crate::record::FindingKind;
use crate::report::words;

mod entry;
mod histogram;
mod rows;
#[cfg(test)]
mod tests;
mod view;

pub use entry::Entry;

/// The kinds of finding that a row counts.
const KINDS: [FindingKind; 16] = [
    FindingKind::Wrong,
    FindingKind::Antialiased,
    FindingKind::Contested,
    FindingKind::Nondeterministic,
    FindingKind::Crash,
    FindingKind::Timeout,
    FindingKind::Memory,
    FindingKind::Output,
    FindingKind::Unreadable,
    FindingKind::Size,
    FindingKind::Missing,
    FindingKind::Todo,
    FindingKind::Build,
    FindingKind::Submission,
    FindingKind::Remark,
    FindingKind::Internal,
];

/// The columns of a student of the roster.
const MEMBER: [&str; 8] =
    ["student", "section", "group", "handed in", "late", "deduction", "total", "standing"];

/// Returns the table for a spreadsheet, ordered by name. No text in it can become a formula.
pub fn csv(entries: &[Entry], roll: Option<&Roll>) -> String {
    let (stages, rows) = rows::of(entries, roll);
    let mut out = csv::Writer::from_writer(Vec::new());
    let head = ["id", "name", "points", "possible", "build"].map(str::to_owned).into_iter();
    let of_member = if roll.is_some() { &MEMBER[..] } else { &[] };
    let head = head
        .chain(of_member.iter().map(|name| (*name).to_owned()))
        .chain(stages.iter().map(|stage| csv_cell(&shown(stage.id))))
        .chain(KINDS.iter().map(|kind| words::finding(*kind).to_owned()));
    let mut write = |record: Vec<String>| {
        out.write_record(record).expect("a vector takes all rows, all of one length")
    };
    write(head.collect());
    for row in &rows {
        write(cells(row, roll.is_some()));
    }
    let bytes = out.into_inner().expect("a vector takes all bytes");
    String::from_utf8(bytes).expect("written from strings")
}

/// Returns the pairs of submissions that are alike, for a spreadsheet.
pub fn alike_csv(entries: &[Entry], alike: &[Pair]) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut write = |record: [String; 5]| {
        out.write_record(record).expect("a vector takes all rows, all of one length")
    };
    write(["id", "name", "other id", "other name", "share"].map(str::to_owned));
    for Pair { ids, share } in alike {
        let [one, other] = ids.each_ref().map(|id| csv_cell(&shown(entry::name(entries, id))));
        let [id, other_id] = ids.each_ref().map(|id| csv_cell(&shown(id)));
        write([id, one, other_id, other, format!("{share:.3}")]);
    }
    let bytes = out.into_inner().expect("a vector takes all bytes");
    String::from_utf8(bytes).expect("written from strings")
}

fn cells(row: &rows::Row, has_roll: bool) -> Vec<String> {
    let points = |thousandths: &Option<u64>| thousandths.map(words::points).unwrap_or_default();
    let head = [
        csv_cell(&shown(row.id)),
        csv_cell(&shown(row.name)),
        points(&row.earned),
        points(&row.possible),
        row.build.to_owned(),
    ];
    let counts = KINDS.iter().map(|kind| row.findings.get(kind).copied().unwrap_or(0).to_string());
    let of_member = if has_roll { member_cells(row.member).to_vec() } else { vec![] };
    head.into_iter().chain(of_member).chain(row.stages.iter().map(points)).chain(counts).collect()
}

/// Returns the cells under [`MEMBER`]. They are empty for a submission without a student.
fn member_cells(member: Option<&Member>) -> [String; MEMBER.len()] {
    let Some(member) = member else { return Default::default() };
    let text = |text: &str| csv_cell(&shown(text));
    let points = |points: Option<u64>| points.map(words::points).unwrap_or_default();
    [
        text(&member.id),
        text(&member.section),
        text(&member.group),
        member.handed_in.clone().unwrap_or_default(),
        rows::late(member),
        points(member.deduction),
        points(member.total),
        member.standing.words().to_owned(),
    ]
}

/// Returns what a person has to decide, and the hand-ins that do not count, for a spreadsheet.
pub fn decisions_csv(roll: &Roll) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut write = |record: [String; 4]| {
        out.write_record(record).expect("a vector takes all rows, all of one length")
    };
    write(["kind", "hand-ins", "students", "why"].map(str::to_owned));
    let text = |text: &str| csv_cell(&shown(text));
    for one in &roll.decisions {
        let (hand_ins, students) = (one.hand_ins.join(" | "), one.students.join(" | "));
        write(["to be decided".to_owned(), text(&hand_ins), text(&students), text(&one.why)]);
    }
    for one in &roll.not_counted {
        let students = one.students.join(" | ");
        write(["not counted".to_owned(), text(&one.hand_in), text(&students), text(&one.why)]);
    }
    let bytes = out.into_inner().expect("a vector takes all bytes");
    String::from_utf8(bytes).expect("written from strings")
}

/// Returns the table as a page. Its links lead to `reports/ID.html` beside it.
pub fn page(entries: &[Entry], alike: &[Pair], roll: Option<&Roll>) -> String {
    let layout = Layout {
        template: include_str!("class.html"),
        style: include_str!("../style.css"),
        script: include_str!("class.js"),
    };
    let view = Value::from(Serde(view::class(entries, alike, roll)));
    pages::page::html(layout, &context! { view })
}
