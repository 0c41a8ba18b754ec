//! Tests of the files for gradebooks: one column changes, and nobody gets the points of another.

use proptest::prelude::*;

use super::*;

fn member(id: &str, account: &str, email: &str, total: Option<u64>) -> Member {
    Member {
        id: id.to_owned(),
        account: account.to_owned(),
        email: email.to_owned(),
        total,
        possible: total.map(|_| 100_000),
        standing: if total.is_some() { Standing::Graded } else { Standing::Nothing },
        ..Member::default()
    }
}

fn roll() -> Roll {
    let members = vec![
        member("17", "", "ann@example.org", Some(43_250)),
        member("18", "4712", "", Some(100_000)),
        member("19", "4713", "cy@example.org", None),
        member("20", "4714", "", Some(1)),
    ];
    Roll { members, ..Roll::default() }
}

fn table(text: &str) -> Table {
    Table::parse("export.csv", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
}

const CANVAS: &str = "\u{feff}Student,ID,SIS User ID,SIS Login ID,Section,\"Ray, tracing (12)\",\
    Final Score\r\n\
    \"    Points Possible\",,,,,150,(read only)\r\n\
    \"=cmd|' /C calc'!A0\",4711,17,ann,A,,\"1,5\"\r\n\
    \"Day, Bo\",4712,,,A,3,\r\n\
    \"Fox, Cy\",4713,19,cy@example.org,B,7.5,x\r\n\
    \"Who, Dr\",9,,,B,8,\r\n\
    \"Student, Test\",99,,,A,,\r\n";

#[test]
fn one_column_of_canvas_changes() {
    let filled = fill(&table(CANVAS), &roll(), Format::Canvas, None).unwrap();
    let expected = CANVAS.replace("17,ann,A,,", "17,ann,A,43.25,").replace("A,3,", "A,100,");
    assert_eq!(String::from_utf8(filled.bytes).unwrap(), expected);
    assert_eq!(
        filled.notes,
        [
            "2 rows filled",
            "1 student without a total keep what is there: nothing handed in",
            "no row of the file is that of `20`",
            "1 row of the file of nobody in the roster",
            "the platform has 150 possible points, and the class 100: nothing is scaled",
        ]
    );
}

#[test]
fn the_worksheet_of_moodle_is_filled() {
    let text = "Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade\n\
        Participant 4712,Bo Day,,bo@example.org,,,100.00\n\
        Participant 1,Ann Lee,,ANN@example.org,,,100.00\n";
    let filled = fill(&table(text), &roll(), Format::Moodle, None).unwrap();
    let expected = text
        .replace("bo@example.org,,,", "bo@example.org,,100,")
        .replace("ANN@example.org,,,", "ANN@example.org,,43.25,");
    assert_eq!(String::from_utf8(filled.bytes).unwrap(), expected);
    assert_eq!(filled.notes.len(), 3, "{:?}", filled.notes);
}

#[test]
fn what_is_not_clear_is_refused_with_its_place() {
    let head = "Student,ID,SIS User ID,A (1),B (2)\n";
    for (text, column, place, words) in [
        (format!("{head}x,1,1,,\n"), None, (1, 24), "any of `A (1)`, `B (2)`"),
        (format!("{head}x,1,1,,\n"), Some("C"), (1, 1), "no column `C`"),
        (format!("{head}x,4712,17,,\n"), Some("B"), (2, 8), "two students of the roster"),
        (format!("{head}x,1,17,,\ny,2,17,,\n"), Some("B (2)"), (3, 5), "two rows"),
        ("Student,A (1)\nx,\n".to_owned(), None, (1, 1), "no column names the students"),
        ("Student,ID\nx,1\n".to_owned(), None, (1, 1), "no column is one of an assignment"),
    ] {
        let problems = fill(&table(&text), &roll(), Format::Canvas, column).expect_err(&text);
        let first = problems.iter().next().unwrap();
        assert!(first.message.contains(words), "{text}: {problems}");
        assert_eq!(first.line_column(), Some(place), "{problems}");
    }
}

#[test]
fn no_name_becomes_a_formula() {
    let mut roll = roll();
    for name in ["=1+1", "+1", "-1", "@SUM(A1)", "=HYPERLINK(\"http://x\",\"a,b\")"] {
        roll.members[0].name = name.to_owned();
        roll.members[0].section = name.to_owned();
        let text = plain(&roll);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let row = reader.records().next().unwrap().unwrap();
        let guarded = format!("'{name}");
        assert_eq!((&row[1], &row[3]), (&*guarded, &*guarded));
        assert_eq!((&row[0], &row[9]), ("17", "43.25"));
    }
}

proptest! {
    #[test]
    fn only_the_column_changes(
        cells in proptest::collection::vec("[a-z=+@éß' -]{0,8}", 3..6), total in 0_u64..200_000,
    ) {
        let mut roll = roll();
        roll.members[0].total = Some(total);
        let text = |grade: &str| {
            let others = cells.join(",");
            let names: String = (0..cells.len()).map(|n| format!(",x{n}")).collect();
            format!("Student,SIS User ID,Grade (1){names}\nAnn,17,{grade},{others}\n")
        };
        let filled = fill(&table(&text("")), &roll, Format::Canvas, None).unwrap();
        let expected = text(&words::points(total));
        prop_assert_eq!(String::from_utf8(filled.bytes).unwrap(), expected);
    }
}
