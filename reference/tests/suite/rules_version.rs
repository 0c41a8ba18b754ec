//! Tests that a change of the reference's answers raises `RULES_VERSION`, so that stored answers of
//! the version before are refused.

use std::fs;
use std::path::{Path, PathBuf};

use cases::Course;
use cases::answer::RULES_VERSION;
use cases::stage;
use pages::say;
use reference::expect::{self, Progress, Set};
use sha2::{Digest, Sha256};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

struct Unwatched;

impl Progress for Unwatched {
    fn step(&self) {}

    fn is_stopped(&self) -> bool {
        false
    }
}

/// Returns a hash of the answers to the fixed questions, in the lecture and in every course that
/// differs from it in one key. The digests are left out, because they contain the version.
fn hash() -> String {
    let others = cases::course::deviations().into_iter().map(|deviation| deviation.course);
    let mut hasher = Sha256::new();
    for course in [Course::default()].into_iter().chain(others) {
        let stages = stage::load_all(&data("rules"), &course)
            .unwrap_or_else(|problems| panic!("{problems}"));
        let set = Set::new(stages, &course);
        let answers = expect::of_set(&data("rules"), &set, |_| true, &Unwatched)
            .unwrap_or_else(|why| panic!("{}", say::chain(&why)));
        for case in &answers.cases {
            hasher.update(format!("{:?} {:?}", case.answer, case.wrong));
        }
        for check in set.stages.iter().flat_map(|stage| &stage.checks) {
            let answer = expect::of_check(check, &course)
                .unwrap_or_else(|why| panic!("{}", say::chain(&why)));
            hasher.update(format!(
                "{:?} {} {} {:?}",
                answer.answer,
                answer.allowed,
                !answer.also.is_empty(),
                answer.wrong
            ));
        }
    }
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Each line of the file has a version of the rules and the hash of its answers. `BLESS=1` adds the
/// line of a new version, and never changes a line.
#[test]
fn other_answers_have_another_version() {
    let path = data("rules_versions.txt");
    let stored = || fs::read_to_string(&path).unwrap_or_default();
    let current = format!("{RULES_VERSION} {}", hash());
    let of_version =
        |text: &str| text.lines().any(|line| line.starts_with(&format!("{RULES_VERSION} ")));
    if std::env::var_os("BLESS").is_some() && !of_version(&stored()) {
        fs::write(&path, stored() + &current + "\n").unwrap();
    }
    let stored = stored();
    assert!(
        of_version(&stored),
        "version {RULES_VERSION} of the rules is new: BLESS=1 stores the hash of its answers"
    );
    assert!(
        stored.lines().any(|line| line == current),
        "the answers differ from those of version {RULES_VERSION} of the rules: raise \
            `RULES_VERSION` in cases/src/answer/digest.rs, then BLESS=1 stores the new hash"
    );
}
