//! The solution answers every unit check, within what the check allows.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use cases::probe::{Question, Reply};
use cases::stage::{self, Check};
use reference::expect::{allowed, of_check};

/// The replies of the program to one process full of questions.
fn replies(checks: &[Check]) -> Vec<Reply> {
    let questions: String = checks
        .iter()
        .map(|check| Question { id: check.id.clone(), ask: check.ask.clone() })
        .map(|question| serde_json::to_string(&question).unwrap() + "\n")
        .collect();
    let mut program = Command::new(env!("CARGO_BIN_EXE_solution"))
        .arg("probe")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = program.stdin.take().unwrap();
    let writer = std::thread::spawn(move || stdin.write_all(questions.as_bytes()));
    let output = program.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// What is wrong with a reply, if anything.
fn wrong(check: &Check, reply: &Reply) -> Option<String> {
    let expected = match of_check(check) {
        Ok(expected) => expected,
        Err(why) => return Some(why),
    };
    let is_right = match allowed::distance(&expected.answer, &reply.answer) {
        Some(distance) => distance <= expected.allowed,
        None => expected.either,
    };
    (!is_right || reply.id != check.id).then(|| format!("{}: {:?}, not {:?}", check.id, reply.answer, expected))
}

#[test]
fn the_solution_answers_every_check() {
    let stages_dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/stages");
    let stages = stage::load_all(&stages_dir).unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let checks: Vec<Check> = stages.into_iter().flat_map(|stage| stage.checks).collect();
    let replies = replies(&checks);
    assert_eq!(replies.len(), checks.len());
    let wrong: Vec<String> = checks.iter().zip(&replies).filter_map(|(check, reply)| wrong(check, reply)).collect();
    assert!(wrong.is_empty(), "{} of {} are wrong:\n{}", wrong.len(), checks.len(), wrong.join("\n"));
}
