//! Checks that every command ends with the exit code that its `--help` promises.

mod common;

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use common::{exam, grader, hand_in, printed, repository};

/// Puts a submission into `folder/name` that gets everything right.
fn hand_in_what_is_right(folder: &Path, name: &str) {
    let home = folder.join(name);
    fs::create_dir_all(&home).unwrap();
    let from = repository().join("tests/submissions");
    fs::copy(from.join("honest.py"), home.join("honest.py")).unwrap();
    for file in ["main.py", "submission.toml"] {
        fs::copy(from.join("honest_python").join(file), home.join(file)).unwrap();
    }
}

/// Returns a folder with submissions, pictures and stages of every kind that the table below names.
fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    for folder in ["empty", "class", "none", "bad_stages/01_x", "man"] {
        fs::create_dir_all(at(folder)).unwrap();
    }
    hand_in_what_is_right(place.path(), "right");
    hand_in_what_is_right(&at("class"), "right");
    hand_in(place.path(), "wrong", "", "exit 1");
    hand_in(place.path(), "unbuilt", "echo no >&2; exit 1", "exit 1");
    fs::write(at("broken.zip"), "no archive").unwrap();
    fs::write(at("bad_stages/01_x/stage.toml"), "title = 1").unwrap();
    for (folder, files) in
        [("right_pictures", ["blue", "green", "red"]), ("wrong_pictures", ["red", "red", "red"])]
    {
        fs::create_dir_all(at(folder).join("01_flat")).unwrap();
        for (name, file) in ["blue", "green", "red"].iter().zip(files) {
            let from = exam().join(format!("01_flat/{file}.expected.png"));
            fs::copy(from, at(folder).join(format!("01_flat/{name}.png"))).unwrap();
        }
    }
    place
}

/// The calls, each with its exit code and a part of what it prints. `EXAM` stands for the folder of
/// the exam.
const CALLS: &[(&str, i32, &str)] = &[
    ("grade right --cases EXAM", 0, "everything that was run passes"),
    ("grade wrong --cases EXAM", 1, "it ended with code 1"),
    ("grade unbuilt --cases EXAM", 1, "does not build"),
    ("grade empty --cases EXAM", 2, "no submission"),
    ("grade broken.zip --cases EXAM", 2, "archive"),
    ("grade missing --cases EXAM", 2, "missing"),
    ("gradebook export empty --format csv -o -", 2, "run `grader batch` with --roster first"),
    ("grade - --cases EXAM", 2, "none is read from standard input"),
    ("grade right --cases missing", 2, "missing"),
    ("grade right --cases empty", 2, "no stages"),
    ("grade right --cases EXAM --stage 07", 2, "there is no stage `07`\nThe stages are `01_flat`."),
    ("grade right --cases EXAM --stage flat", 2, "did you mean `01_flat`?"),
    ("grade right --cases EXAM --case attenuaton", 2, "did you mean `attenuation`?"),
    ("grade right --cases EXAM --case blue", 0, "1 check in 01_flat matches `blue`"),
    (
        "grade right --cases EXAM --case attenuation --case red",
        0,
        " checks in 01_flat match `attenuation` and `red`",
    ),
    ("grade right --cases EXAM --json r.json --junit r.xml", 0, ""),
    ("grade right --cases EXAM --json missing/r.json", 2, "there is no folder `missing`"),
    ("grade --open", 2, "--html"),
    ("batch class -o out --cases EXAM", 0, "1 submission has a record"),
    ("batch class -o out --cases EXAM --stage 07", 2, "there is no stage `07`"),
    ("batch none -o out --cases EXAM", 2, "no submission in none"),
    ("batch missing -o out --cases EXAM", 2, "missing"),
    ("batch class", 2, "--out"),
    ("images right_pictures --cases EXAM", 0, "everything that was run passes"),
    ("images right_pictures --cases EXAM --case red", 0, "1 check in 01_flat matches `red`"),
    ("images wrong_pictures --cases EXAM", 1, "wrong"),
    ("images empty --cases EXAM", 1, "there is no picture"),
    ("images missing --cases EXAM", 2, "missing"),
    ("compare EXAM/01_flat/red.expected.png EXAM/01_flat/red.expected.png", 0, ""),
    ("compare EXAM/01_flat/red.expected.png EXAM/01_flat/blue.expected.png", 1, ""),
    ("compare EXAM/01_flat/red.expected.png missing.png", 2, "missing.png"),
    ("compare EXAM/01_flat/red.expected.png", 2, ""),
    ("explain wrong 01_flat/red 0 0 --cases EXAM", 1, "it ended with code 1"),
    ("explain unbuilt 01_flat/red 0 0 --cases EXAM", 1, "the build command ends with code 1"),
    ("explain empty 01_flat/red 0 0 --cases EXAM", 2, "there is no file in it"),
    ("explain missing 01_flat/red 0 0 --cases EXAM", 2, "missing"),
    ("explain - 01_flat/red 0 0 --cases EXAM", 2, "none is read from standard input"),
    ("explain right 01_flat/pink 0 0 --cases EXAM", 2, "there is no image case `01_flat/pink`"),
    ("explain right 01_flat/red 9999 0 --cases EXAM", 2, "pixel (9999, 0)"),
    ("explain right", 2, ""),
    ("lint EXAM", 1, "01_flat: 3 image cases, at least 8 are wanted"),
    ("lint bad_stages", 1, "title"),
    ("lint empty", 2, "there are no stages in it"),
    ("lint missing", 2, "there is no such folder"),
    ("doctor --cases missing", 3, "missing"),
    ("schema", 0, "\"title\": \"A grade record\""),
    ("schema more", 2, ""),
    ("completions bash", 0, "_grader"),
    ("completions klingon", 2, ""),
    ("completions", 2, ""),
    ("man", 0, "grader"),
    ("man grade", 0, "submission"),
    ("man man", 0, "man page"),
    ("man ./man", 0, ""),
    ("man pages", 2, "there is no command `pages`"),
    ("man broken.zip/x", 2, "cannot write"),
    ("--help", 0, "130  interrupted"),
    ("--version", 0, "grader "),
    ("", 2, "Usage"),
    ("bake", 2, "unrecognized"),
];

#[test]
fn every_call_ends_as_help_says() {
    let place = place();
    let exam = exam();
    for (call, code, part) in CALLS {
        let call = call.replace("EXAM", exam.to_str().unwrap());
        let args: Vec<&str> = call.split_whitespace().collect();
        let output = grader(place.path(), &args).output().unwrap();
        let text = printed(&output);
        assert_eq!(output.status.code(), Some(*code), "grader {call}: {text}");
        assert!(text.contains(part), "grader {call}: no {part:?} in\n{text}");
    }
    assert!(place.path().join("man/grader-schema.1").is_file(), "a page is missing");
}

#[test]
fn every_command_and_every_code_of_its_help_is_in_the_table() {
    let place = tempfile::tempdir().unwrap();
    // The calls above cannot cause these: an interrupt (below), a machine without a compiler, a
    // case without its answer (`lint` of a whole set), a submission that explains itself, a disk
    // that cannot be read (`compare`), a batch with a roster (`gradebook`).
    let excused = [
        ("explain", 0),
        ("explain", 3),
        ("grade", 3),
        ("batch", 3),
        ("images", 3),
        ("compare", 3),
        ("doctor", 0),
        ("lint", 0),
        ("gradebook", 0),
        ("gradebook", 3),
    ];
    let help =
        String::from_utf8(grader(place.path(), &["--help"]).output().unwrap().stdout).unwrap();
    let commands = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names: Vec<&str> =
        commands.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).collect();
    let names: Vec<&str> =
        names.into_iter().filter(|name| !name.is_empty() && *name != "help").collect();
    assert!(names.len() > 9, "{names:?}");
    for name in names {
        let help =
            String::from_utf8(grader(place.path(), &[name, "--help"]).output().unwrap().stdout)
                .unwrap();
        let promised = help
            .split("Exit codes:")
            .nth(1)
            .unwrap_or_else(|| panic!("{name} --help names no exit code"));
        let is_code = |word: &&str| ["0", "1", "2", "3"].contains(word);
        for code in
            promised.split_whitespace().filter(is_code).map(|code| code.parse::<i32>().unwrap())
        {
            let is_called = CALLS
                .iter()
                .any(|(call, ends, _)| call.split(' ').next() == Some(name) && *ends == code);
            assert!(
                is_called != excused.contains(&(name, code)),
                "{name} ends with {code}: no call, or excused for nothing"
            );
        }
    }
}

/// Waits until `path` exists. A minute without that is a failure.
fn wait_for(path: &Path) {
    let start = Instant::now();
    while !path.exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "{} did not come", path.display());
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn an_interrupt_ends_with_130_and_is_said_in_every_report() {
    let place = tempfile::tempdir().unwrap();
    let started = place.path().join("started");
    hand_in(place.path(), "slow", "", &format!("touch {}; sleep 60", started.display()));
    let exam = exam();
    let reports = ["--json", "r.json", "--html", "r.html", "--junit", "r.xml"];
    // The program writes to a file of the test.
    let one = ["grade", "slow", "--sandbox", "none", "--jobs", "1", "--cases"];
    let args = [&one[..], &[exam.to_str().unwrap()], &reports].concat();
    let child = grader(place.path(), &args).stderr(Stdio::null()).spawn().unwrap();
    wait_for(&started);
    let pid = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let text = printed(&output);
    assert_eq!(output.status.code(), Some(130), "{text}");
    let read = |name: &str| fs::read_to_string(place.path().join(name)).unwrap();
    assert!(text.contains("Interrupted: not everything was run"), "{text}");
    assert!(read("r.json").contains("\"interrupted\": true"));
    assert!(
        read("r.html").contains("<title>interrupted · ")
            && read("r.html").contains("Interrupted: not everything")
    );
    assert!(read("r.xml").contains("(interrupted: not everything was run)"));
}

#[test]
fn a_full_disk_behind_standard_output_is_the_machines_failure() {
    let place = tempfile::tempdir().unwrap();
    for args in [
        &["schema"][..],
        &["completions", "bash"],
        &["man"],
        &["doctor"],
        &["--help"],
        &["grade", "--help"],
    ] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = grader(place.path(), args).stdout(full).output().unwrap();
        let text = printed(&output);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {text}");
        assert!(text.contains("cannot write to standard output"), "{args:?}: {text}");
    }
}

/// Runs a call whose reader goes away before the first word, on both streams. Returns the exit
/// code.
fn without_reader(place: &Path, args: &[&str]) -> Option<i32> {
    let mut child = grader(place, args).spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    child.wait().unwrap().code()
}

#[test]
fn no_output_panics_where_its_reader_has_gone() {
    let place = place();
    let exam = exam();
    let exam = exam.to_str().unwrap();
    let table: [(&[&str], i32); 12] = [
        (&["completions", "fish"], 0),
        (&["man"], 0),
        (&["schema"], 0),
        (&["--help"], 0),
        (&["bake"], 2),
        (&["lint", exam], 1),
        (&["doctor", "--cases", "missing"], 3),
        (&["grade", "wrong", "--cases", exam, "-v"], 1),
        (&["grade", "right", "--cases", exam, "--json", "-"], 0),
        (&["images", "wrong_pictures", "--cases", exam], 1),
        (&["explain", "wrong", "01_flat/red", "0", "0", "--cases", exam], 1),
        (&["batch", "class", "-o", "out", "--sandbox", "basic", "--cases", exam], 0),
    ];
    for (args, code) in table {
        assert_eq!(without_reader(place.path(), args), Some(code), "{args:?}");
    }
}
