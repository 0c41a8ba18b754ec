//! Tests that `docs/protocol.md` is correct: its examples parse, its answers are right, and no
//! question is missing.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use cases::probe::{Question, Reply};
use cases::scene::json;
use cases::stage;
use reference::expect::allowed::Allowance;
use reference::rules::Lecture;
use reference::trace::answers::answer;

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn page() -> String {
    std::fs::read_to_string(root("docs/protocol.md")).unwrap()
}

/// Returns the text of every block that opens with ```` ```KIND ````.
fn blocks(page: &str, kind: &str) -> Vec<String> {
    let opening = format!("```{kind}\n");
    page.split(&opening).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Returns the lines of all examples, with the scene substituted for its name.
fn lines() -> Vec<String> {
    let page = page();
    let scene: serde_json::Value = serde_json::from_str(&blocks(&page, "json scene")[0]).unwrap();
    let blocks = blocks(&page, "json");
    blocks
        .iter()
        .flat_map(|block| block.lines())
        .map(|line| line.replace("SCENE", &scene.to_string()))
        .collect()
}

fn questions() -> Vec<(Question, Reply)> {
    let lines = lines();
    let ask = |line: &String| line.contains("\"fn\":").then(|| serde_json::from_str(line).unwrap());
    let at = |n: usize| Some((ask(&lines[n])?, serde_json::from_str(&lines[n + 1]).unwrap()));
    (0..lines.len()).filter_map(at).collect()
}

#[test]
fn every_line_is_a_question_or_a_reply() {
    let (questions, replies): (Vec<_>, Vec<_>) =
        lines().into_iter().partition(|line| line.contains("\"fn\":"));
    for line in &questions {
        serde_json::from_str::<Question>(line).unwrap_or_else(|why| panic!("{line}: {why}"));
    }
    for line in &replies {
        serde_json::from_str::<Reply>(line).unwrap_or_else(|why| panic!("{line}: {why}"));
    }
    assert!(questions.len() > 20 && replies.len() > questions.len());
}

#[test]
fn every_example_is_answered_right() {
    for (question, reply) in questions() {
        assert_eq!(question.id, reply.id);
        let right = answer(Lecture, &question.ask);
        let is_right = Allowance { allowed: 1e-12, also: vec![] }.takes(&right, &reply.answer);
        assert!(is_right, "{}: {right:?}", question.id);
    }
}

#[test]
fn every_function_that_is_asked_is_described() {
    let described: BTreeSet<&str> =
        questions().iter().map(|(question, _)| question.ask.function()).collect();
    let stages = stage::load_all(&root("cases/stages"), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let asked =
        stages.iter().flat_map(|stage| &stage.checks).map(|check| check.ask.function()).collect();
    assert_eq!(described, asked);
}

#[test]
fn the_scene_is_one_and_has_all_keys() {
    let text = &blocks(&page(), "json scene")[0];
    let scene = json::from_str(text).unwrap();
    let keys = |text: &str| {
        let words = text.split('"').skip(1).step_by(2).map(str::to_owned);
        words.collect::<BTreeSet<String>>()
    };
    assert_eq!(keys(text), keys(&json::to_string(&scene)));
}
