//! Other cases of the same kind: the numbers of a case moved within the bounds of its `[vary]`, so that nothing can be hard-coded.
//!
//! A draw counts only where the case stays as telling and as fair as it was; else it is drawn again. The same seed gives the same
//! bytes on every machine, and the draws of one case do not depend on those of another.

mod accept;
mod assets;
mod decimal;
mod edit;
pub mod folder;
mod stream;

use std::path::{Path, PathBuf};

use cases::Effects;
use cases::stage::{self, Bounds, Case, Stage};
use toml_edit::DocumentMut;

use crate::rules::Rules;
use accept::{Refusal, Shows};
pub use assets::{Asset, take_along};
use stream::Stream;

/// So many draws that will not do are enough: the bounds are too wide.
pub const MOST_DRAWS: u32 = 50;

/// A case from which others are made.
#[derive(Clone, Debug)]
pub struct Original {
    case: Case,
    bounds: Bounds,
    path: PathBuf,
    document: DocumentMut,
    /// Id of its stage, and the effects that it allows.
    stage: (String, Effects),
    shows: Shows,
}

/// A case made from another.
#[derive(Clone, Debug)]
pub struct Varied {
    /// The file.
    pub text: String,
    /// The mesh files that it needs.
    pub assets: Vec<Asset>,
    /// What it resolves to.
    pub case: Case,
    /// How often it was drawn.
    pub n_draws: u32,
    /// The share of its pixels that show what its stage adds; in the first stage, anything but background.
    pub shows: f64,
}

impl Original {
    /// The case of `stage` whose file at `path` holds `text`; `before` is what the stage before it allows,
    /// `rules` are the course's. Renders it a few dozen times.
    ///
    /// # Errors
    /// A case without bounds, or a key of them that moves nothing.
    pub fn new(
        case: &Case,
        stage: &Stage,
        before: Option<Effects>,
        rules: &Rules,
        path: &Path,
        text: &str,
    ) -> Result<Self, String> {
        let id = &case.id;
        let bounds = case.bounds.clone().ok_or_else(|| {
            format!("{id} does not say how far its numbers may be moved: add a table `[vary]` (docs/scene-format.md)")
        })?;
        let document: DocumentMut = text.parse().map_err(|why| format!("{id}: {why}"))?;
        let moved = edit::jitter(&mut document.clone(), &bounds, &mut Stream::new(0, id))
            .map_err(|why| format!("{id}: {why}"))?;
        let idle: Vec<_> = document["vary"]
            .as_table_like()
            .into_iter()
            .flat_map(|table| table.iter())
            .map(|(key, _)| key)
            .filter(|key| *key != "keep" && !moved.contains_key(key))
            .collect();
        if let Some(key) = idle.first() {
            return Err(format!("{id}: in `[vary]`, `{key}` moves nothing that stands in the file: leave it out"));
        }
        if moved.is_empty() {
            return Err(format!("{id}: in `[vary]`, no key moves anything: add one (docs/scene-format.md)"));
        }
        let added = before.map_or(vec![], |before| stage.allows.iter().filter(|effect| !before.has(*effect)).collect());
        let shows = Shows::of(case, added, rules);
        Ok(Self {
            case: case.clone(),
            bounds,
            path: path.to_owned(),
            document,
            stage: (stage.id.clone(), stage.allows),
            shows,
        })
    }

    /// Id of the case.
    pub fn id(&self) -> &str {
        &self.case.id
    }

    /// The share of its pixels that show what its stage adds.
    pub fn shows(&self) -> f64 {
        self.shows.effect
    }

    /// The case under `seed`: the first draw that is as telling and as fair as the original.
    ///
    /// # Errors
    /// Why none of [`MOST_DRAWS`] was.
    pub fn vary(&self, seed: u64) -> Result<Varied, String> {
        let mut stream = Stream::new(seed, &self.case.id);
        let mut refusals: Vec<(Refusal, usize)> = Vec::new();
        for n_draws in 1..=MOST_DRAWS {
            match self.draw(seed, &mut stream)? {
                Ok(varied) => return Ok(Varied { n_draws, ..varied }),
                Err(refusal) => match refusals.iter_mut().find(|(known, _)| known.is_like(&refusal)) {
                    Some((_, n)) => *n += 1,
                    None => refusals.push((refusal, 1)),
                },
            }
        }
        let reasons: Vec<String> = refusals.iter().map(|(refusal, n)| format!("\n  {n} times {refusal}")).collect();
        Err(format!(
            "{}: with seed {seed} none of {MOST_DRAWS} draws will do; make its `[vary]` narrower{}",
            self.case.id,
            reasons.concat()
        ))
    }

    /// One draw, and whether it will do.
    fn draw(&self, seed: u64, stream: &mut Stream) -> Result<Result<Varied, Refusal>, String> {
        let mut document = self.document.clone();
        edit::jitter(&mut document, &self.bounds, stream).map_err(|why| format!("{}: {why}", self.case.id))?;
        document.remove("vary");
        let (stage, allows) = &self.stage;
        let case = match stage::parse_case(&self.path, &document.to_string(), stage, *allows) {
            Ok(case) => case,
            Err(problems) => {
                let first = problems.iter().next().map(|problem| problem.message.clone()).unwrap_or_default();
                return Ok(Err(Refusal::Invalid(first)));
            }
        };
        Ok(self.shows.kept_by(&self.case, &case).map(|shows| {
            let assets = take_along(&mut document);
            let text = format!("# {} with seed {seed}, by `reference vary`.\n{document}", self.case.id);
            Varied { text, assets, case, n_draws: 0, shows }
        }))
    }
}

/// The cases of `stages`, each with the effects that the stage before its own allows.
pub fn with_predecessors(stages: &[Stage]) -> impl Iterator<Item = (&Case, &Stage, Option<Effects>)> {
    let before = std::iter::once(None).chain(stages.iter().map(|stage| Some(stage.allows)));
    stages.iter().zip(before).flat_map(|(stage, before)| stage.cases.iter().map(move |case| (case, stage, before)))
}
