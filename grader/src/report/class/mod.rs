//! The table of a class: a row for each submission, as CSV and as a page that sorts, filters and
//! links to the reports.
//!
//! The table does not depend on time, machine or order of work: the same records give the same
//! bytes.

use pages::page::{Layout, Serde, Value, context};

use crate::alike::Pair;
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

/// Returns the table for a spreadsheet, ordered by name. No text in it can become a formula.
pub fn csv(entries: &[Entry]) -> String {
    let (stages, rows) = rows::of(entries);
    let mut out = csv::Writer::from_writer(Vec::new());
    let head = ["id", "name", "points", "possible", "build"].map(str::to_owned).into_iter();
    let head = head
        .chain(stages.iter().map(|stage| csv_cell(&shown(stage.id))))
        .chain(KINDS.iter().map(|kind| words::finding(*kind).to_owned()));
    let mut write = |record: Vec<String>| {
        out.write_record(record).expect("a vector takes all rows, all of one length")
    };
    write(head.collect());
    for row in &rows {
        write(cells(row));
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

fn cells(row: &rows::Row) -> Vec<String> {
    let points = |thousandths: &Option<u64>| thousandths.map(words::points).unwrap_or_default();
    let head = [
        csv_cell(&shown(row.id)),
        csv_cell(&shown(row.name)),
        points(&row.earned),
        points(&row.possible),
        row.build.to_owned(),
    ];
    let counts = KINDS.iter().map(|kind| row.findings.get(kind).copied().unwrap_or(0).to_string());
    head.into_iter().chain(row.stages.iter().map(points)).chain(counts).collect()
}

/// Returns the table as a page. Its links lead to `reports/ID.html` beside it.
pub fn page(entries: &[Entry], alike: &[Pair]) -> String {
    let layout = Layout {
        template: include_str!("class.html"),
        style: include_str!("../style.css"),
        script: include_str!("class.js"),
    };
    let view = Value::from(Serde(view::class(entries, alike)));
    pages::page::html(layout, &context! { view })
}
