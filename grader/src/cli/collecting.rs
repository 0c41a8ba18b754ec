//! The arguments that join hand-ins to the students of a roster.

use std::path::{Path, PathBuf};

use cases::problem::Problems;
use clap::Args;

use crate::batch::Collect;
use crate::collect::class::Count;
use crate::collect::export::Export;
use crate::collect::policy::Policy;
use crate::collect::roster::Roster;
use crate::grade::GradeError;
use crate::input;

/// The roster of a class, and how hand-ins are joined to it.
#[derive(Debug, Args)]
pub(crate) struct Collecting {
    /// CSV file with a row for each student: id, and if known name, email, account, section, group,
    /// extension, handed_in
    ///
    /// Every student gets a row in the table. A hand-in that names no student, or more than one, is
    /// listed for a decision. See docs/class.md.
    #[arg(long, value_name = "FILE")]
    roster: Option<PathBuf>,
    /// TOML file with the deadline and the deduction for late hand-ins
    #[arg(long, value_name = "FILE", requires = "roster")]
    policy: Option<PathBuf>,
    /// Platform that exported the folder
    #[arg(long, value_enum, default_value_t = Export::Auto, requires = "roster")]
    export: Export,
    /// Hand-in that counts if a student has several
    #[arg(long, value_enum, default_value_t = Count::Latest, requires = "roster")]
    count: Count,
}

/// Most bytes of a roster, a policy or a file of a platform.
pub(crate) const MAX_BYTES: u64 = 16 << 20;

/// Reads a roster, a policy or a file of a platform.
///
/// # Errors
/// Fails if the file cannot be read or is too long.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, GradeError> {
    Ok(input::read(path, |_| Ok(MAX_BYTES))?)
}

impl Collecting {
    /// Reads the roster and the policy; `None` if there is no roster.
    ///
    /// # Errors
    /// All problems of both files.
    pub(crate) fn collect(&self) -> Result<Option<Collect>, GradeError> {
        let Some(path) = &self.roster else { return Ok(None) };
        let roster = Roster::parse(&input::shown(path), &read(path)?);
        let policy = match &self.policy {
            Some(path) => Policy::parse(&input::shown(path), &read(path)?).map(Some),
            None => Ok(None),
        };
        let (roster, policy) = both(roster, policy)?;
        Ok(Some(Collect { roster, policy, export: self.export, count: self.count }))
    }
}

/// Returns both values, or the problems of both.
fn both<A, B>(a: Result<A, Problems>, b: Result<B, Problems>) -> Result<(A, B), Problems> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(a), Err(b)) => Err(a.and(b)),
        (Err(why), Ok(_)) | (Ok(_), Err(why)) => Err(why),
    }
}
