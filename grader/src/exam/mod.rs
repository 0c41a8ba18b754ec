//! The cases and their answers, read once and shared by all submissions.

mod faults;
mod fronts;
mod single;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use cases::answer::{
    CheckAnswer, Digest, ImageAnswer, Mistake, check_answers_path, image_answer_path, load,
    mistakes_path,
};
use cases::course::{self, Course};
use cases::front::Fronts;
use cases::problem::Problems;
use cases::stage::{Stage, load_all};

pub use faults::{Fault, Subject, Untrusted};
pub use fronts::FrontsError;
pub use single::{SingleError, stored_answer};

/// All stages, with all answers that can be trusted.
#[derive(Debug)]
pub struct Exam {
    /// The folder of the stages.
    pub folder: PathBuf,
    /// The course of the folder.
    pub course: Course,
    /// The stages, in order.
    pub stages: Vec<Questions>,
    /// The mistakes that a diagnosis may name; none where the list cannot be trusted.
    pub mistakes: Vec<Mistake>,
    /// The questions without an answer that can be trusted.
    pub faults: Vec<Fault>,
    /// Ids of stored answers to unit checks that do not exist.
    pub surplus: Vec<String>,
    /// The measured cost of accuracy, `None` if it was not measured, or why it cannot be read.
    pub fronts: Result<Option<Fronts>, FrontsError>,
    /// Whether that cost was measured on other code or cases than those around the folder.
    pub fronts_are_old: bool,
    /// A hash of everything in the folder that a score depends on. Titles, descriptions and times
    /// do not count.
    pub hash: String,
}

/// A stage, with all of its answers that can be trusted.
#[derive(Clone, Debug)]
pub struct Questions {
    /// The stage.
    pub stage: Stage,
    /// The answers to image cases, by id.
    pub images: BTreeMap<String, ImageAnswer>,
    /// The answers to unit checks, by id.
    pub units: BTreeMap<String, CheckAnswer>,
}

impl Exam {
    /// Reads the stages in `folder`, their course and their answers. An answer that is missing or
    /// belongs to another version of its case is a fault; [`Exam::trust`] refuses to judge without
    /// it.
    ///
    /// # Errors
    /// Returns everything that is wrong with the cases or the course.
    pub fn load(folder: &Path) -> Result<Self, Problems> {
        let course = course::course_of(folder)?;
        let stages = load_all(folder, &course)?;
        let hash = hash(folder, &course, &stages);
        let (mut faults, mut surplus) = (vec![], vec![]);
        let stages = stages
            .into_iter()
            .map(|stage| questions(folder, &course, stage, &mut faults, &mut surplus))
            .collect();
        let mistakes = load::mistakes(folder, &course)
            .map_err(|why| faults.push(Fault { subject: Subject::Mistakes, why }))
            .unwrap_or_default();
        let fronts = fronts::read(folder);
        let measured = fronts.as_ref().ok().and_then(Option::as_ref);
        let fronts_are_old = measured.is_some_and(|fronts| fronts::are_old(folder, fronts));
        Ok(Self {
            folder: folder.to_owned(),
            course,
            stages,
            mistakes,
            faults,
            surplus,
            fronts,
            fronts_are_old,
            hash,
        })
    }

    /// Demands that every question of the given ids, and the list of known mistakes, has an answer
    /// that can be trusted.
    ///
    /// # Errors
    /// Returns [`Untrusted`], which names the answers that cannot be trusted and the command that
    /// renews them.
    pub fn trust<'a>(
        &'a self,
        ids: impl IntoIterator<Item = &'a str>,
    ) -> Result<(), Untrusted<'a>> {
        Untrusted::among(&self.folder, &self.faults, ids).map_or(Ok(()), Err)
    }

    /// Returns the command that renews the answer to `subject`.
    pub fn renewal(&self, subject: &Subject) -> String {
        faults::command(&self.folder, &[subject])
    }
}

fn questions(
    folder: &Path,
    course: &Course,
    stage: Stage,
    faults: &mut Vec<Fault>,
    surplus: &mut Vec<String>,
) -> Questions {
    let mut images = BTreeMap::new();
    for case in &stage.cases {
        match load::image(folder, course, stage.base, case) {
            Ok(answer) => drop(images.insert(case.id.clone(), answer)),
            Err(why) => faults.push(Fault { subject: Subject::Case(case.id.clone()), why }),
        }
    }
    let mut units = BTreeMap::new();
    match load::checks(folder, course, &stage) {
        Ok((answers, without_check)) => {
            surplus.extend(without_check);
            for (id, answer) in answers {
                match answer {
                    Ok(answer) => drop(units.insert(id, answer)),
                    Err(why) => faults.push(Fault { subject: Subject::Check(id), why }),
                }
            }
        }
        Err(why) => faults.push(Fault { subject: Subject::Checks(stage.id.clone()), why }),
    }
    Questions { stage, images, units }
}

/// Returns a hash of everything in `folder` that a score depends on.
///
/// The hash covers the points and rules of all questions, the digests of what their answers are
/// made from, and the bytes of all stored answers.
fn hash(folder: &Path, course: &Course, stages: &[Stage]) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut add = |parts: &[&[u8]]| {
        for part in parts {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
    };
    let mut files = vec![mistakes_path(folder)];
    for stage in stages {
        let (units, explained) = (stage.unit_points, stage.explained_share);
        add(&[stage.id.as_bytes(), &units.to_le_bytes(), &explained.to_le_bytes()]);
        files.push(check_answers_path(folder, &stage.id));
        for case in &stage.cases {
            let made_from = Digest::of_case(course, stage.base, case).to_string();
            add(&[
                case.id.as_bytes(),
                &case.points.to_le_bytes(),
                &case.rules,
                made_from.as_bytes(),
            ]);
            files.push(image_answer_path(folder, &case.id));
        }
        for check in &stage.checks {
            let made_from = Digest::of_check(course, check).to_string();
            add(&[check.id.as_bytes(), &check.rules, made_from.as_bytes()]);
        }
    }
    for file in files {
        // An answer that cannot be read is a fault, which is reported where it is needed.
        add(&[&load::bytes(&file).unwrap_or_default()]);
    }
    hasher.finalize().to_hex().to_string()
}
