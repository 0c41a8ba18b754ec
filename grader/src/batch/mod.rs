//! A whole class, graded on all cores.
//!
//! ```text
//! OUT/results/KEY/{record.json, report.html}   what was graded, under the hash of (epoch, submission, name): never changed
//! OUT/records/ID.json, OUT/reports/ID.html     the same by the submission's id, as of the last run
//! OUT/class.csv, OUT/class.html                the table
//! ```
//!
//! A result appears by one rename, so a run that was killed goes on where it was. What the grader or the machine failed
//! at is never published: the next run tries again.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::files;
use crate::grade::{GradeError, Graded};
use crate::plain;
use crate::record::{FindingKind, Record, Verdict};
use crate::report::class::{self, Entry};

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

/// What grading one submission takes; behind a trait so that a class can be graded without a compiler in tests.
pub trait Grader: Sync {
    /// Hash of all that a score depends on but the submission.
    fn epoch(&self) -> &str;

    /// Hash of the files that count, or `None` where what is there cannot be graded, and grading it again costs nothing.
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
    #[error("there is no submission in {}: each is a folder or an archive (.zip, .tar.gz, .tgz) in it", .0.display())]
    Empty(PathBuf),
    /// The results cannot be written.
    #[error("cannot write the results to {}: {why}; what was finished is kept", .out.display())]
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
pub fn run(grader: &impl Grader, options: &Options, listener: &dyn Listener) -> Result<Summary, BatchError> {
    let unwritable = |why| BatchError::Out { out: options.out.clone(), why };
    let (submissions, left_aside) = submissions::list(&options.folder, &options.out)
        .map_err(|why| BatchError::Folder { folder: options.folder.clone(), why })?;
    if submissions.is_empty() {
        return Err(BatchError::Empty(options.folder.clone()));
    }
    let store = Store::open(&options.out, grader.epoch()).map_err(unwritable)?;
    listener.begin(submissions.len());
    let brought = side_by_side(options.jobs, &submissions, |one| bring(grader, &store, one, listener));
    let brought = brought.map_err(unwritable)?;
    listener.end();
    let summary = summarise(&submissions, &brought, left_aside);
    if summary.n_left == 0 {
        write_table(&options.out, submissions, brought).map_err(unwritable)?;
    }
    Ok(summary)
}

/// What `work` makes of each item, in their order, `jobs` at a time; after an error no other is begun.
///
/// Not by rayon: a worker of it that waits for the programs of one submission would meanwhile begin another.
fn side_by_side<T: Sync, R: Send>(
    jobs: usize,
    items: &[T],
    work: impl Fn(&T) -> io::Result<R> + Sync,
) -> io::Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        loop {
            let n = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(n) else { return Ok(done) };
            let result = work(item).inspect_err(|_| next.store(items.len(), Ordering::Relaxed))?;
            done.push((n, result));
        }
    };
    let mut done: Vec<(usize, R)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.clamp(1, items.len().max(1))).map(|_| scope.spawn(worker)).collect();
        let ended = workers.into_iter().map(|one| one.join().expect("panics of the grader are caught one by one"));
        ended.collect::<io::Result<Vec<_>>>().map(|parts| parts.into_iter().flatten().collect())
    })?;
    done.sort_by_key(|(n, _)| *n);
    Ok(done.into_iter().map(|(_, result)| result).collect())
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

/// Takes the result of an earlier run or grades; what is published is shown under the submission's id.
fn bring(grader: &impl Grader, store: &Store, one: &Submission, listener: &dyn Listener) -> io::Result<Brought> {
    let brought = find_or_grade(grader, store, one)?;
    match &brought {
        Brought::Taken(record) => listener.taken(one, record),
        Brought::Graded(record) => listener.graded(one, record),
        Brought::Failed(why) => listener.failed(one, why),
        Brought::Left => {}
    }
    if let Brought::Taken(record) | Brought::Graded(record) = &brought {
        store.show(&one.id, record)?;
    }
    Ok(brought)
}

fn find_or_grade(grader: &impl Grader, store: &Store, one: &Submission) -> io::Result<Brought> {
    if grader.is_stopped() {
        return Ok(Brought::Left);
    }
    if let Some(record) = grader.digest(&one.path).and_then(|digest| store.find(&digest, &one.name)) {
        return Ok(Brought::Taken(record));
    }
    let graded = guarded(|| grader.grade(one));
    if grader.is_stopped() {
        return Ok(Brought::Left);
    }
    match graded {
        Err(why) => Ok(Brought::Failed(why)),
        Ok(graded) => match fault(&graded.record) {
            Some(why) => Ok(Brought::Failed(why)),
            None => store.publish(&graded).map(|()| Brought::Graded(graded.record)),
        },
    }
}

/// A fault of ours in one submission must not end the run of the others.
fn guarded(grade: impl FnOnce() -> Result<Graded, GradeError>) -> Result<Graded, String> {
    match std::panic::catch_unwind(std::panic::AssertUnwindSafe(grade)) {
        Ok(graded) => graded.map_err(|why| why.to_string()),
        Err(_) => Err("the grader panicked; this is a fault of the grader".to_owned()),
    }
}

/// Why a record may not be published, if it may not: something in it is not the student's fault.
fn fault(record: &Record) -> Option<String> {
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let parts = checks.map(|check| (&*check.id, check.verdict, &check.finding));
    let build = ("build", record.build.verdict, &record.build.finding);
    parts.chain([build]).find_map(|(what, verdict, finding)| {
        let is_internal = finding.as_ref().is_some_and(|finding| finding.kind == FindingKind::Internal);
        let why = finding.as_ref().map_or("no reason is given", |finding| &finding.message);
        (verdict == Verdict::Ours || is_internal).then(|| plain::shown(&format!("{what}: {why}")))
    })
}

fn summarise(submissions: &[Submission], brought: &[Brought], left_aside: Vec<LeftAside>) -> Summary {
    let mut summary = Summary { left_aside, ..Summary::default() };
    for (one, brought) in submissions.iter().zip(brought) {
        match brought {
            Brought::Taken(_) => summary.n_done += 1,
            Brought::Graded(_) => (summary.n_done, summary.n_graded) = (summary.n_done + 1, summary.n_graded + 1),
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
    let entry = |(one, brought): (Submission, Brought)| Entry { id: one.id, name: one.name, record: record(brought) };
    let entries: Vec<Entry> = submissions.into_iter().zip(brought).map(entry).collect();
    files::write(&out.join("class.csv"), class::csv(&entries).as_bytes())?;
    files::write(&out.join("class.html"), class::page(&entries).as_bytes())
}
