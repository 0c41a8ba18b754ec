//! Grades variants: each is made, built and graded on the public stages, and its pictures are kept
//! for other judges.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use cases::answer::expected_png_path;
use cases::film;
use grader::grade::{Bench, Graded, Options, Silent, grade};
use grader::record::{CheckRecord, Record, Verdict};
use pages::say;

use crate::rules::{Picture, RULES};
use crate::variants::{Nature, Variant};
use crate::{public_stages, workspace};

/// The parts that all trials share.
#[derive(Debug)]
pub struct Lab {
    bench: Bench,
    /// The image cases, in the order of the stages.
    cases: Vec<Reference>,
    /// The folder for pictures that differ in some byte from the expected ones.
    gallery: Option<PathBuf>,
}

/// An image case with the pictures that a variant's picture is compared with.
#[derive(Debug)]
struct Reference {
    id: String,
    expected: Picture,
    /// The picture of the solution.
    solution: Picture,
    /// The pixels on which correct tracers disagree.
    contested: Vec<bool>,
}

/// The results of a variant.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The variant.
    pub variant: Variant,
    /// The record of the judge.
    pub record: Record,
    /// The pictures, in the order of the cases.
    pub shown: Vec<Shown>,
}

/// A variant's picture of a case.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The id of the case.
    pub case: String,
    /// The path in the gallery. `None` if the picture is the expected one byte by byte, or if there
    /// is no gallery.
    pub file: Option<PathBuf>,
    /// True if there is a picture.
    pub is_there: bool,
    /// The number of pixels outside the contested ones that differ from the solution's in some
    /// byte. If there is no picture, all pixels count.
    pub n_changed: usize,
    /// The results of [`RULES`].
    pub passes: [bool; RULES.len()],
}

impl Lab {
    /// Reads the public stages, and grades the solution to get its pictures. Pictures of variants
    /// are kept in `gallery`.
    ///
    /// # Errors
    /// Returns an error if the stages cannot be read or the solution cannot be graded.
    pub fn open(gallery: Option<PathBuf>) -> Result<Self, String> {
        let stages = public_stages();
        let bench = Bench::open(&stages).map_err(|why| say::chain(&why))?;
        let solution = Options::new(workspace().join("tests/solution"));
        let pictures = grade(&bench, &solution, &Silent).map_err(|why| say::chain(&why))?.pictures;
        let mut cases = vec![];
        for (questions, case) in
            bench.exam.stages.iter().flat_map(|one| one.stage.cases.iter().map(move |c| (one, c)))
        {
            let answer =
                questions.images.get(&case.id).ok_or("a case has no answer that can be trusted")?;
            let own = pictures.get(&case.id).and_then(|both| both.actual.as_ref());
            let size = case.scene.render;
            cases.push(Reference {
                id: case.id.clone(),
                expected: read(&expected_png_path(&stages, &case.id), size.width, size.height)?,
                solution: Picture::of(
                    own.ok_or_else(|| format!("the solution gives no picture of {}", case.id))?,
                ),
                contested: (0..answer.lo.len()).map(|n| answer.is_contested(n)).collect(),
            });
        }
        Ok(Self { bench, cases, gallery })
    }

    /// Returns the ids of the image cases, in order.
    pub fn cases(&self) -> impl Iterator<Item = &str> {
        self.cases.iter().map(|case| case.id.as_str())
    }

    /// Makes, builds and grades `variant` on one core.
    ///
    /// # Errors
    /// Returns an error if an edit cannot be made, the variant does not compile, or the grader
    /// fails.
    pub fn try_one(&self, variant: &Variant) -> Result<Trial, String> {
        let folder = variant.make()?;
        let options =
            Options { name: variant.name.clone(), jobs: 1, ..Options::new(folder.path()) };
        let graded = grade(&self.bench, &options, &Silent);
        let Graded { record, pictures } =
            graded.map_err(|why| format!("{}: {}", variant.name, say::chain(&why)))?;
        if record.build.verdict != Verdict::Pass {
            let why = record.build.finding.map_or(String::new(), |finding| finding.message);
            return Err(format!("{} does not build:\n{why}", variant.name));
        }
        let ours = record
            .stages
            .iter()
            .flat_map(|stage| &stage.checks)
            .find(|check| check.verdict == Verdict::Ours);
        if let Some(check) = ours {
            return Err(format!(
                "{}: {}: the grader failed: {:?}",
                variant.name, check.id, check.finding
            ));
        }
        let actual = |case: &Reference| pictures.get(&case.id)?.actual.as_ref().map(Picture::of);
        let shown = self.cases.iter().map(|case| self.show(case, actual(case)));
        let shown =
            shown.collect::<Result<_, _>>().map_err(|why| format!("{}: {why}", variant.name))?;
        Ok(Trial { variant: variant.clone(), record, shown })
    }

    fn show(&self, case: &Reference, actual: Option<Picture>) -> Result<Shown, String> {
        let id = case.id.clone();
        let Some(actual) = actual else {
            let passes = [false; RULES.len()];
            return Ok(Shown {
                case: id,
                file: None,
                is_there: false,
                n_changed: case.contested.len(),
                passes,
            });
        };
        let pairs = actual.pixels().zip(case.solution.pixels());
        let n_changed =
            pairs.zip(&case.contested).filter(|((a, b), contested)| a != b && !**contested).count();
        let file = match &self.gallery {
            Some(gallery) if actual != case.expected => Some(store_picture(gallery, &id, &actual)?),
            _ => None,
        };
        let passes = RULES.map(|rule| (rule.passes)(&case.expected, &actual));
        Ok(Shown { case: id, file, is_there: true, n_changed, passes })
    }

    /// Tries all variants, `jobs` at a time, and calls `on_done` for each that is done. The results
    /// are in the order of `variants`.
    ///
    /// # Errors
    /// Returns the errors of [`Self::try_one`], each with the name of its variant.
    pub fn try_all(
        &self,
        variants: &[Variant],
        jobs: usize,
        on_done: &(dyn Fn(&Variant) + Sync),
    ) -> Result<Vec<Trial>, Vec<String>> {
        let next = AtomicUsize::new(0);
        let worker = || {
            let mine = std::iter::from_fn(|| {
                let index = next.fetch_add(1, Ordering::Relaxed);
                variants.get(index).map(|variant| (index, variant))
            });
            let tried = mine.map(|(index, variant)| {
                let trial = self.try_one(variant);
                on_done(variant);
                (index, trial)
            });
            tried.collect::<Vec<_>>()
        };
        let mut tried: Vec<(usize, Result<Trial, String>)> = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(worker)).collect();
            workers
                .into_iter()
                .flat_map(|worker| worker.join().expect("a panic is passed on"))
                .collect()
        });
        tried.sort_by_key(|(index, _)| *index);
        let (good, bad): (Vec<_>, Vec<_>) =
            tried.into_iter().map(|(_, trial)| trial).partition(Result::is_ok);
        if bad.is_empty() {
            Ok(good.into_iter().flatten().collect())
        } else {
            Err(bad.into_iter().filter_map(Result::err).collect())
        }
    }
}

impl Trial {
    /// Returns the checks that lost points.
    pub fn lost(&self) -> impl Iterator<Item = &CheckRecord> {
        self.record
            .stages
            .iter()
            .flat_map(|stage| &stage.checks)
            .filter(|check| check.earned < check.possible)
    }

    /// Returns the id of the first stage that lost points.
    pub fn first_stage(&self) -> Option<&str> {
        self.record
            .stages
            .iter()
            .find(|stage| stage.earned < stage.possible)
            .map(|stage| stage.id.as_str())
    }

    /// Returns the ids of the misconceptions that were named first, or several if the checks do not
    /// distinguish them.
    pub fn named_first(&self) -> Vec<&str> {
        let first = self.record.diagnoses.first();
        first.map_or(vec![], |first| {
            first.mistakes.iter().map(|mistake| mistake.id.as_str()).collect()
        })
    }

    /// Returns whether some picture differs from the solution's outside contested pixels.
    pub fn is_seen(&self) -> bool {
        self.shown.iter().any(|shown| shown.n_changed > 0)
    }

    /// Returns the stage of the bug; `None` for a correct variant.
    pub fn stage(&self) -> Option<&str> {
        match &self.variant.nature {
            Nature::Right => None,
            Nature::Wrong { stage, .. } => Some(stage),
        }
    }
}

/// Returns the number of cores.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Stores a picture under the hash of its bytes, unless it is already there, and returns its path.
fn store_picture(gallery: &Path, case: &str, picture: &Picture) -> Result<PathBuf, String> {
    let file = gallery.join(case).join(format!("{}.png", picture.digest()));
    let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", file.display());
    if !file.exists() {
        std::fs::create_dir_all(gallery.join(case)).map_err(|why| wrong(&why))?;
        cases::files::write(&file, &picture.png().map_err(|why| wrong(&why))?)
            .map_err(|why| wrong(&why))?;
    }
    Ok(file)
}

fn read(path: &Path, width: u32, height: u32) -> Result<Picture, String> {
    let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let bytes = std::fs::read(path).map_err(|why| wrong(&why))?;
    film::read_exact(&bytes, width, height)
        .map(|image| Picture::of(&image))
        .map_err(|why| wrong(&why))
}
