//! The report on single functions, and its output formats.

use std::fmt::Write;

use pages::figures::figure;
use pages::page::context;
use serde::Serialize;

use super::forms::Forms;
use super::page;
use super::plot::{self, Place, Plot, Point, Shape};
use super::report::Machine;
use super::times::Times;
use crate::expect::variations::Precision;

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
    /// What the formulas cost over all functions, in one sentence. After one round, the sentence
    /// gives the reason why there is no advice.
    pub headline: String,
    /// A sentence on each function: which formula to pick.
    pub advice: Vec<String>,
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
    /// The decimal digits that every correct decision has: the negative logarithm of `max_error`,
    /// at least 0. Its unit is the same in both precisions. `None` if there is no error at all.
    pub digits: Option<f64>,
}

impl Counts {
    /// Returns these counts with the digits that their greatest error leaves.
    pub(super) fn with_digits(self) -> Self {
        let digits = -cases::maths::ln(self.max_error) / std::f64::consts::LN_10;
        Self { digits: (self.max_error > 0.0).then_some(digits.max(0.0)), ..self }
    }

    /// Returns the digits in words.
    pub(super) fn digits_text(&self) -> String {
        self.digits.map_or_else(|| "all digits".to_owned(), |digits| format!("{digits:.1} digits"))
    }

    /// Returns one number for both kinds of error: 1 if any decision is wrong, otherwise the
    /// greatest error, but at most 1.
    pub(super) fn loss(&self) -> f64 {
        if self.wrong > 0 { 1.0 } else { self.max_error.min(1.0) }
    }
}

impl FunctionsReport {
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

/// Returns the functions of rows, in their order.
pub(super) fn names(rows: &[FunctionRow]) -> Vec<&'static str> {
    let mut names: Vec<_> = rows.iter().map(|row| row.function).collect();
    names.dedup();
    names
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
        is_own: false,
        is_pick: false,
        link: None,
        hover: format!(
            "{name}\n{} ns ({} to {}), over all families {} ns\n{} wrong of {}, {}",
            figure(row.ns.median),
            figure(row.ns.least),
            figure(row.ns.greatest),
            figure(row.hard_ns.median),
            row.all.wrong,
            row.all.n,
            row.all.digits_text()
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
    "digits",
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
            "digits"
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
                row.all.digits.map_or("all".to_owned(), |digits| format!("{digits:.1}")),
            );
        }
        out += "ns: time of an answer to generic questions; hard ns: over all families. wrong: \
            decisions that no rounding of the question excuses.\n\
                doubtful: decisions that are correct for a question one rounding away. digits: \
                decimal digits that every correct decision has, in both precisions alike.\n\
                *: on the Pareto front of its function; a wrong decision is an error of 1.\n";
        out += &format!("\n{}\n", self.headline);
        for sentence in &self.advice {
            out += &format!("{sentence}\n");
        }
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
                line.push(counts.max_error.to_string());
                line.push(counts.digits.map_or_else(String::new, |digits| digits.to_string()));
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
