//! The public exam with the layers of all mistakes, ready to diagnose rendered pictures.

use std::path::Path;

use cases::answer::{CheckAnswer, ImageAnswer, Wrong, image_answer_path};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::probe::Answer;
use cases::scene::Scene;
use cases::stage::{Case, Check};
use grader::diagnose::{Explanation, Reply, Sheet, confirm, diagnose};
use grader::exam::Exam;
use grader::judge::{self, Judgement};
use grader::record::{FindingKind, Verdict};
use rayon::prelude::*;
use reference::expect::students_picture;
use reference::rules::Rules;
use reference::rules::misconceptions;

use super::combinations::parts;

/// An exam and the sheets of its cases.
#[derive(Debug)]
pub struct Desk {
    /// The exam.
    pub exam: Exam,
    /// The sheets, in the order of the cases.
    sheets: Vec<Sheet>,
}

impl Desk {
    /// Reads the exam below `stages`.
    ///
    /// # Errors
    /// Returns an error if the stages or a stored answer cannot be read.
    pub fn open(stages: &Path) -> Result<Self, String> {
        let exam = Exam::load(stages).map_err(|problems| problems.to_string())?;
        let sheets = pictured(&exam).map(|(case, answer)| {
            let path = image_answer_path(&exam.folder, &case.id);
            let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
            let bytes = std::fs::read(&path).map_err(|why| wrong(&why))?;
            let size = case.scene.render;
            let layers = Wrong::decode_all(&bytes, size.width, size.height);
            Ok(Sheet::new(&case.id, answer, &layers.map_err(|why| wrong(&why))?))
        });
        let sheets = sheets.collect::<Result<_, String>>()?;
        Ok(Self { exam, sheets })
    }

    /// Returns the cases with their answers, in order.
    pub fn cases(&self) -> impl Iterator<Item = (&Case, &ImageAnswer)> {
        pictured(&self.exam)
    }

    /// Returns the pictures of all cases by a student's program under `rules`, in bytes.
    pub fn render(&self, rules: &Rules) -> Vec<Image> {
        let scenes: Vec<&Scene> = self.cases().map(|(case, _)| &case.scene).collect();
        scenes.par_iter().map(|scene| in_bytes(&students_picture(scene, rules))).collect()
    }

    /// Returns the diagnosis of a program with these pictures, in the order of the cases. `reply`
    /// gives its answers to the unit checks, `None` for one that it does not answer.
    pub fn explain(
        &self,
        pictures: &[Image],
        reply: impl Fn(&Check, &CheckAnswer) -> Option<Answer>,
    ) -> Explanation {
        let judged = self.evidence(pictures);
        let judged: Vec<(&Sheet, &Image)> =
            judged.into_iter().map(|(_, sheet, actual)| (sheet, actual)).collect();
        let checks = self.exam.stages.iter().flat_map(|one| {
            one.stage.checks.iter().map(move |check| (check, &one.units[&check.id]))
        });
        let replies = checks.filter_map(|(check, right)| {
            let actual = reply(check, right)?;
            let judgement = judge::unit(&actual, right, check.ask.function());
            let is_right = judgement.verdict == Verdict::Pass;
            is_evidence(&judgement).then(|| Reply::new(&check.id, is_right, &actual, right))
        });
        diagnose(&judged, replies.collect(), &self.exam.mistakes)
    }

    /// Returns the explanation of these pictures after the named mistakes are rendered together.
    pub fn confirm(&self, pictures: &[Image], explanation: Explanation) -> Explanation {
        let judged = self.evidence(pictures);
        let (scenes, judged): (Vec<&Scene>, Vec<(&Sheet, &Image)>) =
            judged.into_iter().map(|(case, sheet, actual)| (&case.scene, (sheet, actual))).unzip();
        let known = misconceptions::of(&Rules::LECTURE);
        let render = |at: usize, ids: &[&str]| {
            let made = known.iter().copied().filter(|one| ids.contains(&one.id));
            let rules = parts(&made.collect::<Vec<_>>());
            Some(in_bytes(&students_picture(scenes[at], &rules)))
        };
        confirm(&judged, explanation, &self.exam.mistakes, &render)
    }

    /// Returns the pictures that are evidence, each with its case and sheet.
    fn evidence<'a>(&'a self, pictures: &'a [Image]) -> Vec<(&'a Case, &'a Sheet, &'a Image)> {
        self.cases()
            .zip(&self.sheets)
            .zip(pictures)
            .filter(|(((_, answer), _), actual)| is_evidence(&judge::picture(actual, answer)))
            .map(|(((case, _), sheet), actual)| (case, sheet, actual))
            .collect()
    }
}

/// Returns the cases of an exam with their answers, in order.
fn pictured(exam: &Exam) -> impl Iterator<Item = (&Case, &ImageAnswer)> {
    exam.stages.iter().flat_map(|one| {
        let cases = one.stage.cases.iter();
        cases.filter_map(move |case| Some((case, one.images.get(&case.id)?)))
    })
}

/// Returns whether a judgement is evidence for a diagnosis: right, or wrong and no remark of
/// another kind.
fn is_evidence(judgement: &Judgement) -> bool {
    let kind = judgement.finding.as_ref().map(|finding| finding.kind);
    match judgement.verdict {
        Verdict::Pass => matches!(kind, None | Some(FindingKind::Remark)),
        _ => kind == Some(FindingKind::Wrong),
    }
}

/// Returns a picture as a PNG file of 8 bits holds it.
pub fn in_bytes(image: &Image) -> Image {
    let pixel = |light: &DVec3| DVec3::from(light.to_array().map(|x| f64::from(byte(x)))) / 255.0;
    let pixels = image.pixels().iter().map(pixel).collect();
    Image::from_pixels(image.width(), image.height(), pixels).expect("as many pixels as before")
}

/// Returns the ids that an explanation names, those of one diagnosis together.
pub fn names(explanation: &Explanation) -> Vec<Vec<&str>> {
    let ids = explanation.diagnoses.iter();
    ids.map(|one| one.mistakes.iter().map(|mistake| mistake.id.as_str()).collect()).collect()
}
