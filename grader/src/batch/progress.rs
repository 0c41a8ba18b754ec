//! Shows the progress of a run: a bar with the time left on a terminal, else a line for each
//! finished submission.

use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::ProgressBar;
use pages::{bar, plain, say};

use super::Submission;
use crate::record::Record;
use crate::report::words;

/// A receiver of the progress of a run. It is called from several threads, in any order.
pub trait Listener: Sync {
    /// Reports that the run begins.
    fn begin(&self, n_submissions: usize);
    /// Reports that the result of an earlier run is used.
    fn taken(&self, submission: &Submission, record: &Record);
    /// Reports that a stored result of the submission lacks the seal of this grader, so that the
    /// submission is graded again.
    fn refused(&self, submission: &Submission);
    /// Reports that the submission was graded.
    fn graded(&self, submission: &Submission, record: &Record);
    /// Reports that the grader or the machine failed at the submission.
    fn failed(&self, submission: &Submission, why: &str);
    /// Reports that the run has ended.
    fn end(&self);
}

/// A display of progress on standard error.
#[derive(Debug)]
pub struct Shown {
    bar: ProgressBar,
    n_done: AtomicUsize,
    is_quiet: bool,
}

impl Shown {
    /// Returns a display that shows nothing yet. A quiet one shows only failures.
    pub fn new(is_quiet: bool) -> Self {
        let bar = if is_quiet { ProgressBar::hidden() } else { ProgressBar::no_length() };
        Self { bar, n_done: AtomicUsize::new(0), is_quiet }
    }

    fn step(&self, line: String, is_shown_anyway: bool) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        self.bar.inc(1);
        if self.bar.is_hidden() {
            if is_shown_anyway || !self.is_quiet {
                say::err(&format!("[{n_done}/{}] {line}", self.bar.length().unwrap_or(0)));
            }
        } else if is_shown_anyway {
            self.bar.println(plain::printable(&line));
        }
    }
}

impl Listener for Shown {
    fn begin(&self, n_submissions: usize) {
        self.bar.set_style(bar::style("{bar:30} {pos}/{len} submissions{left}  {wide_msg}"));
        self.bar.set_length(n_submissions as u64);
        self.bar.enable_steady_tick(std::time::Duration::from_millis(500));
    }

    fn taken(&self, submission: &Submission, record: &Record) {
        self.step(format!("{} (unchanged)", line(submission, record)), false);
    }

    fn refused(&self, submission: &Submission) {
        let line = format!(
            "{}: its stored result is refused and graded again, because it lacks the seal of this \
             grader: somebody changed it, the disk spoilt it, or the key is another one",
            submission.name
        );
        if self.bar.is_hidden() {
            say::err(&line);
        } else {
            self.bar.println(plain::printable(&line));
        }
    }

    fn graded(&self, submission: &Submission, record: &Record) {
        let line = line(submission, record);
        self.bar.set_message(plain::printable(&line));
        self.step(line, false);
    }

    fn failed(&self, submission: &Submission, why: &str) {
        self.step(
            format!("{}: not graded, and not the student's fault: {why}", submission.name),
            true,
        );
    }

    fn end(&self) {
        self.bar.finish_and_clear();
    }
}

fn line(submission: &Submission, record: &Record) -> String {
    format!(
        "{}: {} points",
        submission.name,
        words::share(record.score.earned, record.score.possible)
    )
}
