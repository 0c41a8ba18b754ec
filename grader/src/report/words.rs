//! Verdicts, findings and points in plain words.

use crate::record::{FindingKind, Verdict};

/// Points from thousandths, without needless zeros: `43.25`.
pub fn points(thousandths: u64) -> String {
    let text = format!("{}.{:03}", thousandths / 1000, thousandths % 1000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A verdict as it stands in a report.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "right",
        Verdict::Partial => "partly right",
        Verdict::Fail => "failed",
        Verdict::NotRun => "not run",
        Verdict::Ours => "not the student's fault",
    }
}

/// A kind of finding as it stands in a report.
pub fn finding(kind: FindingKind) -> &'static str {
    match kind {
        FindingKind::Wrong => "wrong",
        FindingKind::Antialiased => "anti-aliased",
        FindingKind::Contested => "look at this",
        FindingKind::Crash => "crashed",
        FindingKind::Timeout => "took too long",
        FindingKind::Memory => "took too much memory",
        FindingKind::Output => "wrote too much",
        FindingKind::Unreadable => "wrote what cannot be read",
        FindingKind::Size => "wrong size",
        FindingKind::Missing => "wrote nothing",
        FindingKind::Todo => "still to be written",
        FindingKind::Build => "does not build",
        FindingKind::Submission => "no submission",
        FindingKind::Remark => "remark",
        FindingKind::Internal => "fault of the grader or the machine",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_no_needless_zeros() {
        for (thousandths, text) in [(0, "0"), (150_000, "150"), (43_250, "43.25"), (5, "0.005"), (1_200, "1.2")] {
            assert_eq!(points(thousandths), text);
        }
    }
}
