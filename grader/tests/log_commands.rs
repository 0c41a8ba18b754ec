//! Checks that no output of a submission, and no name in it, acts as a command on the machine that
//! keeps the log.

mod common;

use std::fs;

use common::{exam, grader, hand_in, printed};

/// Commands to the reader of the log that a submission prints. A record contains each of them.
const ATTACKS: [&str; 4] = [
    "::error file=a.rs::owned",
    "  ::stop-commands::owned",
    "##[error]owned",
    "##vso[task.complete result=Failed]owned",
];

/// Returns a line of `text` that the runner of GitHub or the agent of Azure would obey, or `None`.
fn obeyed(text: &str) -> Option<&str> {
    text.split(['\n', '\r']).find(|line| {
        let starts = line.trim_start().starts_with("::");
        starts || ["##[", "##vso["].iter().any(|word| line.contains(word))
    })
}

/// Returns a program that attacks in every way.
///
/// The program prints the commands on both streams, in its answers to questions, and as the name of
/// a function that is still to be written.
fn program() -> String {
    let lines = ATTACKS.join("\n");
    format!(
        "cat <<'END' >&2\n{lines}\ntodo: {0}\npanic: {0}\nEND\n\
         case $1 in\n\
         render) case $2 in *) exit 75;; esac;;\n\
         explain) printf '%s\\n' '{0}' '{1}' '{2}' '{3}'; exit 0;;\n\
         probe) printf '%s\\n' '{2}'\n\
         while read line; do id=${{line#*\\\"id\\\":\\\"}}; id=${{id%%\\\"*}}\n\
         printf '{{\"id\":\"%s\",\"panic\":\"x\\\\n{0}\\\\n{1}\\\\n{2}\\\\r{3}\"}}\\n' \"$id\"; \
         done;;\n\
         esac\n",
        ATTACKS[0], ATTACKS[1], ATTACKS[2], ATTACKS[3]
    )
}

#[test]
fn no_command_prints_an_attack() {
    let place = tempfile::tempdir().unwrap();
    let class = place.path().join("class");
    let odd_names = ["::error ::x", " ::debug::x", "##[error]x", "a\n::error::x", "x\r::error::x"];
    for name in odd_names {
        hand_in(&class, name, "", &program());
    }
    hand_in(
        &class,
        "fails",
        &format!("cat <<'END' >&2\n{}\nEND\nexit 1", ATTACKS.join("\n")),
        "exit 1",
    );
    // Files of these names are left aside, and named in the report.
    fs::create_dir_all(class.join("rust/src")).unwrap();
    fs::write(class.join("rust/src/light.rs"), "::error::x ##[error]").unwrap();
    for name in ["::error ::x.rs", "##[error]x.rs"] {
        fs::write(class.join("rust/src").join(name), "").unwrap();
        fs::write(class.join(name), "").unwrap();
    }
    let exam = exam();
    let cases = ["--cases", exam.to_str().unwrap()];
    let mut calls: Vec<Vec<&str>> = vec![];
    for name in odd_names.iter().copied().chain(["fails"]) {
        calls.push([&["grade", name], &cases[..]].concat());
        calls.push([&["grade", name, "-v", "--color", "always"], &cases[..]].concat());
        calls.push([&["grade", name, "--json", "-"], &cases[..]].concat());
        calls.push(
            [&["grade", name, "-q", "--junit", "r.xml", "--html", "r.html"], &cases[..]].concat(),
        );
        calls.push([&["explain", name, "01_flat/red", "0", "0"], &cases[..]].concat());
        calls.push([&["images", name], &cases[..]].concat());
    }
    calls.push([&["batch", ".", "-o", "../out", "--sandbox", "basic"], &cases[..]].concat());
    calls.push([&["batch", ".", "-o", "../::out", "--sandbox", "basic"], &cases[..]].concat());
    // The last name begins a line of its own in every message that has it.
    for missing in ["::error ::x.png", "##[error]x.png", "x\n::error ::x"] {
        calls.push(vec!["compare", missing, missing]);
        calls.push(vec!["lint", missing]);
        calls.push([&["grade", missing], &cases[..]].concat());
        calls.push([&["grade", "fails", "--case", missing], &cases[..]].concat());
        calls.push(vec!["man", missing]);
        calls.push(vec![missing]);
    }
    for call in &calls {
        let text = printed(&grader(&class, call).output().unwrap());
        assert_eq!(obeyed(&text), None, "{call:?}:\n{text}");
        if call[0] == "grade" && call.contains(&"-v") || call[0] == "explain" {
            assert!(
                text.contains("owned"),
                "{call:?} does not show what the submission says:\n{text}"
            );
        }
        for report in ["r.xml", "r.html"] {
            if let Ok(text) = fs::read_to_string(class.join(report)) {
                assert_eq!(obeyed(&text), None, "{call:?}, {report}:\n{text}");
                fs::remove_file(class.join(report)).unwrap();
            }
        }
    }
    for file in ["class.csv", "class.html"] {
        let text = fs::read_to_string(place.path().join("out").join(file)).unwrap();
        assert_eq!(obeyed(&text), None, "{file}:\n{text}");
    }
    assert!(ATTACKS.iter().all(|attack| obeyed(attack).is_some()), "the check finds nothing");
}
