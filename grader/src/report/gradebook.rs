//! Files for the gradebooks of platforms: a table of its own, or one column of a file that the
//! platform exported. No other byte of such a file changes.

use std::collections::{BTreeMap, BTreeSet};

use cases::problem::{Problem, Problems};
use clap::ValueEnum;

use super::words;
use crate::collect::roll::{Member, Roll, Standing};
use crate::collect::table::{Cell, Table, plain_key};
use crate::plain::{csv_cell, shown};

/// The form of an exported gradebook.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A table for a spreadsheet
    Csv,
    /// The gradebook that Canvas exported, with one column filled
    Canvas,
    /// The grading worksheet that Moodle exported, with its grades filled
    Moodle,
    /// A folder with the results of each submission, as an autograder of Gradescope writes them
    Gradescope,
}

/// A file of a platform with one column filled.
#[derive(Debug)]
pub struct Filled {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// What a person should know: how many rows were filled, and who is left out.
    pub notes: Vec<String>,
}

/// Returns a table for a spreadsheet, in the order of the roster. No text in it can become a
/// formula.
pub fn plain(roll: &Roll) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut write = |record: [String; 11]| {
        out.write_record(record).expect("a vector takes all rows, all of one length")
    };
    let head = [
        "id",
        "name",
        "email",
        "section",
        "group",
        "standing",
        "handed_in",
        "points",
        "deduction",
        "total",
        "possible",
    ];
    write(head.map(str::to_owned));
    for one in &roll.members {
        let text = |text: &str| csv_cell(&shown(text));
        let points = |points: Option<u64>| points.map(words::points).unwrap_or_default();
        write([
            text(&one.id),
            text(&one.name),
            text(&one.email),
            text(&one.section),
            text(&one.group),
            one.standing.words().to_owned(),
            one.handed_in.clone().unwrap_or_default(),
            points(one.earned),
            points(one.deduction),
            points(one.total),
            points(one.possible),
        ]);
    }
    let bytes = out.into_inner().expect("a vector takes all bytes");
    String::from_utf8(bytes).expect("written from strings")
}

/// Fills one column of a platform's file with the totals. `column` names it; without a name, there
/// has to be only one that it could be.
///
/// # Errors
/// The column is not clear, the file names no students, or a row names two of them.
pub fn fill(
    table: &Table,
    roll: &Roll,
    format: Format,
    column: Option<&str>,
) -> Result<Filled, Problems> {
    let grade = grade_column(table, format, column)?;
    let keys = keys(table, format);
    if keys.is_empty() {
        return Err(problem(table, &table.head[0], "no column names the students"));
    }
    let index = Index::new(roll);
    let mut rows: BTreeMap<usize, &Cell> = BTreeMap::new();
    let (mut changes, mut n_unknown, mut problems) = (vec![], 0, vec![]);
    for row in &table.rows {
        let found = index.find(row, &keys);
        let Some(member) = found.first().copied() else {
            n_unknown += usize::from(!is_head(row));
            continue;
        };
        let first = &row[keys[0].0];
        if found.len() > 1 {
            problems.push(problem(table, first, "the row names two students of the roster"));
        } else if rows.insert(member, first).is_some() {
            problems.push(problem(table, first, "a student has two rows"));
        } else if let Some(total) = roll.members[member].total {
            changes.push((&row[grade], words::points(total)));
        }
    }
    if let Some(problems) = problems.into_iter().reduce(Problems::and) {
        return Err(problems);
    }
    let mut notes = notes(roll, &rows, changes.len(), n_unknown);
    notes.extend(other_scale(table, roll, format, grade));
    Ok(Filled { bytes: table.with(&changes), notes })
}

fn problem(table: &Table, cell: &Cell, message: &str) -> Problems {
    let problem = Problem {
        source: std::sync::Arc::clone(&table.source),
        span: Some(cell.span.clone()),
        message: message.to_owned(),
        label: String::new(),
        help: None,
        os_error: None,
    };
    Problems::new(vec![problem]).expect("there is one")
}

/// Returns the name of a column of Canvas without the number of the assignment, `(12345)`, and
/// whether it has one.
fn without_number(name: &str) -> (&str, bool) {
    let split = name.strip_suffix(')').and_then(|rest| rest.rsplit_once('('));
    match split {
        Some((before, number))
            if !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()) =>
        {
            (before.trim_end(), true)
        }
        _ => (name, false),
    }
}

fn grade_column(table: &Table, format: Format, column: Option<&str>) -> Result<usize, Problems> {
    let is_it = |cell: &Cell| match (column, format) {
        (Some(name), _) => cell.text == name || without_number(&cell.text).0 == name,
        (None, Format::Moodle) => plain_key(&cell.text) == "grade",
        (None, _) => without_number(&cell.text).1,
    };
    let found: Vec<usize> = (0..table.head.len()).filter(|n| is_it(&table.head[*n])).collect();
    match (&found[..], column) {
        ([one], _) => Ok(*one),
        ([], None) => Err(problem(table, &table.head[0], "no column is one of an assignment")),
        ([], Some(name)) => {
            Err(problem(table, &table.head[0], &format!("there is no column `{name}`")))
        }
        (several, _) => {
            let names: Vec<String> =
                several.iter().map(|n| format!("`{}`", table.head[*n].text)).collect();
            let message = format!("it may be any of {}: name one with --column", names.join(", "));
            Err(problem(table, &table.head[several[0]], &message))
        }
    }
}

/// A column that names students, and what it can hold.
type Key = (usize, &'static [Kind]);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Id,
    Email,
    Account,
}

/// The columns that name students. Names of students are none, since two can be equal.
const KEYS: [(Format, &str, &[Kind]); 7] = [
    (Format::Canvas, "sisuserid", &[Kind::Id]),
    (Format::Canvas, "sisloginid", &[Kind::Email, Kind::Account]),
    (Format::Canvas, "id", &[Kind::Account]),
    (Format::Moodle, "idnumber", &[Kind::Id]),
    (Format::Moodle, "emailaddress", &[Kind::Email]),
    (Format::Moodle, "identifier", &[Kind::Account]),
    (Format::Moodle, "username", &[Kind::Account]),
];

fn keys(table: &Table, format: Format) -> Vec<Key> {
    let of = |(of, name, kinds): &(Format, &str, &'static [Kind])| {
        let column = table.head.iter().position(|cell| plain_key(&cell.text) == *name)?;
        (*of == format).then_some((column, *kinds))
    };
    KEYS.iter().filter_map(of).collect()
}

/// Returns whether a row is one of Canvas's own, such as that of the possible points.
fn is_head(row: &[Cell]) -> bool {
    let name = row.first().map(|cell| plain_key(&cell.text)).unwrap_or_default();
    ["", "pointspossible", "studenttest", "teststudent"].contains(&&*name)
}

/// The members of a roll by what can name them, without regard to case.
struct Index(BTreeMap<(Kind, String), usize>);

impl Index {
    fn new(roll: &Roll) -> Self {
        let mut index = BTreeMap::new();
        for (n, Member { id, email, account, .. }) in roll.members.iter().enumerate() {
            for (kind, text) in [(Kind::Id, id), (Kind::Email, email), (Kind::Account, account)] {
                if !text.is_empty() {
                    index.insert((kind, text.to_lowercase()), n);
                }
            }
        }
        Self(index)
    }

    /// Returns the members that a row names.
    fn find(&self, row: &[Cell], keys: &[Key]) -> BTreeSet<usize> {
        let mut found = BTreeSet::new();
        for (column, kinds) in keys {
            let text = &row[*column].text;
            let text = text.strip_prefix("Participant ").unwrap_or(text).to_lowercase();
            found.extend(kinds.iter().filter_map(|kind| self.0.get(&(*kind, text.clone()))));
        }
        found
    }
}

fn notes(
    roll: &Roll,
    rows: &BTreeMap<usize, &Cell>,
    n_filled: usize,
    n_unknown: usize,
) -> Vec<String> {
    let mut notes = vec![format!("{} filled", pages::lines::count(n_filled, "row"))];
    for standing in [Standing::Nothing, Standing::NotGraded, Standing::Undecided, Standing::Graded]
    {
        let n = roll
            .members
            .iter()
            .filter(|one| one.standing == standing && one.total.is_none())
            .count();
        if n > 0 {
            let why = match standing {
                Standing::Graded => "the deduction is not known",
                other => other.words(),
            };
            let students = pages::lines::count(n, "student");
            notes.push(format!("{students} without a total keep what is there: {why}"));
        }
    }
    let absent = |n: &usize| !rows.contains_key(n) && roll.members[*n].total.is_some();
    let absent: Vec<&str> =
        (0..roll.members.len()).filter(absent).map(|n| &*roll.members[n].id).collect();
    if !absent.is_empty() {
        let names = pages::lines::some(absent.iter().copied(), 10);
        notes.push(format!("no row of the file is that of {names}"));
    }
    if n_unknown > 0 {
        let rows = pages::lines::count(n_unknown, "row");
        notes.push(format!("{rows} of the file of nobody in the roster"));
    }
    notes
}

/// Returns a note if the platform has another number of possible points than the class.
fn other_scale(table: &Table, roll: &Roll, format: Format, grade: usize) -> Option<String> {
    let ours = roll.members.iter().find_map(|one| one.possible)?;
    let theirs = match format {
        Format::Moodle => {
            let column =
                table.head.iter().position(|cell| plain_key(&cell.text) == "maximumgrade")?;
            &table.rows.first()?[column]
        }
        _ => {
            let is_possible = |row: &&Vec<Cell>| plain_key(&row[0].text) == "pointspossible";
            &table.rows.iter().find(is_possible)?[grade]
        }
    };
    let number: f64 = theirs.text.parse().ok()?;
    let is_equal = (number * 1000.0 - ours as f64).abs() < 0.5;
    (!is_equal).then(|| {
        format!(
            "the platform has {} possible points, and the class {}: nothing is scaled",
            shown(&theirs.text),
            words::points(ours)
        )
    })
}

#[cfg(test)]
mod tests;
