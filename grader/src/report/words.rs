//! Formats verdicts, findings, points and times for people.

use crate::record::{FindingKind, Verdict};

/// Returns the earned part of the possible points as text, from thousandths of a point:
/// `43.25 of 50`.
///
/// Two decimals are shown and the rest is cut off, so that a part never looks like the whole. If
/// that would leave nothing of a part, its thousandths are shown.
pub fn share(earned: u64, possible: u64) -> String {
    let short = |thousandths: u64| match thousandths / 10 * 10 {
        0 => points(thousandths),
        hundredths => points(hundredths),
    };
    format!("{} of {}", short(earned), short(possible))
}

/// Formats thousandths of a point exactly, without trailing zeros: `43.25`.
pub fn points(thousandths: u64) -> String {
    let text = format!("{}.{:03}", thousandths / 1000, thousandths % 1000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Formats a time in the unit that suits it: `40 ms`, `2.5 s`.
pub fn seconds(time_s: f64) -> String {
    if time_s < 0.0995 { format!("{:.0} ms", time_s * 1e3) } else { format!("{time_s:.1} s") }
}

/// Returns the word for a verdict in reports.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "right",
        Verdict::Partial => "partly right",
        Verdict::Fail => "failed",
        Verdict::NotRun => "not run",
        Verdict::Ours => "not the student's fault",
    }
}

/// Returns the words for a kind of finding in reports.
pub fn finding(kind: FindingKind) -> &'static str {
    match kind {
        FindingKind::Wrong => "wrong",
        FindingKind::Antialiased => "anti-aliased",
        FindingKind::Contested => "look at this",
        FindingKind::Nondeterministic => "two runs differ",
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
    fn two_decimals_are_shown_and_none_are_made_up() {
        let table = [
            ((43_250, 50_000), "43.25 of 50"),
            ((24_999, 25_000), "24.99 of 25"),
            ((6_643, 9_000), "6.64 of 9"),
            ((5, 166), "0.005 of 0.16"),
            ((0, 25_000), "0 of 25"),
            ((u64::MAX, 1), "18446744073709551.61 of 0.001"),
        ];
        for ((earned, possible), text) in table {
            assert_eq!(share(earned, possible), text);
        }
    }

    #[test]
    fn points_have_no_needless_zeros() {
        for (thousandths, text) in
            [(0, "0"), (150_000, "150"), (43_250, "43.25"), (5, "0.005"), (1_200, "1.2")]
        {
            assert_eq!(points(thousandths), text);
        }
    }
}
