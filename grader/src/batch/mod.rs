//! A whole class, graded on all cores.
//!
//! ```text
//! OUT/results/KEY/{record.json, report.html}   what was graded, under the hash of
//!                                              (epoch, submission, name): never changed
//! OUT/records/ID.json, OUT/reports/ID.html     the same by the submission's id, as of the last run
//! OUT/class.csv, OUT/class.html                the table
//! ```
//!
//! A result appears by one rename, so a run that was killed goes on where it was. What the grader
//! or the machine failed at is never published: the next run tries again.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::files;
use crate::grade::GradeError;
use crate::graded::Graded;
use crate::plain;
use crate::record::{FindingKind, Record, Verdict};
use crate::report::class::{self, Entry};
use crate::workers::{Panicked, guarded, side_by_side};

mod bench;
mod progress;
mod store;
mod submissions;
#[cfg(test)]
mod tests;

pub use bench::OnBench;
pub use progress::{Listener, Shown};
pub use submissions::{LeftAside, Submission};

use store::Store;

/// What grading one submission takes; behind a trait so that a class can be graded without a
/// compiler in tests.
pub trait Grader: Sync {
    /// Hash of all that a score depends on but the submission.
    fn epoch(&self) -> &str;

    /// Hash of the files that count, or `None` where what is there cannot be graded, and grading it
    /// again costs nothing.
    fn digest(&self, submission: &Path) -> Option<String>;

    /// Grades it, on one thread.
    ///
    /// # Errors
    /// What is not the student's fault.
    fn grade(&self, submission: &Submission) -> Result<Graded, GradeError>;

    /// Whether the user has asked to stop. What was graded meanwhile counts for nothing.
    fn is_stopped(&self) -> bool;
}

/// What to grade, and where to put what comes of it.
#[derive(Clone, Debug)]
pub struct Options {
    /// Folder of submissions.
    pub folder: PathBuf,
    /// Folder of results; made if need be.
    pub out: PathBuf,
    /// Submissions at once; at least 1.
    pub jobs: usize,
}

/// What came of a run.
#[derive(Debug, Default)]
pub struct Summary {
    /// Submissions that have a record now.
    pub n_done: usize,
    /// Those of them that were graded in this run.
    pub n_graded: usize,
    /// Submissions that the user's stop left without a record. The table is not written then.
    pub n_left: usize,
    /// Names of those that the grader or the machine failed at, and why.
    pub failed: Vec<(String, String)>,
    /// What in the folder is no submission.
    pub left_aside: Vec<LeftAside>,
}

impl Summary {
    /// 0, 3 where the grader or the machine failed at something, 130 where the user stopped it.
    pub fn exit_code(&self) -> u8 {
        match () {
            () if self.n_left > 0 => 130,
            () if !self.failed.is_empty() => 3,
            () => 0,
        }
    }
}

/// Why there is no run at all.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// The folder of submissions cannot be read.
    #[error("cannot read the folder of submissions {}: {why}", .folder.display())]
    Folder {
        /// As it was given.
        folder: PathBuf,
        /// What the system says.
        why: io::Error,
    },
    /// Nothing in it is a submission.
    #[error("there is no submission in {}: each is a folder or an archive (.zip, .tar.gz, .tgz, \
        .tar) in it", .0.display())]
    Empty(PathBuf),
    /// The results cannot be written.
    #[error("cannot write the results to {}: {why}; results of finished submissions are \
        kept", .out.display())]
    Out {
        /// As it was given.
        out: PathBuf,
        /// What the system says.
        why: io::Error,
    },
}

/// Grades what is new or changed in the folder, and writes records, reports and the table.
///
/// # Errors
/// See [`BatchError`].
pub fn run(
    grader: &impl Grader,
    options: &Options,
    listener: &dyn Listener,
) -> Result<Summary, BatchError> {
    let unwritable = |why| BatchError::Out { out: options.out.clone(), why };
    let (submissions, left_aside) = submissions::list(&options.folder, &options.out)
        .map_err(|why| BatchError::Folder { folder: options.folder.clone(), why })?;
    if submissions.is_empty() {
        return Err(BatchError::Empty(options.folder.clone()));
    }
    let store = Store::open(&options.out, grader.epoch()).map_err(unwritable)?;
    listener.begin(submissions.len());
    let brought =
        bring_all(grader, &store, &submissions, options.jobs, listener).map_err(unwritable)?;
    listener.end();
    let summary = summarise(&submissions, &brought, left_aside);
    if summary.n_left == 0 {
        write_table(&options.out, submissions, brought).map_err(unwritable)?;
    }
    Ok(summary)
}

/// Deaths of the grader, each while it graded this submission alone, after which it is not graded
/// in the next run.
const MAX_DEATHS: u32 = 2;

/// Brings all submissions, `jobs` at a time; after results that cannot be written, no other is
/// begun.
///
/// Those that were being graded when a run died come last and one by one, so that the one which
/// killed it stands in nobody's way.
fn bring_all(
    grader: &impl Grader,
    store: &Store,
    submissions: &[Submission],
    jobs: usize,
    listener: &dyn Listener,
) -> io::Result<Vec<Brought>> {
    let is_over = AtomicBool::new(false);
    let work = |n: &usize| {
        if is_over.load(Ordering::Relaxed) {
            return Ok(Brought::Left);
        }
        bring(grader, store, &submissions[*n], listener)
            .inspect_err(|_| is_over.store(true, Ordering::Relaxed))
    };
    let all = 0..submissions.len();
    let (suspects, others): (Vec<usize>, Vec<usize>) =
        all.partition(|n| store.deaths(&submissions[*n].id).is_some());
    let mut brought = side_by_side(jobs, &others, work);
    brought.extend(side_by_side(1, &suspects, work));
    let or_failed =
        |one: Result<_, Panicked>| one.unwrap_or_else(|why| Ok(Brought::Failed(why.to_string())));
    let brought = brought.into_iter().map(or_failed).collect::<io::Result<Vec<Brought>>>()?;
    let mut in_order: Vec<(usize, Brought)> =
        others.into_iter().chain(suspects).zip(brought).collect();
    in_order.sort_by_key(|(n, _)| *n);
    Ok(in_order.into_iter().map(|(_, brought)| brought).collect())
}

/// What became of one submission.
enum Brought {
    /// It was graded in an earlier run, under the same epoch, and has not changed.
    Taken(Record),
    Graded(Record),
    /// Not the student's fault.
    Failed(String),
    /// The user stopped us first.
    Left,
}

/// Takes the result of an earlier run or grades; what is published is shown under the submission's
/// id.
fn bring(
    grader: &impl Grader,
    store: &Store,
    one: &Submission,
    listener: &dyn Listener,
) -> io::Result<Brought> {
    let brought = find_or_grade(grader, store, one)?;
    match &brought {
        Brought::Taken(record) => listener.taken(one, record),
        Brought::Graded(record) => listener.graded(one, record),
        Brought::Failed(why) => listener.failed(one, why),
        Brought::Left => {}
    }
    if let Brought::Taken(record) | Brought::Graded(record) = &brought {
        store.show(&one.id, record)?;
        store.clear(&one.id);
    }
    Ok(brought)
}

fn find_or_grade(grader: &impl Grader, store: &Store, one: &Submission) -> io::Result<Brought> {
    if grader.is_stopped() {
        return Ok(Brought::Left);
    }
    if let Some(record) = grader.digest(&one.path).and_then(|digest| store.find(&digest, &one.name))
    {
        return Ok(Brought::Taken(record));
    }
    if store.deaths(&one.id).is_some_and(|n| n >= MAX_DEATHS) {
        let why = format!(
            "the grader died {MAX_DEATHS} times while it graded this alone: see why, and run again"
        );
        return Ok(Brought::Failed(why));
    }
    store.begin(&one.id)?;
    // A fault of the grader in one submission must not end the run of the others.
    let graded = guarded(|| grader.grade(one));
    store.end(&one.id);
    if grader.is_stopped() {
        return Ok(Brought::Left);
    }
    match graded {
        Err(why) => Ok(Brought::Failed(why.to_string())),
        Ok(Err(why)) => Ok(Brought::Failed(why.to_string())),
        Ok(Ok(graded)) => match fault(&graded.record) {
            Some(why) => Ok(Brought::Failed(why)),
            None => store.publish(&graded).map(|()| Brought::Graded(graded.record)),
        },
    }
}

/// Why a record may not be published, if it may not: something in it is not the student's fault.
fn fault(record: &Record) -> Option<String> {
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let parts = checks.map(|check| (&*check.id, check.verdict, &check.finding));
    let build = ("build", record.build.verdict, &record.build.finding);
    parts.chain([build]).find_map(|(what, verdict, finding)| {
        let is_internal =
            finding.as_ref().is_some_and(|finding| finding.kind == FindingKind::Internal);
        let why = finding.as_ref().map_or("no reason is given", |finding| &finding.message);
        (verdict == Verdict::Ours || is_internal).then(|| plain::shown(&format!("{what}: {why}")))
    })
}

fn summarise(
    submissions: &[Submission],
    brought: &[Brought],
    left_aside: Vec<LeftAside>,
) -> Summary {
    let mut summary = Summary { left_aside, ..Summary::default() };
    for (one, brought) in submissions.iter().zip(brought) {
        match brought {
            Brought::Taken(_) => summary.n_done += 1,
            Brought::Graded(_) => {
                (summary.n_done, summary.n_graded) = (summary.n_done + 1, summary.n_graded + 1)
            }
            Brought::Failed(why) => summary.failed.push((one.name.clone(), why.clone())),
            Brought::Left => summary.n_left += 1,
        }
    }
    summary
}

fn write_table(out: &Path, submissions: Vec<Submission>, brought: Vec<Brought>) -> io::Result<()> {
    let record = |brought| match brought {
        Brought::Taken(record) | Brought::Graded(record) => Some(record),
        Brought::Failed(_) | Brought::Left => None,
    };
    let entry = |(one, brought): (Submission, Brought)| Entry {
        id: one.id,
        name: one.name,
        record: record(brought),
    };
    let entries: Vec<Entry> = submissions.into_iter().zip(brought).map(entry).collect();
    files::write(&out.join("class.csv"), class::csv(&entries).as_bytes())?;
    files::write(&out.join("class.html"), class::page(&entries).as_bytes())
}
