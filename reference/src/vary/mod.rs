//! Varied cases: the numbers of a case are changed within the bounds of its `[vary]`, so that
//! nothing can be hard-coded.
//!
//! A draw is accepted only if the case stays as telling and as fair as its original; otherwise the
//! case is drawn again. The same seed gives the same bytes on every machine. The draws of one case
//! do not depend on those of another.

mod accept;
mod assets;
mod decimal;
mod edit;
mod error;
pub mod folder;

use std::path::{Path, PathBuf};

use cases::stage::{self, Bounds, Case};
use cases::{Course, Effects};
use toml_edit::DocumentMut;

use crate::expect::Set;
use crate::numbers::stream::Stream;
pub use accept::{Care, MOST_DRAWS, Refusal};
use accept::{Measured, Shows};
pub use assets::{Asset, take_along};
pub use edit::EditError;
pub use error::VaryError;

/// A case from which varied cases are made.
#[derive(Clone, Debug)]
pub struct Original {
    case: Case,
    bounds: Bounds,
    path: PathBuf,
    document: DocumentMut,
    shows: Shows,
    /// The index of the stage.
    stage: usize,
}

/// A varied case.
#[derive(Clone, Debug)]
pub struct Varied {
    /// The text of the file.
    pub text: String,
    /// The mesh files that the case needs.
    pub assets: Vec<Asset>,
    /// The case that the file resolves to.
    pub case: Case,
    /// The number of draws up to the accepted one.
    pub n_draws: u32,
    /// The share of pixels that show what the stage adds. In the first stage, pixels that differ
    /// from the background.
    pub shows: f64,
    /// The share of contested pixels; `None` with [`Care::Quick`].
    pub contested: Option<f64>,
}

/// Returns `case` of the lecture's course with its numbers changed once under `seed`. The file of
/// the case at `path` has the contents `text`. The result may be less telling than the original.
///
/// # Errors
/// The case has no `[vary]`, a number has too many digits, or the result is not a valid case.
pub fn draw_any(
    case: &Case,
    path: &Path,
    text: &str,
    allows: Effects,
    seed: u64,
) -> Result<Case, VaryError> {
    let id = &case.id;
    let bounds = case.bounds.as_ref().ok_or_else(|| VaryError::NoBounds { id: id.clone() })?;
    let mut document = parsed(id, text)?;
    edit::jitter(&mut document, bounds, &mut Stream::new(seed, id))
        .map_err(|source| VaryError::Number { id: id.clone(), source })?;
    let stage = id.split('/').next().unwrap_or_default();
    Ok(stage::parse_case(path, &document.to_string(), stage, allows, &Course::default())?)
}

fn parsed(id: &str, text: &str) -> Result<DocumentMut, VaryError> {
    text.parse().map_err(|source| VaryError::Toml { id: id.to_owned(), source })
}

impl Original {
    /// Returns the case of the stage with index `n` of `set`, prepared for varying. The file of the
    /// case at `path` has the contents `text`. The case is rendered a few dozen times.
    ///
    /// # Errors
    /// The case has no `[vary]`, one of its keys changes nothing, or a number has too many digits.
    pub fn new(
        set: &Set,
        n: usize,
        case: &Case,
        path: &Path,
        text: &str,
    ) -> Result<Self, VaryError> {
        let id = &case.id;
        let bounds = case.bounds.clone().ok_or_else(|| VaryError::NoBounds { id: id.clone() })?;
        let document = parsed(id, text)?;
        let moved = edit::jitter(&mut document.clone(), &bounds, &mut Stream::new(0, id))
            .map_err(|source| VaryError::Number { id: id.clone(), source })?;
        let keys = document["vary"]
            .as_table_like()
            .into_iter()
            .flat_map(|table| table.iter())
            .map(|(key, _)| key);
        if let Some(key) = keys.into_iter().find(|key| *key != "keep" && !moved.contains_key(key)) {
            return Err(VaryError::IdleKey { id: id.clone(), key: key.to_owned() });
        }
        if moved.is_empty() {
            return Err(VaryError::Idle { id: id.clone() });
        }
        let shows = Shows::of(set, n, case);
        Ok(Self { case: case.clone(), bounds, path: path.to_owned(), document, shows, stage: n })
    }

    /// Returns the id of the case.
    pub fn id(&self) -> &str {
        &self.case.id
    }

    /// Returns the share of the case's pixels that show what its stage adds.
    pub fn shows(&self) -> f64 {
        self.shows.effect
    }

    /// Returns the case under `seed`: the first draw that is as telling and as fair as the
    /// original, in the same `set`.
    ///
    /// # Errors
    /// The reasons for which none of [`MOST_DRAWS`] draws was accepted, or a number with too many
    /// digits.
    pub fn vary(&self, set: &Set, seed: u64, care: Care) -> Result<Varied, VaryError> {
        let id = &self.case.id;
        let mut stream = Stream::new(seed, id);
        let mut refusals: Vec<(Refusal, usize)> = Vec::new();
        for n_draws in 1..=MOST_DRAWS {
            let mut document = self.document.clone();
            edit::jitter(&mut document, &self.bounds, &mut stream)
                .map_err(|source| VaryError::Number { id: id.clone(), source })?;
            document.remove("vary");
            match self.accept(set, &document.to_string(), care) {
                Ok((case, Measured { effect, contested })) => {
                    let assets = take_along(&mut document);
                    let text = format!("# {id} with seed {seed}, by `reference vary`.\n{document}");
                    return Ok(Varied { text, assets, case, n_draws, shows: effect, contested });
                }
                Err(refusal) => {
                    match refusals.iter_mut().find(|(known, _)| known.is_like(&refusal)) {
                        Some((_, n)) => *n += 1,
                        None => refusals.push((refusal, 1)),
                    }
                }
            }
        }
        Err(VaryError::Refused { id: id.clone(), seed, refusals })
    }

    /// Returns the case that a draw resolves to, if it is accepted, and its measured shares.
    fn accept(&self, set: &Set, text: &str, care: Care) -> Result<(Case, Measured), Refusal> {
        let stage = &set.stages[self.stage];
        let parsed = stage::parse_case(&self.path, text, &stage.id, stage.allows, &set.course);
        let case = parsed.map_err(|problems| {
            let first = problems.iter().next().map(|problem| problem.message.clone());
            Refusal::Invalid(first.unwrap_or_default())
        })?;
        let measured = self.shows.kept_by(set, &self.case, &case, care)?;
        Ok((case, measured))
    }
}
