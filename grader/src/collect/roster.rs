//! Reads the roster of a class: a CSV file with a row for each student.

use std::collections::BTreeMap;

use cases::problem::{Problems, did_you_mean};

use super::moment::{Clock, Moment, span_s};
use super::notes::Notes;
use super::table::{Cell, Table, plain_key};
use crate::plain;

/// A student of the class. A text is empty if the roster does not have it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Student {
    /// The id that the institution gives. No two students have the same.
    pub id: String,
    /// The full name.
    pub name: String,
    /// The e-mail address.
    pub email: String,
    /// The id or login by which the platform names the student's files.
    pub account: String,
    /// The section of the course.
    pub section: String,
    /// The group that hands in together.
    pub group: String,
    /// The extension of the deadline.
    pub extension: Option<Extension>,
    /// The moment of the hand-in, for exports that do not have it.
    pub handed_in: Option<Moment>,
}

/// An extension of the deadline for one student.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extension {
    /// By so many seconds.
    By(u64),
    /// To this moment.
    Until(Moment),
}

/// The students of a class, in the order of the roster.
#[derive(Clone, Debug, Default)]
pub struct Roster {
    /// The students.
    pub students: Vec<Student>,
    /// The names of the columns that are not used.
    pub unused: Vec<String>,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Field {
    Id,
    Name,
    FirstName,
    LastName,
    Email,
    Account,
    Section,
    Group,
    Extension,
    HandedIn,
}

/// The names of columns, without case, spaces and punctuation.
const NAMES: [(&str, Field); 28] = [
    ("id", Field::Id),
    ("studentid", Field::Id),
    ("idnumber", Field::Id),
    ("sid", Field::Id),
    ("sisuserid", Field::Id),
    ("name", Field::Name),
    ("fullname", Field::Name),
    ("student", Field::Name),
    ("studentname", Field::Name),
    ("firstname", Field::FirstName),
    ("lastname", Field::LastName),
    ("surname", Field::LastName),
    ("email", Field::Email),
    ("emailaddress", Field::Email),
    ("mail", Field::Email),
    ("account", Field::Account),
    ("login", Field::Account),
    ("username", Field::Account),
    ("githubusername", Field::Account),
    ("canvasid", Field::Account),
    ("identifier", Field::Account),
    ("section", Field::Section),
    ("sections", Field::Section),
    ("group", Field::Group),
    ("team", Field::Group),
    ("extension", Field::Extension),
    ("handedin", Field::HandedIn),
    ("submittedat", Field::HandedIn),
];

/// The names that messages suggest.
const SUGGESTED: [&str; 8] =
    ["id", "name", "email", "account", "section", "group", "extension", "handed_in"];

impl Roster {
    /// Reads a roster, which messages call `name`. The order of the columns is free.
    ///
    /// The gradebook of Canvas, the grading worksheet of Moodle, and the rosters of Gradescope and
    /// GitHub Classroom are read as they are.
    ///
    /// # Errors
    /// All problems of the file.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Self, Problems> {
        let table = Table::parse(name, bytes)?;
        let mut notes = Notes::new(&table.source);
        let (columns, unused) = columns(&table, &mut notes);
        if !columns.contains_key(&Field::Id) {
            let message = "no column holds the ids of the students";
            notes.add(span_of(&table.head), message, "name a column `id` in the first line");
            return notes.finish(Self::default());
        }
        let is_gradebook = is_gradebook(&table);
        let mut students = Vec::new();
        let mut cells = Vec::new();
        for row in table.rows.iter().filter(|row| row.len() == table.head.len()) {
            let get = |field| columns.get(&field).map(|column| &row[*column]);
            if !is_gradebook || !is_no_student(get(Field::Name)) {
                students.push(student(&get, &mut notes));
                cells.push([Field::Id, Field::Email, Field::Account].map(get));
            }
        }
        if students.is_empty() {
            notes.add(span_of(&table.head), "the roster has no student", "");
        }
        for (n, what) in ["id", "e-mail address", "account"].into_iter().enumerate() {
            let column: Vec<&Cell> = cells.iter().filter_map(|cells| cells[n]).collect();
            demand_different(&table, &column, what, &mut notes);
        }
        demand_whole_groups(&students, &table, columns.get(&Field::Group), &mut notes);
        notes.finish(Self { students, unused })
    }
}

fn span_of(row: &[Cell]) -> std::ops::Range<usize> {
    match (row.first(), row.last()) {
        (Some(first), Some(last)) => first.span.start..last.span.end,
        _ => 0..0,
    }
}

/// Returns whether the table is the gradebook of Canvas. Its column `ID` is Canvas's own number.
fn is_gradebook(table: &Table) -> bool {
    table.head.iter().any(|cell| plain_key(&cell.text) == "sisuserid")
}

/// Returns whether the table is the roster of GitHub Classroom. Its column `identifier` holds the
/// ids of the institution.
fn is_classroom(table: &Table) -> bool {
    table.head.iter().any(|cell| plain_key(&cell.text) == "githubusername")
}

/// Returns whether a row of a gradebook is none of a student: the row of possible points, or the
/// student that Canvas makes up for tests.
fn is_no_student(name: Option<&Cell>) -> bool {
    name.is_some_and(|name| {
        ["pointspossible", "studenttest", "teststudent"].contains(&&*plain_key(&name.text))
    })
}

/// Returns the column of each field, and the names of the other columns.
fn columns(table: &Table, notes: &mut Notes) -> (BTreeMap<Field, usize>, Vec<String>) {
    let (mut columns, mut unused) = (BTreeMap::new(), Vec::new());
    for (n, cell) in table.head.iter().enumerate() {
        let key = plain_key(&cell.text);
        let field = match &*key {
            "id" if is_gradebook(table) => Some(Field::Account),
            "identifier" if is_classroom(table) => Some(Field::Id),
            key => NAMES.iter().find(|(name, _)| *name == key).map(|(_, field)| *field),
        };
        let Some(field) = field else {
            let near = did_you_mean(&cell.text, SUGGESTED)
                .map_or_else(String::new, |name| format!(" (did you mean `{name}`?)"));
            unused.push(format!("`{}`{near}", plain::name(cell.text.as_bytes())));
            continue;
        };
        if let Some(first) = columns.insert(field, n) {
            let message = format!(
                "two columns hold the same: `{}` and `{}`",
                table.head[first].text, cell.text
            );
            notes.add(cell.span.clone(), message, "rename one of them");
        }
    }
    (columns, unused)
}

fn student<'a>(get: &impl Fn(Field) -> Option<&'a Cell>, notes: &mut Notes) -> Student {
    let text = |field| get(field).map_or_else(String::new, |cell| cell.text.clone());
    let name = match text(Field::Name) {
        name if name.is_empty() => {
            format!("{} {}", text(Field::FirstName), text(Field::LastName)).trim().to_owned()
        }
        name => name,
    };
    if let Some(id) = get(Field::Id) {
        if id.text.is_empty() {
            notes.add(id.span.clone(), "the student has no id", "");
        } else if id.text.chars().any(plain::is_hidden) {
            notes.add(id.span.clone(), "the id has an invisible character", "type it again");
        }
    }
    let account = text(Field::Account);
    Student {
        id: text(Field::Id),
        name,
        email: text(Field::Email),
        account: account.strip_prefix("Participant ").unwrap_or(&account).trim().to_owned(),
        section: text(Field::Section),
        group: text(Field::Group),
        extension: get(Field::Extension).and_then(|cell| extension(cell, notes)),
        handed_in: get(Field::HandedIn).and_then(|cell| handed_in(cell, notes)),
    }
}

fn extension(cell: &Cell, notes: &mut Notes) -> Option<Extension> {
    if cell.text.is_empty() {
        return None;
    }
    let until = || Clock::parse(&cell.text).map(|clock| Extension::Until(clock.moment));
    let extension = span_s(&cell.text).map(Extension::By).or_else(until);
    if extension.is_none() {
        let help = "such as `2 days`, `36 h`, or a new deadline: `2026-10-07 23:59 +02:00`";
        notes.add(cell.span.clone(), "this is no extension of a deadline", help);
    }
    extension
}

fn handed_in(cell: &Cell, notes: &mut Notes) -> Option<Moment> {
    if cell.text.is_empty() {
        return None;
    }
    let moment = Clock::parse(&cell.text).map(|clock| clock.moment);
    if moment.is_none() {
        let help = "a date, a time and an offset, such as `2026-10-05 23:59:00 +02:00`";
        notes.add(cell.span.clone(), "this is no moment", help);
    }
    moment
}

/// Notes each cell whose text occurs in an earlier one, without regard to case.
fn demand_different(table: &Table, column: &[&Cell], what: &str, notes: &mut Notes) {
    let mut first: BTreeMap<String, usize> = BTreeMap::new();
    for cell in column.iter().filter(|cell| !cell.text.is_empty()) {
        let before = &table.source.text[..cell.span.start];
        let line = before.matches('\n').count() + 1;
        match first.get(&cell.text.to_lowercase()) {
            None => drop(first.insert(cell.text.to_lowercase(), line)),
            Some(earlier) => {
                let message =
                    format!("two students have this {what}: it is also in line {earlier}");
                notes.add(cell.span.clone(), message, "");
            }
        }
    }
}

/// Notes each group whose name occurs in two sections, since it may be two groups.
fn demand_whole_groups(
    students: &[Student],
    table: &Table,
    column: Option<&usize>,
    notes: &mut Notes,
) {
    let Some(column) = column else { return };
    let mut sections: BTreeMap<String, &str> = BTreeMap::new();
    for one in students.iter().filter(|one| !one.group.is_empty()) {
        let section = *sections.entry(one.group.to_lowercase()).or_insert(&one.section);
        if section != one.section
            && let Some(row) = table.rows.iter().find(|row| {
                row.get(*column).is_some_and(|cell| cell.text == one.group)
                    && row.iter().any(|cell| cell.text == one.id)
            })
        {
            let message = format!(
                "the group `{}` occurs in the sections `{section}` and `{}`",
                one.group, one.section
            );
            notes.add(row[*column].span.clone(), message, "give each group a name of its own");
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn parse(text: &str) -> Roster {
        Roster::parse("roster.csv", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
    }

    #[test]
    fn columns_are_found_by_name_in_any_order() {
        let text = "\u{feff}Section;E-mail;Full name;Student ID;Extension;x\r\n\
            A;ann@example.org;Ann Lee;17;2 days;\r\n;;\"Bo; Ö\";0018;2026-10-07 23:59 +02:00;\r\n";
        let roster = parse(text);
        let [ann, bo] = &roster.students[..] else { panic!("{roster:?}") };
        assert_eq!((&*ann.id, &*ann.name, &*ann.section), ("17", "Ann Lee", "A"));
        assert_eq!((&*ann.email, ann.extension), ("ann@example.org", Some(Extension::By(172_800))));
        assert_eq!((&*bo.id, &*bo.name), ("0018", "Bo; Ö"));
        assert!(matches!(bo.extension, Some(Extension::Until(_))));
        assert_eq!(roster.unused, ["`x`"]);
    }

    #[test]
    fn files_of_platforms_are_rosters() {
        let gradebook = "Student,ID,SIS User ID,SIS Login ID,Section,Ray tracing (7)\n    Points \
            Possible,,,,,100\n\"Lee, Ann\",4711,17,ann,A,\n\"Student, Test\",99,,,A,\n";
        let roster = parse(gradebook);
        let [ann] = &roster.students[..] else { panic!("{roster:?}") };
        assert_eq!((&*ann.id, &*ann.account, &*ann.name), ("17", "4711", "Lee, Ann"));
        let worksheet = "Identifier,Full name,ID number,Email address,Status,Grade\nParticipant \
            4711,Ann Lee,17,a@example.org,,\n";
        assert_eq!((&*parse(worksheet).students[0].account), "4711");
        let classroom = "identifier,github_username,github_id,name\n17,ann-lee,9,Ann Lee\n";
        let ann = &parse(classroom).students[0];
        assert_eq!((&*ann.id, &*ann.account), ("17", "ann-lee"));
        let gradescope = "First Name,Last Name,SID,Email,Role\nAnn,Lee,17,a@example.org,Student\n";
        assert_eq!(parse(gradescope).students[0].name, "Ann Lee");
    }

    #[test]
    fn all_problems_are_reported_with_their_places() {
        let text = "id,email,extension,handed_in\n1,a@x,2,\n,b@x,,\n1,A@X,1 d,yesterday\n";
        let problems = Roster::parse("roster.csv", text.as_bytes()).unwrap_err();
        let found: Vec<_> =
            problems.iter().map(|one| (one.line_column().unwrap(), &*one.message)).collect();
        assert_eq!(
            found,
            [
                ((2, 7), "this is no extension of a deadline"),
                ((3, 1), "the student has no id"),
                ((4, 1), "two students have this id: it is also in line 2"),
                ((4, 3), "two students have this e-mail address: it is also in line 2"),
                ((4, 11), "this is no moment"),
            ]
        );
        assert!(problems.to_string().contains("roster.csv:2:7"), "{problems}");
    }

    #[test]
    fn a_roster_that_could_confuse_students_is_refused() {
        for (text, words) in [
            ("name\nAnn\n", "no column holds the ids"),
            ("id\n", "no student"),
            ("id,sid\n1,2\n", "two columns hold the same"),
            ("id\n1\u{200b}\n", "invisible character"),
            ("id,account\n1,ann\n2,Ann\n", "two students have this account"),
            ("id,section,group\n1,A,g\n2,B,g\n", "occurs in the sections `A` and `B`"),
        ] {
            let problems = Roster::parse("roster.csv", text.as_bytes()).unwrap_err();
            assert!(problems.to_string().contains(words), "{text:?}: {problems}");
        }
        let roster = parse("id,extention\n1,2 days\n");
        assert_eq!(roster.unused, ["`extention` (did you mean `extension`?)"]);
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(
            rows in "(id|name|email|extension|1|2|é|=1|,|;|\n|\"){0,40}",
        ) {
            if let Ok(roster) = Roster::parse("x.csv", rows.as_bytes()) {
                let mut ids: Vec<String> =
                    roster.students.iter().map(|one| one.id.to_lowercase()).collect();
                ids.sort();
                prop_assert!(ids.windows(2).all(|two| two[0] != two[1]));
            }
        }
    }
}
