//! Progress reports while a submission is graded.

/// A receiver of progress reports, which is called from several threads.
pub trait Progress: Sync {
    /// Reports the start of a long phase, such as `compiling`.
    fn phase(&self, what: &str);
    /// Reports that `n_checks` programs are about to be run.
    fn begin(&self, n_checks: u64);
    /// Reports that one of the programs has ended.
    fn step(&self);
}

/// A receiver that ignores all reports.
pub struct Silent;

impl Progress for Silent {
    fn phase(&self, _what: &str) {}
    fn begin(&self, _n_checks: u64) {}
    fn step(&self) {}
}
