//! What is heard of a submission while it is graded.

/// Hears how far the work has come. Called from several threads.
pub trait Progress: Sync {
    /// Hears that something begins that takes a while, such as `compiling`.
    fn phase(&self, what: &str);
    /// Hears that `n_checks` programs are about to be run.
    fn begin(&self, n_checks: u64);
    /// Hears that one of the programs has ended.
    fn step(&self);
}

/// Hears nothing.
pub struct Silent;

impl Progress for Silent {
    fn phase(&self, _what: &str) {}
    fn begin(&self, _n_checks: u64) {}
    fn step(&self) {}
}
