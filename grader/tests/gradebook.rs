//! Takes a class from an export of Moodle to the files that platforms take back, with the commands
//! of docs/class.md.

mod class;
mod shared;

use std::fs;
use std::process::{Command, Output};

use class::{BLACK, Class, WHITE};

const ROSTER: &str = "id,name,account,handed_in\n\
    17,Ann Lee,4711,2026-10-05 23:58 +02:00\n\
    18,\"Day, Bo\",4712,2026-10-06 10:00 +02:00\n\
    19,Cy Fox,4713,\n";
const POLICY: &str = "deadline = 2026-10-05T23:59:00+02:00\ndeduct = \"25 %\"\nper = \"day\"\n";
const WORKSHEET: &str = "Identifier,Full name,Email address,Grade,Maximum Grade\n\
    Participant 4711,Ann Lee,ann@example.org,,2.00\n\
    Participant 4712,Bo Day,bo@example.org,,2.00\n\
    Participant 4713,Cy Fox,cy@example.org,1.00,2.00\n";
const GRADEBOOK: &str = "Student,ID,SIS User ID,SIS Login ID,Section,Ray tracing (9)\n    \
    Points Possible,,,,,2\n\"Lee, Ann\",4711,17,ann,A,\n\"Fox, Cy\",4713,19,cy,A,\n";

/// Returns a graded class, with the files of its platforms.
fn graded() -> Class {
    let class = Class::new(&[
        ("Ann Lee_4711_assignsubmission_file_", BLACK),
        ("Bo Day_4712_assignsubmission_file_", BLACK),
        ("Eve_4714_assignsubmission_file_", WHITE),
    ]);
    for (name, text) in [
        ("roster.csv", ROSTER),
        ("late.toml", POLICY),
        ("worksheet.csv", WORKSHEET),
        ("canvas.csv", GRADEBOOK),
    ] {
        fs::write(class.at(name), text).unwrap();
    }
    let (roster, policy) = (class.at("roster.csv"), class.at("late.toml"));
    let arguments = ["--roster", roster.to_str().unwrap(), "--policy", policy.to_str().unwrap()];
    let (code, printed, lines) = class.run_under(":", &arguments);
    assert_eq!(code, 0, "{printed}{lines}");
    assert!(printed.contains("1 question for you to decide"), "{printed}");
    class
}

/// Runs `grader gradebook export out` with these arguments, in the folder of the class. Returns the
/// exit code and both streams.
fn export(class: &Class, arguments: &str) -> (i32, String) {
    let Output { status, stdout, stderr } = Command::new(env!("CARGO_BIN_EXE_grader"))
        .args(["gradebook", "export", "out"])
        .args(arguments.split(' '))
        .current_dir(class.at(""))
        .output()
        .unwrap();
    let text = [stdout, stderr].concat();
    (status.code().unwrap(), String::from_utf8(text).unwrap())
}

#[test]
fn a_class_goes_from_an_export_to_the_files_of_platforms() {
    let class = graded();
    let (code, table) = export(&class, "--format csv -o -");
    let expected = "id,name,email,section,group,standing,handed_in,points,deduction,total,\
        possible\n\
        17,Ann Lee,,,,graded,2026-10-05 23:58:00 +02:00,2,0,2,2\n\
        18,\"Day, Bo\",,,,graded,2026-10-06 10:00:00 +02:00,2,0.5,1.5,2\n\
        19,Cy Fox,,,,nothing handed in,,,,,\n";
    assert_eq!((code, &*table), (0, expected));

    let (code, notes) = export(&class, "--format moodle --into worksheet.csv -o filled.csv");
    assert_eq!(code, 0, "{notes}");
    assert!(notes.contains("2 rows filled") && notes.contains("nothing handed in"), "{notes}");
    let filled = fs::read_to_string(class.at("filled.csv")).unwrap();
    let expected = WORKSHEET
        .replace("ann@example.org,,", "ann@example.org,2,")
        .replace("bo@example.org,,", "bo@example.org,1.5,");
    assert_eq!(filled, expected);

    let (code, notes) =
        export(&class, "--format canvas --into canvas.csv --column Ray -o canvas2.csv");
    assert_eq!(code, 2);
    assert!(notes.contains("canvas.csv:1:1") && notes.contains("no column `Ray`"), "{notes}");
    assert!(!class.at("canvas2.csv").exists());
    let (code, notes) = export(&class, "--format canvas --into canvas.csv -o canvas.csv");
    assert_eq!(code, 0, "{notes}");
    assert!(notes.contains("no row of the file is that of `18`"), "{notes}");
    let filled = fs::read_to_string(class.at("canvas.csv")).unwrap();
    assert_eq!(filled, GRADEBOOK.replace("17,ann,A,", "17,ann,A,2"));

    let (code, notes) = export(&class, "--format gradescope -o gradescope");
    assert_eq!((code, notes.trim()), (0, "2 files written"));
    let name = fs::read_dir(class.at("gradescope")).unwrap().next().unwrap().unwrap().path();
    let results: serde_json::Value = serde_json::from_slice(&fs::read(name).unwrap()).unwrap();
    assert_eq!(results["score"], 2.0);
}

#[test]
fn what_cannot_be_used_is_said_before_anything_is_written() {
    let class = Class::new(&[]);
    let (code, text) = export(&class, "--format csv -o points.csv");
    assert!(code == 2 && text.contains("with --roster first"), "{code}: {text}");
    fs::create_dir(class.at("out")).unwrap();
    fs::write(class.at("out/roll.json"), "{\"schema\":").unwrap();
    let (code, text) = export(&class, "--format csv -o points.csv");
    assert!(code == 2 && text.contains("run the batch again"), "{code}: {text}");
    for arguments in ["--format canvas -o a.csv", "--format csv --into x.csv -o a.csv"] {
        assert_eq!(export(&class, arguments).0, 2, "{arguments}");
    }
    fs::write(class.at("roster.csv"), "id,email\n1,\n1,\n,\n").unwrap();
    fs::write(class.at("late.toml"), "deadline = 1\n").unwrap();
    let (roster, policy) = (class.at("roster.csv"), class.at("late.toml"));
    let arguments = ["--roster", roster.to_str().unwrap(), "--policy", policy.to_str().unwrap()];
    let (code, _, lines) = class.run_under(":", &arguments);
    assert_eq!(code, 2, "{lines}");
    for place in ["roster.csv:3:1", "roster.csv:4:1", "late.toml:1:12", "3 problems in 2 files"] {
        assert!(lines.contains(place), "no {place} in {lines}");
    }
}
