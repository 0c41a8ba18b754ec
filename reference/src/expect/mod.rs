//! The stored answers: what the files beside the cases must hold. Nothing here writes; `reference expect` does.

pub mod allowed;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use cases::answer::{self, CheckAnswer, ImageAnswer};
use cases::film::{self, Image};
use cases::probe::Answer;
use cases::stage::{Case, Check, Stage};

use crate::answers;
use crate::render::{self, Options};
use crate::rules::Lecture;
use crate::world::World;

/// A channel may be off by this many 8-bit levels.
const SLACK: f64 = 1.0;
/// This share of the pixels may be out.
const OUT_SHARE: f64 = 0.005;
/// Relative error of an answer on paper against the reference in double precision.
const PAPER: f64 = 1e-12;

/// A file as it is to be stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Where.
    pub path: PathBuf,
    /// What.
    pub bytes: Vec<u8>,
}

impl Expected {
    /// Whether exactly this is stored.
    pub fn is_stored(&self) -> bool {
        std::fs::read(&self.path).is_ok_and(|stored| stored == self.bytes)
    }
}

/// The picture of a case, by the rules of the lecture, in f64.
pub fn picture(case: &Case) -> Image {
    let world = World::<f64>::new(&case.scene);
    render::render(&world, Lecture, &Options::of(&world), |_| {}).0
}

/// The answer file of a case, and the picture for people.
///
/// # Errors
/// What the encoders say.
pub fn of_case(stages: &Path, case: &Case) -> Result<Vec<Expected>, film::PictureError> {
    let expected = picture(case);
    let n_pixels = f64::from(expected.width()) * f64::from(expected.height());
    let png = film::encode(film::Kind::Png, &expected)?;
    let exr = ImageAnswer::exact(expected, SLACK, (n_pixels * OUT_SHARE) as u32).encode(&[])?;
    Ok(vec![
        Expected { path: answer::image_answer_path(stages, &case.id), bytes: exr },
        Expected { path: answer::expected_png_path(stages, &case.id), bytes: png },
    ])
}

/// The answers to the unit checks of a stage; `None` where it has none.
///
/// # Errors
/// A sentence for every check that is ill posed, or whose answer on paper is not the reference's.
pub fn of_checks(stages: &Path, stage: &Stage) -> Result<Option<Expected>, Vec<String>> {
    if stage.checks.is_empty() {
        return Ok(None);
    }
    let (mut answers, mut wrong) = (Vec::new(), Vec::new());
    for check in &stage.checks {
        match of_check(check) {
            Ok(answer) => answers.push(answer),
            Err(why) => wrong.push(why),
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let text = answer::check_answers_to_string(&answers).map_err(|why| vec![why.to_string()])?;
    Ok(Some(Expected { path: answer::check_answers_path(stages, &stage.id), bytes: text.into_bytes() }))
}

/// The answer to one check: the author's where there is one and it is right, else the reference's.
///
/// # Errors
/// Why the check cannot stand as it is.
pub fn of_check(check: &Check) -> Result<CheckAnswer, String> {
    let ours = answers::answer(Lecture, &check.ask);
    if let Answer::Panic(why) = &ours {
        return Err(format!("{}: the question cannot be answered: {why}", check.id));
    }
    let allowance = allowed::allowance(&check.ask, &ours)
        .map_err(|why| format!("{}: {why}; choose numbers farther from the edge", check.id))?;
    if let Some(paper) = &check.paper {
        let scale =
            allowed::numbers(paper).into_iter().filter(|n| n.is_finite()).fold(1.0, |most, n| n.abs().max(most));
        let double = allowance.allowed * f64::from(f32::EPSILON); // the same roundings, of 2⁻⁵³ in the place of 2⁻²⁴, with room
        let agrees = allowed::distance(paper, &ours).is_some_and(|distance| distance <= PAPER * scale + double);
        if !agrees {
            return Err(format!(
                "{}: on paper the answer is {}, the reference has {}",
                check.id,
                json(paper),
                json(&ours)
            ));
        }
    }
    Ok(CheckAnswer {
        id: check.id.clone(),
        answer: check.paper.clone().unwrap_or(ours),
        allowed: allowance.allowed,
        either: allowance.either,
        wrong: BTreeMap::new(),
    })
}

fn json(answer: &Answer) -> String {
    serde_json::to_string(answer).unwrap_or_else(|why| why.to_string())
}
