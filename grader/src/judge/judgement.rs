//! The judgement on a check: a verdict, the share of the points, and the reason.

use crate::record::{Finding, FindingKind, Verdict};

/// A verdict on a check, with the share of the points that it earns and the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The verdict, by which the check is scored.
    pub verdict: Verdict,
    /// The share of the points in thousandths, if the verdict is `Partial`.
    pub share: u32,
    /// The reason, or a remark on a pass.
    pub finding: Option<Finding>,
}

impl Judgement {
    /// A pass without a remark.
    pub const PASS: Self = Self { verdict: Verdict::Pass, share: 0, finding: None };

    /// Returns a pass with a remark.
    pub fn pass_with(finding: Finding) -> Self {
        Self { finding: Some(finding), ..Self::PASS }
    }

    /// Returns a failure of the program.
    pub fn fail(finding: Finding) -> Self {
        Self { verdict: Verdict::Fail, share: 0, finding: Some(finding) }
    }

    /// Returns a failure of the program that earns `share` thousandths of the points. A share of 0
    /// gives the verdict `Fail`.
    pub fn partial(finding: Finding, share: u32) -> Self {
        if share == 0 {
            return Self::fail(finding);
        }
        Self {
            verdict: Verdict::Partial,
            share,
            finding: Some(Finding { share: Some(share), ..finding }),
        }
    }

    /// Returns the judgement that the check could not be run because of `finding`.
    pub fn not_run(finding: Finding) -> Self {
        Self { verdict: Verdict::NotRun, share: 0, finding: Some(finding) }
    }

    /// Returns a failure of the grader or the machine.
    pub fn ours(message: impl Into<String>) -> Self {
        let finding = Finding::new(FindingKind::Internal, message);
        Self { verdict: Verdict::Ours, share: 0, finding: Some(finding) }
    }

    /// Returns whether the check earns points.
    pub fn earns(&self) -> bool {
        matches!(self.verdict, Verdict::Pass | Verdict::Partial)
    }

    /// Adds `text` to the message. A judgement without a finding gets a remark.
    pub fn remark(mut self, text: &str) -> Self {
        match &mut self.finding {
            Some(finding) => finding.message = format!("{}; {text}", finding.message),
            None => self.finding = Some(Finding::new(FindingKind::Remark, text)),
        }
        self
    }

    /// Adds what the program wrote on its error stream to the finding, if there is one.
    pub fn with_stderr(mut self, stderr: Option<String>) -> Self {
        if let Some(finding) = &mut self.finding {
            finding.stderr = stderr;
        }
        self
    }
}
