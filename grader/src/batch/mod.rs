//! Grades a whole class on all cores.
//!
//! ```text
//! OUT/results/HASH/{record.json, report.html}  what was graded, under the hash of
//!                                              (epoch, submission, name): never changed
//! OUT/results/HASH/seal                        a keyed hash of all that
//! OUT/records/ID.json, OUT/reports/ID.html     the same by the submission's id, from the last run
//! OUT/class.csv, OUT/class.html                the table
//! OUT/alike.csv                                submissions with nearly equal sources
//! OUT/roll.json, OUT/decisions.csv             with a roster: the students with their points, and
//!                                              what a person has to decide
//! ```
//!
//! A result appears by one rename, so the next run continues where a killed one stopped. A
//! submission at which the grader or the machine failed is never published, so the next run tries
//! again.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::alike::{self, Pair, Sketch};
use crate::collect::class::Score;
use crate::collect::roll::Roll;
use crate::files;
use crate::report::class::{self, Entry};
use crate::workers::{Panicked, side_by_side};

mod bench;
mod collected;
mod error;
mod obtain;
mod progress;
mod seal;
mod store;
mod submissions;
#[cfg(test)]
mod tests;

pub use bench::OnBench;
pub use collected::Collect;
pub use error::BatchError;
pub use obtain::{Grader, Read};
pub use progress::{Listener, Shown};
pub use seal::{Key, KeyError};
pub use submissions::{LeftAside, Submission};

use collected::{Collected, Listed};
use obtain::{Obtained, obtain};
use store::Store;

/// The submissions of a run, and the place of the results.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder of submissions.
    pub folder: PathBuf,
    /// The folder of results, which is created if necessary.
    pub out: PathBuf,
    /// Number of submissions that are graded at once, at least 1.
    pub jobs: usize,
    /// The key of the results.
    pub key: Key,
    /// The roster, if hand-ins are joined to students.
    pub collect: Option<Collect>,
}

/// The result of a run.
#[derive(Debug, Default)]
pub struct Summary {
    /// Number of submissions that have a record now.
    pub n_done: usize,
    /// Number of submissions that were graded in this run.
    pub n_graded: usize,
    /// Number of submissions without a record because the user stopped the run. If there are any,
    /// the table is not written.
    pub n_left: usize,
    /// Number of pairs of submissions with nearly equal sources.
    pub n_alike: usize,
    /// Number of questions that a person has to decide.
    pub n_decisions: usize,
    /// Names of the submissions at which the grader or the machine failed, with the reasons.
    pub failed: Vec<(String, String)>,
    /// Files and folders beside the submissions that are none.
    pub left_aside: Vec<LeftAside>,
}

impl Summary {
    /// Returns the exit code: 0, 3 if the grader or the machine failed at a submission, 130 if the
    /// user stopped the run.
    pub fn exit_code(&self) -> u8 {
        match () {
            () if self.n_left > 0 => 130,
            () if !self.failed.is_empty() => 3,
            () => 0,
        }
    }
}

/// Grades the new and changed submissions in the folder, and writes records, reports and the table.
///
/// # Errors
/// See [`BatchError`].
pub fn run(
    grader: &impl Grader,
    options: &Options,
    listener: &dyn Listener,
) -> Result<Summary, BatchError> {
    let unwritable = |source| BatchError::Out { out: options.out.clone(), source };
    let Listed { submissions, left_aside, collected } =
        collected::list(&options.folder, &options.out, options.collect.as_ref())?;
    if submissions.is_empty() {
        return Err(BatchError::Empty(options.folder.clone()));
    }
    let store =
        Store::open(&options.out, grader.epoch(), options.key.clone()).map_err(unwritable)?;
    listener.begin(submissions.len());
    let obtained =
        obtain_all(grader, &store, &submissions, options.jobs, listener).map_err(unwritable)?;
    let (obtained, sketches): (Vec<Obtained>, Vec<Sketch>) = obtained.into_iter().unzip();
    listener.end();
    let mut summary = summarise(&submissions, &obtained, left_aside);
    if summary.n_left == 0 {
        let ids = submissions.iter().map(|one| &*one.id);
        let alike = alike::pairs(&ids.zip(&sketches).collect::<Vec<_>>());
        summary.n_alike = alike.len();
        let entries = entries(submissions, obtained);
        let roll = collected.map(|collected| roll(&collected, &entries));
        summary.n_decisions = roll.as_ref().map_or(0, |roll| roll.decisions.len());
        write_table(&options.out, &entries, &alike, roll.as_ref()).map_err(unwritable)?;
    }
    Ok(summary)
}

/// Finds or makes the results of all submissions, `jobs` at a time. After a result that cannot be
/// written, no other submission is begun.
///
/// Submissions that were being graded when an earlier run died come last, one by one, so that the
/// one that killed the run does not hold up the others.
fn obtain_all(
    grader: &impl Grader,
    store: &Store,
    submissions: &[Submission],
    jobs: usize,
    listener: &dyn Listener,
) -> io::Result<Vec<(Obtained, Sketch)>> {
    let is_over = AtomicBool::new(false);
    let work = |n: &usize| {
        if is_over.load(Ordering::Relaxed) {
            return Ok((Obtained::Left, Sketch::default()));
        }
        obtain(grader, store, &submissions[*n], listener)
            .inspect_err(|_| is_over.store(true, Ordering::Relaxed))
    };
    let all = 0..submissions.len();
    let (suspects, others): (Vec<usize>, Vec<usize>) =
        all.partition(|n| store.deaths(&submissions[*n].id).is_some());
    let mut obtained = side_by_side(jobs, &others, work);
    obtained.extend(side_by_side(1, &suspects, work));
    let or_failed = |one: Result<_, Panicked>| {
        one.unwrap_or_else(|why| Ok((Obtained::Failed(why.to_string()), Sketch::default())))
    };
    let obtained = obtained.into_iter().map(or_failed).collect::<io::Result<Vec<_>>>()?;
    let mut in_order: Vec<(usize, _)> = others.into_iter().chain(suspects).zip(obtained).collect();
    in_order.sort_by_key(|(n, _)| *n);
    Ok(in_order.into_iter().map(|(_, obtained)| obtained).collect())
}

fn summarise(
    submissions: &[Submission],
    obtained: &[Obtained],
    left_aside: Vec<LeftAside>,
) -> Summary {
    let mut summary = Summary { left_aside, ..Summary::default() };
    for (one, obtained) in submissions.iter().zip(obtained) {
        match obtained {
            Obtained::Taken(_) => summary.n_done += 1,
            Obtained::Graded(_) => {
                (summary.n_done, summary.n_graded) = (summary.n_done + 1, summary.n_graded + 1)
            }
            Obtained::Failed(why) => summary.failed.push((one.name.clone(), why.clone())),
            Obtained::Left => summary.n_left += 1,
        }
    }
    summary
}

fn entries(submissions: Vec<Submission>, obtained: Vec<Obtained>) -> Vec<Entry> {
    let record = |obtained| match obtained {
        Obtained::Taken(record) | Obtained::Graded(record) => Some(record),
        Obtained::Failed(_) | Obtained::Left => None,
    };
    let entry = |(one, obtained): (Submission, Obtained)| Entry {
        id: one.id,
        name: one.name,
        record: record(obtained),
    };
    submissions.into_iter().zip(obtained).map(entry).collect()
}

fn roll(collected: &Collected, entries: &[Entry]) -> Roll {
    let score = |entry: &Entry| {
        let score = entry.record.as_ref()?.score;
        Some(Score { earned: score.earned, possible: score.possible })
    };
    let scores: BTreeMap<&str, Score> =
        entries.iter().filter_map(|entry| Some((&*entry.id, score(entry)?))).collect();
    collected.roll(&scores)
}

/// The file with the students and their points.
pub const ROLL: &str = "roll.json";

fn write_table(
    out: &Path,
    entries: &[Entry],
    alike: &[Pair],
    roll: Option<&Roll>,
) -> io::Result<()> {
    files::write(&out.join("class.csv"), class::csv(entries, roll).as_bytes())?;
    files::write(&out.join("class.html"), class::page(entries, alike, roll).as_bytes())?;
    files::write(&out.join("alike.csv"), class::alike_csv(entries, alike).as_bytes())?;
    let (stored, decisions) = (out.join(ROLL), out.join("decisions.csv"));
    let Some(roll) = roll else {
        // Those of an earlier run with a roster would no longer match the table.
        for path in [stored, decisions] {
            if path.exists() {
                std::fs::remove_file(path)?;
            }
        }
        return Ok(());
    };
    files::write(&decisions, class::decisions_csv(roll).as_bytes())?;
    let mut text = serde_json::to_string_pretty(roll).map_err(io::Error::other)?;
    text.push('\n');
    files::write(&stored, text.as_bytes())
}
