//! Digests of the inputs of stored answers: an answer is trusted only if it belongs to its case.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::course::{Course, DECISIONS};
use crate::probe::{Answer, Ask};
use crate::scene::Scene;
use crate::stage::{Base, Case, Check};

/// The version of the rules of light by which the reference makes answers.
///
/// The version rises with every change after which the reference gives another answer to the same
/// case: a formula, a legal variation, a known mistake, a weight, a limit.
pub const RULES_VERSION: u32 = 3;

/// A digest of everything that an answer was made from.
///
/// It covers the version of the rules, the choices of the course, and the resolved scene or
/// question with its meshes. Titles and descriptions are excluded, so that a changed word makes no
/// answer stale. The default is an empty digest, which no computed digest equals.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Digest(String);

/// The content of a digest, hashed as JSON, which keeps every bit of all numbers.
#[derive(Serialize)]
struct Made<'a, T> {
    rules: u32,
    course: Vec<(&'static str, String)>,
    what: &'a str,
    from: T,
}

impl Digest {
    /// Returns the digest of the answer to an image case. `base` is that of the case's stage.
    pub fn of_case(course: &Course, base: Base, case: &Case) -> Self {
        let from: (Base, &Scene) = (base, &case.scene);
        Self::of(course, "case", from)
    }

    /// Returns the digest of the answer to a unit check.
    pub fn of_check(course: &Course, check: &Check) -> Self {
        let from: (&Ask, Option<&Answer>) = (&check.ask, check.paper.as_ref());
        Self::of(course, "check", from)
    }

    /// Returns the digest of the list of known mistakes.
    pub fn of_mistakes(course: &Course) -> Self {
        Self::of(course, "mistakes", ())
    }

    fn of(course: &Course, what: &str, from: impl Serialize) -> Self {
        let keys = DECISIONS.iter().map(|decision| decision.key);
        let made =
            Made { rules: RULES_VERSION, course: keys.zip(course.written()).collect(), what, from };
        let mut hasher = blake3::Hasher::new();
        serde_json::to_writer(&mut hasher, &made)
            .expect("scenes and answers have only string keys");
        Self(hasher.finalize().to_hex()[..32].to_owned())
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
