//! Builds a report on single functions from the measurements.

use cases::front::on_front;

use super::functions::Measured;
use super::functions_advice;
use super::functions_report::{Counts, FamilyRow, FunctionRow, FunctionsReport, names};
use super::report::Machine;
use crate::hard::SurveyCounts;

impl Counts {
    fn of(tally: &SurveyCounts) -> Self {
        Self {
            n: tally.n,
            wrong: tally.wrong(),
            false_hits: tally.false_hits,
            false_misses: tally.false_misses,
            elsewhere: tally.elsewhere,
            not_a_number: tally.not_a_number,
            doubtful: tally.doubtful,
            max_error: tally.max_error(),
            digits: None,
        }
        .with_digits()
    }

    fn and(self, other: &Self) -> Self {
        Self {
            n: self.n + other.n,
            wrong: self.wrong + other.wrong,
            false_hits: self.false_hits + other.false_hits,
            false_misses: self.false_misses + other.false_misses,
            elsewhere: self.elsewhere + other.elsewhere,
            not_a_number: self.not_a_number + other.not_a_number,
            doubtful: self.doubtful + other.doubtful,
            max_error: self.max_error.max(other.max_error),
            digits: None,
        }
        .with_digits()
    }
}

impl FunctionsReport {
    /// Returns the report of `measured`, with `draws` questions a family.
    pub fn new(machine: Machine, measured: &[Measured], draws: u64) -> Self {
        let rounds = measured.first().map_or(0, |one| one.rounds);
        let mut rows: Vec<FunctionRow> = measured.iter().map(row).collect();
        for function in names(&rows) {
            let of: Vec<usize> =
                (0..rows.len()).filter(|n| rows[*n].function == function).collect();
            let points: Vec<(f64, f64)> =
                of.iter().map(|n| (rows[*n].ns.median, rows[*n].all.loss())).collect();
            for (n, is_on) in of.into_iter().zip(on_front(&points)) {
                rows[n].is_on_front = is_on;
            }
        }
        let (headline, advice) = (String::new(), Vec::new());
        let mut report = Self { schema: 2, machine, draws, rounds, headline, advice, rows };
        (report.headline, report.advice) = functions_advice::advice(&report);
        report
    }
}

fn row(one: &Measured) -> FunctionRow {
    let precision = one.candidate.precision;
    let family = |(family, tally): &(&'static str, SurveyCounts)| FamilyRow {
        family,
        counts: Counts::of(tally),
    };
    let families: Vec<FamilyRow> = one.tallies.iter().map(family).collect();
    FunctionRow {
        function: one.candidate.function,
        formula: one.candidate.formula,
        precision,
        ns: one.ns,
        hard_ns: one.hard_ns,
        all: families.iter().fold(Counts::default(), |all, row| all.and(&row.counts)),
        is_on_front: false,
        families,
    }
}
