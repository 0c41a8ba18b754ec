//! A single stored answer, named by the path of its file.

use std::path::{Path, PathBuf};

use cases::answer::{AnswerError, ImageAnswer, load};
use cases::course;
use cases::problem::Problems;
use cases::stage::load_all;

use super::Subject;
use super::faults::command;
use crate::blame::{self, Blame};

/// The ending of the name of an answer.
const ENDING: &str = ".answer.exr";

/// The reason why the answer in a file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SingleError {
    /// The path is not that of a file with a stored answer.
    #[error("{}: a stored answer is a file that is called STAGES/STAGE/CASE{ENDING}", .0.display())]
    Name(PathBuf),
    /// There is no case beside the answer, so nothing shows what it is the answer to.
    #[error("{}: there is no case {} beside it, so nothing shows that the answer is \
        current", answer.display(), case.display())]
    NoCase {
        /// The answer.
        answer: PathBuf,
        /// The file of its case.
        case: PathBuf,
    },
    /// The stages around the answer cannot be understood.
    #[error("{0}")]
    Cases(#[from] Problems),
    /// The answer is missing, stale or broken.
    #[error("{}: {source}\nhelp: `{renewal}` renews it", path.display())]
    Untrusted {
        /// The answer.
        path: PathBuf,
        /// The command that renews it.
        renewal: String,
        /// The fault of the answer.
        source: AnswerError,
    },
}

impl SingleError {
    /// Returns the party to blame: the machine if it fails to read a file.
    pub fn blame(&self) -> Blame {
        if let Self::Cases(problems) = self {
            blame::of_problems(problems)
        } else {
            blame::of(self)
        }
    }
}

/// Returns the answer in the file at `path`, if it belongs to the case that lies beside it.
///
/// # Errors
/// See [`SingleError`].
pub fn stored_answer(path: &Path) -> Result<ImageAnswer, SingleError> {
    // The case lies beside the file that a link leads to.
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let not_an_answer = || SingleError::Name(path.to_owned());
    let name =
        path.file_name().and_then(|name| name.to_str()).and_then(|name| name.strip_suffix(ENDING));
    let name = name.ok_or_else(not_an_answer)?;
    if path.exists() && !path.is_file() {
        return Err(not_an_answer());
    }
    let case_path = path.with_file_name(format!("{name}.toml"));
    let whole = case_path.canonicalize().ok();
    let Some((stage, stages)) = whole.as_deref().and_then(folders) else {
        return Err(SingleError::NoCase { answer: path.to_owned(), case: case_path });
    };
    let course = course::course_of(&stages)?;
    let id = format!("{stage}/{name}");
    let all = load_all(&stages, &course)?;
    let mut cases =
        all.iter().flat_map(|stage| stage.cases.iter().map(move |case| (stage.base, case)));
    let (base, case) = cases.find(|(_, case)| case.id == id).ok_or_else(not_an_answer)?;
    load::image(&stages, &course, base, case).map_err(|source| SingleError::Untrusted {
        path: path.to_owned(),
        renewal: command(&stages, &[&Subject::Case(id)]),
        source,
    })
}

/// Returns the name of the stage of a case and the folder of the stages.
fn folders(case: &Path) -> Option<(String, PathBuf)> {
    let stage = case.parent()?;
    Some((stage.file_name()?.to_str()?.to_owned(), stage.parent()?.to_owned()))
}
