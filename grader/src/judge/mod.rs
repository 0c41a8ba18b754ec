//! From what a program did to what it is worth: findings and verdicts. Runs nothing, reads no file.

mod ending;
mod numbers;
mod picture;
mod unit;

pub use ending::{ending, todo};
pub use picture::{Comparison, Difference, RowsCompared, compare, picture};
pub use unit::{alike, lines, unit};

use crate::record::{Finding, FindingKind, Verdict};

/// What a check comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// How it is to be scored.
    pub verdict: Verdict,
    /// Thousandths of its points that it earns, where the verdict is `Partial`.
    pub share: u32,
    /// Why; also a remark on a pass.
    pub finding: Option<Finding>,
}

impl Judgement {
    /// All is right.
    pub const PASS: Self = Self { verdict: Verdict::Pass, share: 0, finding: None };

    /// All counts as right, but something is worth saying.
    pub fn pass_with(finding: Finding) -> Self {
        Self { finding: Some(finding), ..Self::PASS }
    }

    /// The program is to blame.
    pub fn fail(finding: Finding) -> Self {
        Self { verdict: Verdict::Fail, share: 0, finding: Some(finding) }
    }

    /// The program is to blame, but earns this many thousandths of the points; with none it fails.
    pub fn partial(finding: Finding, share: u32) -> Self {
        if share == 0 {
            return Self::fail(finding);
        }
        Self { verdict: Verdict::Partial, share, finding: Some(Finding { share: Some(share), ..finding }) }
    }

    /// The program could not be asked, because of this.
    pub fn not_run(finding: Finding) -> Self {
        Self { verdict: Verdict::NotRun, share: 0, finding: Some(finding) }
    }

    /// The grader or the machine is to blame.
    pub fn ours(message: impl Into<String>) -> Self {
        let finding = Finding::new(FindingKind::Internal, message);
        Self { verdict: Verdict::Ours, share: 0, finding: Some(finding) }
    }

    /// The same, with something added to what is said; a pass gets a remark.
    pub fn remark(mut self, text: &str) -> Self {
        match &mut self.finding {
            Some(finding) => finding.message = format!("{}; {text}", finding.message),
            None => self.finding = Some(Finding::new(FindingKind::Remark, text)),
        }
        self
    }

    /// The same, with what the program wrote on its error stream.
    pub fn with_stderr(mut self, stderr: Option<String>) -> Self {
        if let Some(finding) = &mut self.finding {
            finding.stderr = stderr;
        }
        self
    }
}
