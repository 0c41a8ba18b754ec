//! The questions and their answers, read once and shared by all submissions.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};

use cases::answer::{
    CheckAnswer, ImageAnswer, Mistake, check_answers_from_str, check_answers_path, image_answer_path,
    mistakes_from_str, mistakes_path,
};
use cases::front::{Fronts, fronts_from_str, fronts_path};
use cases::stage::{Case, Stage, load_all};

use crate::files;

/// All stages with all answers.
#[derive(Clone, Debug)]
pub struct Exam {
    /// The folder `stages`.
    pub folder: PathBuf,
    /// In order.
    pub stages: Vec<Questions>,
    /// The mistakes that a diagnosis may name, or why there is no such list.
    pub mistakes: Result<Vec<Mistake>, String>,
    /// What accuracy costs, if it was measured; or why that cannot be read.
    pub fronts: Result<Option<Fronts>, String>,
    /// Hash of all files in the folder that a score depends on.
    pub hash: String,
}

/// A stage and its answers. An answer that cannot be read is the reason why: what it was for is then nobody's fault.
#[derive(Clone, Debug)]
pub struct Questions {
    /// What is asked.
    pub stage: Stage,
    /// By id of the case.
    pub images: BTreeMap<String, Result<ImageAnswer, String>>,
    /// By id of the check.
    pub units: BTreeMap<String, CheckAnswer>,
    /// Why there are no answers to unit checks, if there are none.
    pub units_missing: Option<String>,
}

impl Exam {
    /// Reads the stages in `folder` and their answers.
    ///
    /// # Errors
    /// Everything that is wrong with the cases, ready to be shown.
    pub fn load(folder: &Path) -> Result<Self, String> {
        let stages = load_all(folder).map_err(|problems| problems.to_string())?;
        Self::new(folder, stages).map_err(|why| format!("{}: {why}", folder.display()))
    }

    /// Puts the answers that lie in `folder` to the stages that were read from it.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn new(folder: &Path, stages: Vec<Stage>) -> std::io::Result<Self> {
        let hash = hash(folder)?;
        let stages = stages.into_iter().map(|stage| questions(folder, stage)).collect();
        let mistakes = stored("the known mistakes", &mistakes_path(folder), mistakes_from_str);
        let fronts = match fronts_path(folder) {
            path if path.exists() => stored("what accuracy costs", &path, fronts_from_str).map(Some),
            _ => Ok(None),
        };
        Ok(Self { folder: folder.to_owned(), stages, mistakes, fronts, hash })
    }
}

/// What lies in the file at `path`.
fn stored<T, E: Display>(what: &str, path: &Path, parse: impl Fn(&str) -> Result<T, E>) -> Result<T, String> {
    let wrong = |why: &dyn Display| format!("{what} {} cannot be used: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|why| wrong(&why))?;
    parse(&text).map_err(|why| wrong(&why))
}

fn questions(folder: &Path, stage: Stage) -> Questions {
    let images = stage.cases.iter().map(|case| (case.id.clone(), image(folder, case))).collect();
    let (units, units_missing) = match units(folder, &stage) {
        Ok(units) => (units, None),
        Err(why) => (BTreeMap::new(), Some(why)),
    };
    Questions { stage, images, units, units_missing }
}

fn image(folder: &Path, case: &Case) -> Result<ImageAnswer, String> {
    let path = image_answer_path(folder, &case.id);
    let wrong = |why: &dyn std::fmt::Display| format!("the stored answer {} cannot be used: {why}", path.display());
    let bytes = std::fs::read(&path).map_err(|why| wrong(&why))?;
    ImageAnswer::decode(&bytes, case.scene.render.width, case.scene.render.height).map_err(|why| wrong(&why))
}

fn units(folder: &Path, stage: &Stage) -> Result<BTreeMap<String, CheckAnswer>, String> {
    if stage.checks.is_empty() {
        return Ok(BTreeMap::new());
    }
    let path = check_answers_path(folder, &stage.id);
    let wrong = |why: &dyn std::fmt::Display| format!("the stored answers {} cannot be used: {why}", path.display());
    let text = std::fs::read_to_string(&path).map_err(|why| wrong(&why))?;
    let answers = check_answers_from_str(&text).map_err(|why| wrong(&why))?;
    Ok(answers.into_iter().map(|answer| (answer.id.clone(), answer)).collect())
}

/// No score depends on what accuracy costs: times differ from machine to machine.
fn hash(folder: &Path) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    let unscored = fronts_path(folder);
    for file in files::below(folder)?.into_iter().filter(|file| *file != unscored) {
        let name = file.strip_prefix(folder).unwrap_or(&file);
        let bytes = std::fs::read(&file)?;
        hasher.update(name.as_os_str().as_encoded_bytes()).update(&[0]);
        hasher.update(&(bytes.len() as u64).to_le_bytes()).update(&bytes);
    }
    Ok(hasher.finalize().to_hex().to_string())
}
