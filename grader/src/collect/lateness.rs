//! Computes how late a hand-in is and what that costs. All points are integers, in thousandths.

use super::moment::Moment;
use super::policy::{Amount, Deduction, Of, Policy};
use super::roster::Extension;

/// How late a hand-in is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lateness {
    /// Seconds after the student's deadline; 0 if the hand-in is in time or within the grace.
    pub late_s: u64,
    /// The number of units of time that have started since the deadline.
    pub n_units: u64,
}

impl Lateness {
    /// The lateness of a hand-in that is in time.
    pub const NONE: Self = Self { late_s: 0, n_units: 0 };
}

/// Returns the deadline of a student. An extension never makes it earlier.
pub fn due(policy: &Policy, extension: Option<Extension>) -> Moment {
    let deadline = policy.deadline.moment;
    match extension {
        None => deadline,
        Some(Extension::By(seconds)) => {
            let seconds = i64::try_from(seconds).unwrap_or(i64::MAX);
            Moment { unix_s: deadline.unix_s.saturating_add(seconds) }
        }
        Some(Extension::Until(moment)) => moment.max(deadline),
    }
}

/// Returns how late a hand-in is. Once the grace is over, all time since the deadline counts.
pub fn lateness(policy: &Policy, due: Moment, handed_in: Moment) -> Lateness {
    let late_s = u64::try_from(handed_in.unix_s.saturating_sub(due.unix_s)).unwrap_or(0);
    if late_s <= policy.grace_s {
        return Lateness::NONE;
    }
    let n_units = policy.deduction.map_or(0, |deduction| late_s.div_ceil(deduction.unit_s));
    Lateness { late_s, n_units }
}

/// Returns the deduction, rounded down, which is at most `earned`.
pub fn deduction(policy: &Policy, lateness: Lateness, earned: u64, possible: u64) -> u64 {
    let Some(Deduction { amount, of, maximum, .. }) = policy.deduction else { return 0 };
    let base = match of {
        Of::Earned => earned,
        Of::Possible => possible,
    };
    let points = |amount: Amount, n: u64| match amount {
        // A product that is too large for the type is more than all points in any case.
        Amount::Share(share) => {
            let share = u128::from(share) * u128::from(n);
            u128::from(base).saturating_mul(share) / 100_000
        }
        Amount::Points(points) => u128::from(points) * u128::from(n),
    };
    let most = maximum.map_or(u128::from(earned), |maximum| points(maximum, 1));
    let deduction = points(amount, lateness.n_units).min(most).min(u128::from(earned));
    u64::try_from(deduction).unwrap_or(earned)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::collect::moment::Clock;

    fn policy(rest: &str) -> Policy {
        let text = format!("deadline = 2026-10-05T23:59:00+02:00\n{rest}");
        Policy::parse("late.toml", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
    }

    fn moment(text: &str) -> Moment {
        Clock::parse(text).expect("a moment").moment
    }

    #[test]
    fn started_units_count_after_the_grace() {
        let per_day = policy("grace = \"15 min\"\ndeduct = \"10 %\"\nper = \"day\"");
        let per_hour = policy("grace = \"90 min\"\ndeduct = \"1 point\"\nper = \"hour\"");
        for (policy, handed_in, late_s, n_units) in [
            (&per_day, "2026-10-05 23:59:00 +02:00", 0, 0),
            (&per_day, "2026-10-05 21:59:01 Z", 0, 0),
            (&per_day, "2026-10-06 00:14:00 +02:00", 0, 0),
            (&per_day, "2026-10-06 00:14:01 +02:00", 901, 1),
            (&per_day, "2026-10-06 23:59:00 +02:00", 86_400, 1),
            (&per_day, "2026-10-06 23:59:01 +02:00", 86_401, 2),
            (&per_hour, "2026-10-06 01:29:00 +02:00", 0, 0),
            (&per_hour, "2026-10-06 01:29:01 +02:00", 5_401, 2),
            (&per_hour, "2020-01-01 00:00 Z", 0, 0),
        ] {
            let due = due(policy, None);
            let found = lateness(policy, due, moment(handed_in));
            assert_eq!((found.late_s, found.n_units), (late_s, n_units), "{handed_in}");
        }
    }

    #[test]
    fn an_extension_moves_the_deadline_back_only() {
        let policy = policy("");
        for (extension, expected) in [
            (None, "2026-10-05 23:59 +02:00"),
            (Some(Extension::By(3600)), "2026-10-06 00:59 +02:00"),
            (Some(Extension::Until(moment("2026-10-08 12:00 +02:00"))), "2026-10-08 12:00 +02:00"),
            (Some(Extension::Until(moment("2026-10-01 12:00 +02:00"))), "2026-10-05 23:59 +02:00"),
        ] {
            assert_eq!(due(&policy, extension), moment(expected), "{extension:?}");
        }
    }

    #[test]
    fn deductions_are_exact_and_bounded() {
        let day = "\nper = \"day\"\n";
        for (rest, n_units, earned, expected) in [
            (format!("deduct = \"10 %\"{day}"), 1, 43_250, 4_325),
            (format!("deduct = \"10 %\"{day}"), 3, 43_255, 12_976),
            (format!("deduct = \"10 %\"{day}"), 11, 43_250, 43_250),
            (format!("deduct = \"10 %\"{day}of = \"possible\""), 2, 43_250, 10_000),
            (format!("deduct = \"10 %\"{day}of = \"possible\""), 2, 4_000, 4_000),
            (format!("deduct = \"10 %\"{day}maximum = \"25 %\""), 9, 40_000, 10_000),
            (format!("deduct = \"2.5 points\"{day}"), 2, 40_000, 5_000),
            (format!("deduct = \"2.5 points\"{day}maximum = \"6 points\""), 3, 40_000, 6_000),
            (format!("deduct = \"33.333 %\"{day}"), 1, 1, 0),
            (String::new(), 5, 40_000, 0),
            (format!("deduct = \"10 %\"{day}"), 0, 40_000, 0),
            (format!("deduct = \"100 %\"{day}"), u64::MAX, u64::MAX, u64::MAX),
        ] {
            let late = Lateness { late_s: 1, n_units };
            assert_eq!(deduction(&policy(&rest), late, earned, 50_000), expected, "{rest}");
        }
    }

    proptest! {
        #[test]
        fn later_never_costs_less(
            earned in 0_u64..200_000, one in 0_u64..2_000, more in 0_u64..2_000,
        ) {
            let policy = policy("deduct = \"7.5 %\"\nper = \"hour\"\nmaximum = \"60 %\"");
            let cost = |n_units| {
                deduction(&policy, Lateness { late_s: 1, n_units }, earned, 200_000)
            };
            prop_assert!(cost(one) <= cost(one + more));
            prop_assert!(cost(one + more) <= earned * 6 / 10);
        }
    }
}
