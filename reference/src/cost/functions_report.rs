//! The report on single functions, and its output formats.

use std::fmt::Write;

use cases::front::on_front;
use pages::figures::figure;
use pages::page::context;
use serde::Serialize;

use super::forms::Forms;
use super::functions::Measured;
use super::page;
use super::plot::{self, Place, Plot, Point, Shape};
use super::report::Machine;
use super::times::Times;
use crate::expect::variations::Precision;
use crate::hard::SurveyCounts;

/// The cost of accuracy, function by function.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionsReport {
    /// The version of this format.
    pub schema: u32,
    /// The machine that it was measured on.
    pub machine: Machine,
    /// The number of questions a family.
    pub draws: u64,
    /// The number of times that each formula was timed.
    pub rounds: usize,
    /// One row for each function, formula and precision.
    pub rows: Vec<FunctionRow>,
}

/// A function, computed by one formula in one precision.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionRow {
    /// The name of the function, such as `sphere`.
    pub function: &'static str,
    /// The formula in words.
    pub formula: &'static str,
    /// The precision of its scalars.
    pub precision: Precision,
    /// Nanoseconds an answer to generic questions.
    pub ns: Times,
    /// Nanoseconds an answer over all families in equal parts.
    pub hard_ns: Times,
    /// The sum over all families.
    #[serde(flatten)]
    pub all: Counts,
    /// Whether the row is on the Pareto front of its function, by generic time and error. A wrong
    /// decision counts as an error of 1, and so does any greater error.
    pub is_on_front: bool,
    /// The families of the function, one by one.
    pub families: Vec<FamilyRow>,
}

/// The result of one family.
#[derive(Clone, Debug, Serialize)]
pub struct FamilyRow {
    /// The name of the family, such as `sphere, far`.
    pub family: &'static str,
    /// The result.
    #[serde(flatten)]
    pub counts: Counts,
}

/// The result of many questions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// The number of questions.
    pub n: u64,
    /// Wrong decisions that no rounding of the question excuses, including answers with NaN.
    pub wrong: u64,
    /// Hits where the oracle has a miss.
    pub false_hits: u64,
    /// Misses where the oracle has a hit.
    pub false_misses: u64,
    /// Hits at another place.
    pub elsewhere: u64,
    /// Answers with NaN.
    pub not_a_number: u64,
    /// Wrong decisions that are right for a question with one number moved to its neighbour.
    pub doubtful: u64,
    /// The greatest relative error of a correct decision.
    pub max_error: f64,
    /// The greatest relative error in units of the last place of 1, in the precision of the row.
    pub ulps: f64,
}

impl Counts {
    fn of(tally: &SurveyCounts, precision: Precision) -> Self {
        let ulps = match precision {
            Precision::F32 => tally.ulps::<f32>(),
            Precision::F64 => tally.ulps::<f64>(),
        };
        Self {
            n: tally.n,
            wrong: tally.wrong(),
            false_hits: tally.false_hits,
            false_misses: tally.false_misses,
            elsewhere: tally.elsewhere,
            not_a_number: tally.not_a_number,
            doubtful: tally.doubtful,
            max_error: tally.max_error(),
            ulps,
        }
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
            ulps: self.ulps.max(other.ulps),
        }
    }

    /// Returns one number for both kinds of error: 1 if any decision is wrong, otherwise the
    /// greatest error, but at most 1.
    fn loss(&self) -> f64 {
        if self.wrong > 0 { 1.0 } else { self.max_error.min(1.0) }
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
        Self { schema: 1, machine, draws, rounds, rows }
    }

    /// Returns the picture of one function.
    pub fn plot(&self, function: &str) -> Plot {
        let rows = self.rows.iter().filter(|row| row.function == function);
        Plot {
            title: format!("{function}: error against time"),
            x: "nanoseconds an answer, generic questions (median; the line: least to greatest)"
                .to_owned(),
            y: "greatest relative error; a wrong decision is 1".to_owned(),
            line: plot::FRONT,
            key: vec![
                (Shape::Circle, false, "robust"),
                (Shape::Square, false, "other formulas"),
                (Shape::Circle, true, "hollow: f32"),
            ],
            points: rows.map(point).collect(),
        }
    }
}

fn names(rows: &[FunctionRow]) -> Vec<&'static str> {
    let mut names: Vec<_> = rows.iter().map(|row| row.function).collect();
    names.dedup();
    names
}

fn row(one: &Measured) -> FunctionRow {
    let precision = one.candidate.precision;
    let family = |(family, tally): &(&'static str, SurveyCounts)| FamilyRow {
        family,
        counts: Counts::of(tally, precision),
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

fn point(row: &FunctionRow) -> Point {
    let name = format!("{} {}", row.precision.says(), row.formula);
    Point {
        x: row.ns.median,
        spread: (row.ns.least, row.ns.greatest),
        y: row.all.loss(),
        shape: if row.formula == "robust" { Shape::Circle } else { Shape::Square },
        is_hollow: row.precision == Precision::F32,
        is_on_front: row.is_on_front,
        hover: format!(
            "{name}\n{} ns ({} to {}), over all families {} ns\n{} wrong of {}, {} ulps",
            figure(row.ns.median),
            figure(row.ns.least),
            figure(row.ns.greatest),
            figure(row.hard_ns.median),
            row.all.wrong,
            row.all.n,
            figure(row.all.ulps)
        ),
        label: name,
    }
}

const HEAD: [&str; 19] = [
    "function",
    "formula",
    "precision",
    "family",
    "n",
    "wrong",
    "false_hits",
    "false_misses",
    "elsewhere",
    "not_a_number",
    "doubtful",
    "max_error",
    "ulps",
    "ns",
    "least_ns",
    "greatest_ns",
    "hard_ns",
    "least_hard_ns",
    "greatest_hard_ns",
];

impl Forms for FunctionsReport {
    fn text(&self) -> String {
        let mut out = format!(
            "{} questions a family, {} rounds, {}\n\n\
                * {:<18} {:<33} {:<4} {:>8} {:>8}  {:>9} {:>7} {:>9}  {:>9}\n",
            self.draws,
            self.rounds,
            self.machine.processor,
            "function",
            "formula",
            "",
            "ns",
            "hard ns",
            "questions",
            "wrong",
            "doubtful",
            "ulps"
        );
        for row in &self.rows {
            let _ = writeln!(
                out,
                "{} {:<18} {:<33} {:<4} {:>8} {:>8}  {:>9} {:>7} {:>9}  {:>9}",
                if row.is_on_front { "*" } else { " " },
                row.function,
                row.formula,
                row.precision.says(),
                figure(row.ns.median),
                figure(row.hard_ns.median),
                row.all.n,
                row.all.wrong,
                row.all.doubtful,
                figure(row.all.ulps),
            );
        }
        out += "ns: time of an answer to generic questions; hard ns: over all families. wrong: \
            decisions that no rounding of the question excuses.\n\
                doubtful: decisions that are correct for a question one rounding away. ulps: \
                greatest error of the correct decisions, in units of the last place of 1.\n\
                *: on the Pareto front of its function; a wrong decision is an error of 1.\n";
        if !self.machine.is_optimised {
            out += "This program was compiled without optimisation: measure with `cargo run \
                --release`.\n";
        }
        out
    }

    fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut out = csv::Writer::from_writer(Vec::new());
        out.write_record(HEAD)?;
        for row in &self.rows {
            for FamilyRow { family, counts } in &row.families {
                let mut line = [row.function, row.formula, row.precision.says(), family]
                    .map(str::to_owned)
                    .to_vec();
                let numbers = [
                    counts.n,
                    counts.wrong,
                    counts.false_hits,
                    counts.false_misses,
                    counts.elsewhere,
                    counts.not_a_number,
                    counts.doubtful,
                ];
                line.extend(numbers.map(|n| n.to_string()));
                line.extend([counts.max_error, counts.ulps].map(|x| x.to_string()));
                line.extend(
                    [row.ns, row.hard_ns]
                        .iter()
                        .flat_map(|t| [t.median, t.least, t.greatest])
                        .map(|x| x.to_string()),
                );
                out.write_record(line)?;
            }
        }
        out.into_inner().map_err(|why| why.into_error().into())
    }

    fn plots(&self) -> Vec<Plot> {
        names(&self.rows).into_iter().map(|function| self.plot(function)).collect()
    }

    fn page(&self) -> String {
        let plots: Vec<String> =
            self.plots().iter().map(|plot| plot::svg(plot, Place::Page)).collect();
        page::render(include_str!("functions.html"), self, &plots, context! {})
    }
}
