//! Finds or makes the result of one submission.

use std::io;
use std::path::Path;

use pages::say;

use super::progress::Listener;
use super::store::{Found, Store};
use super::submissions::Submission;
use crate::alike::Sketch;
use crate::grade::GradeError;
use crate::graded::Graded;
use crate::plain;
use crate::record::{FindingKind, Record, Verdict};
use crate::workers::guarded;

/// The grader of one submission. A trait, so that tests can grade a class without a compiler.
pub trait Grader: Sync {
    /// Returns a hash of everything but the submission that a score depends on.
    fn epoch(&self) -> &str;

    /// Reads the submission, or returns `None` if it cannot be read. Grading it again then costs
    /// nothing.
    fn read(&self, submission: &Path) -> Option<Read>;

    /// Grades `submission` on one thread.
    ///
    /// # Errors
    /// Fails if the grader or the machine does. Faults of the student are part of the result.
    fn grade(&self, submission: &Submission) -> Result<Graded, GradeError>;

    /// Returns whether the user has interrupted the run. A submission that was being graded then
    /// does not count.
    fn is_stopped(&self) -> bool;
}

/// A submission that was read.
#[derive(Clone, Debug, Default)]
pub struct Read {
    /// A hash of the files that count.
    pub digest: String,
    /// The fingerprints of the sources.
    pub sketch: Sketch,
}

/// Number of deaths of the grader while it graded a submission alone, after which the next run does
/// not grade that submission.
const MAX_DEATHS: u32 = 2;

/// The outcome for one submission.
#[derive(Debug)]
pub(super) enum Obtained {
    /// The submission was graded in an earlier run, under the same epoch, and has not changed.
    Taken(Record),
    Graded(Record),
    /// The grader or the machine failed; the text says why.
    Failed(String),
    /// The user stopped the run first.
    Left,
}

/// Takes the result of an earlier run, or grades the submission. A published result is then shown
/// under the submission's id. Returns the fingerprints of the submission as well.
pub(super) fn obtain(
    grader: &impl Grader,
    store: &Store,
    one: &Submission,
    listener: &dyn Listener,
) -> io::Result<(Obtained, Sketch)> {
    if grader.is_stopped() {
        return Ok((Obtained::Left, Sketch::default()));
    }
    let read = grader.read(&one.path);
    let obtained = find_or_grade(grader, store, one, (read.as_ref(), listener))?;
    match &obtained {
        Obtained::Taken(record) => listener.taken(one, record),
        Obtained::Graded(record) => listener.graded(one, record),
        Obtained::Failed(why) => listener.failed(one, why),
        Obtained::Left => {}
    }
    if let Obtained::Taken(record) | Obtained::Graded(record) = &obtained {
        store.show(&one.id, record)?;
        store.clear(&one.id);
    }
    Ok((obtained, read.unwrap_or_default().sketch))
}

fn find_or_grade(
    grader: &impl Grader,
    store: &Store,
    one: &Submission,
    (read, listener): (Option<&Read>, &dyn Listener),
) -> io::Result<Obtained> {
    match read.map(|read| store.find(&read.digest, &one.name)) {
        Some(Found::Record(record)) => return Ok(Obtained::Taken(*record)),
        Some(Found::Unsealed) => listener.refused(one),
        Some(Found::Nothing) | None => {}
    }
    if store.deaths(&one.id).is_some_and(|n| n >= MAX_DEATHS) {
        let why = format!(
            "the grader died {MAX_DEATHS} times while it graded this submission alone: find the \
             cause, and run again"
        );
        return Ok(Obtained::Failed(why));
    }
    store.begin(&one.id)?;
    // A fault of the grader in one submission must not end the run of the others.
    let graded = guarded(|| grader.grade(one));
    store.end(&one.id);
    if grader.is_stopped() {
        return Ok(Obtained::Left);
    }
    match graded {
        Err(why) => Ok(Obtained::Failed(why.to_string())),
        Ok(Err(why)) => Ok(Obtained::Failed(say::chain(&why))),
        Ok(Ok(graded)) => match fault(&graded.record) {
            Some(why) => Ok(Obtained::Failed(why)),
            None => store.publish(&graded).map(|()| Obtained::Graded(graded.record)),
        },
    }
}

/// Returns why a record may not be published: a part of it is the fault of the grader or the
/// machine. `None` if it may be.
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
