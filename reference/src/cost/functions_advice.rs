//! Advice on which formula to pick for each function.

use pages::figures::{figure, percent};

use super::functions_report::{FunctionRow, FunctionsReport, names};
use super::times::Times;
use crate::expect::variations::Precision;

/// The name of the reference's own formulas.
const OWN: &str = "robust";

/// Returns a headline over all functions and a sentence on each function, in the order of `report`.
///
/// After fewer than two rounds the headline gives the reason why there is no advice, and there are
/// no sentences: a single time has no spread.
pub(super) fn advice(report: &FunctionsReport) -> (String, Vec<String>) {
    if report.rounds < 2 {
        let text = "Figures without advice: the times of one round have no spread.";
        return (text.to_owned(), Vec::new());
    }
    let functions: Vec<Vec<&FunctionRow>> = names(&report.rows)
        .into_iter()
        .map(|name| report.rows.iter().filter(|row| row.function == name).collect())
        .collect();
    let sentences = functions.iter().filter_map(|rows| sentence(rows)).collect();
    (headline(report, &functions), sentences)
}

fn headline(report: &FunctionsReport, functions: &[Vec<&FunctionRow>]) -> String {
    let tally = |is_own: bool| {
        let rows = report.rows.iter().filter(|row| (row.formula == OWN) == is_own);
        rows.fold((0, 0), |(wrong, n), row| (wrong + row.all.wrong, n + row.all.n))
    };
    let wrong = |name: &str, (wrong, n): (u64, u64)| {
        (n > 0).then(|| format!("{name} are wrong in {wrong} of {n} decisions"))
    };
    let parts: Vec<String> = [
        wrong("The robust formulas", tally(true)),
        wrong("the other formulas", tally(false)),
        overtaken(functions),
    ]
    .into_iter()
    .flatten()
    .collect();
    format!("{}.", parts.join("; "))
}

/// Returns words for the number of functions in which another formula is distinctly faster than the
/// robust one of the same precision. `None` if none of them has both.
fn overtaken(functions: &[Vec<&FunctionRow>]) -> Option<String> {
    let pairs = |rows: &[&FunctionRow]| -> Vec<(Times, Times)> {
        let own: Vec<&&FunctionRow> = rows.iter().filter(|row| row.formula == OWN).collect();
        let others = rows.iter().filter(|row| row.formula != OWN);
        others
            .filter_map(|other| {
                let own = own.iter().find(|own| own.precision == other.precision)?;
                Some((other.ns, own.ns))
            })
            .collect()
    };
    let compared: Vec<_> =
        functions.iter().map(|rows| pairs(rows)).filter(|pairs| !pairs.is_empty()).collect();
    let is_faster = |(other, own): &(Times, Times)| other.is_less_than(own);
    let n = compared.iter().filter(|pairs| pairs.iter().any(is_faster)).count();
    (!compared.is_empty()).then(|| {
        format!(
            "another formula is faster beyond the spread of the times in {n} of {} functions",
            compared.len()
        )
    })
}

/// Returns the sentence on a function: the formula to pick in its greatest precision, the fastest
/// one that is distinctly faster, and the same formula in single precision.
fn sentence(rows: &[&FunctionRow]) -> Option<String> {
    let has_double = rows.iter().any(|row| row.precision == Precision::F64);
    let precision = if has_double { Precision::F64 } else { Precision::F32 };
    let of: Vec<&FunctionRow> =
        rows.iter().copied().filter(|row| row.precision == precision).collect();
    let pick = pick(&of)?;
    let mut text =
        format!("{}: pick {} {}, {}", pick.function, precision.says(), pick.formula, result(pick));
    let faster = of.iter().filter(|row| row.ns.is_less_than(&pick.ns));
    if let Some(fast) = faster.min_by(|a, b| a.ns.median.total_cmp(&b.ns.median)) {
        let less = percent(1.0 - fast.ns.median / pick.ns.median);
        text += &format!(
            "; {} takes {less} less time, with {} and {}",
            fast.formula,
            fast.all.digits_text(),
            decisions(fast)
        );
    }
    let is_single = |row: &&&FunctionRow| row.formula == pick.formula && row.precision != precision;
    if let Some(single) = rows.iter().find(is_single) {
        text += &format!("; in {} {}", single.precision.says(), result(single));
    }
    Some(text + ".")
}

/// Returns the row to pick among those with the fewest wrong decisions. Rows that have a digit less
/// than the best of these are left aside. The fastest counts, or the one with the least error among
/// those that are not distinctly slower.
fn pick<'a>(rows: &[&'a FunctionRow]) -> Option<&'a FunctionRow> {
    let wrong = rows.iter().map(|row| row.all.wrong).min()?;
    let right = || rows.iter().copied().filter(|row| row.all.wrong == wrong);
    let least = right().map(|row| row.all.max_error).fold(f64::INFINITY, f64::min);
    let best = || right().filter(|row| row.all.max_error <= 10.0 * least);
    let fastest = best().min_by(|a, b| a.ns.median.total_cmp(&b.ns.median))?;
    best()
        .filter(|row| !fastest.ns.is_less_than(&row.ns))
        .min_by(|a, b| a.all.max_error.total_cmp(&b.all.max_error))
}

fn result(row: &FunctionRow) -> String {
    format!("{} ns with {} and {}", figure(row.ns.median), row.all.digits_text(), decisions(row))
}

fn decisions(row: &FunctionRow) -> String {
    match row.all.wrong {
        0 => "no wrong decision".to_owned(),
        1 => "1 wrong decision".to_owned(),
        wrong => format!("{wrong} wrong decisions"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::functions_report::Counts;
    use crate::cost::report::Machine;

    fn row(
        formula: &'static str,
        precision: Precision,
        ns: f64,
        wrong: u64,
        error: f64,
    ) -> FunctionRow {
        let spread = Times { median: ns, least: ns - 1.0, greatest: ns + 1.0 };
        FunctionRow {
            function: "sphere",
            formula,
            precision,
            ns: spread,
            hard_ns: spread,
            all: Counts { n: 100, wrong, max_error: error, ..Counts::default() }.with_digits(),
            is_on_front: false,
            families: Vec::new(),
        }
    }

    fn said(rounds: usize, rows: Vec<FunctionRow>) -> (String, Vec<String>) {
        let machine =
            Machine { processor: String::new(), threads: 1, clock: "", is_optimised: true };
        let headline = String::new();
        let none = Vec::new();
        advice(&FunctionsReport {
            schema: 2,
            machine,
            draws: 1,
            rounds,
            headline,
            advice: none,
            rows,
        })
    }

    #[test]
    fn the_fastest_that_decides_rightly_is_picked() {
        use Precision::{F32, F64};
        let rows = || {
            vec![
                row("robust", F64, 20.0, 0, 1e-15),
                row("robust", F32, 19.0, 0, 1e-6),
                row("textbook", F64, 10.0, 7, 1e-15),
                row("stable", F64, 30.0, 0, 1e-15),
            ]
        };
        let (headline, sentences) = said(2, rows());
        assert_eq!(
            headline,
            "The robust formulas are wrong in 0 of 200 decisions; the other formulas are wrong in \
                7 of 200 decisions; another formula is faster beyond the spread of the times in 1 \
                of 1 functions."
        );
        assert_eq!(
            sentences,
            ["sphere: pick f64 robust, 20.0 ns with 15.0 digits and no wrong decision; textbook \
                takes 50.0 % less time, with 15.0 digits and 7 wrong decisions; in f32 19.0 ns \
                with 6.0 digits and no wrong decision."]
        );
        let (headline, sentences) = said(1, rows());
        assert!(headline.starts_with("Figures without advice") && sentences.is_empty());
    }

    #[test]
    fn where_times_overlap_the_smaller_error_counts() {
        use Precision::F64;
        let rows = vec![row("robust", F64, 20.5, 0, 1e-16), row("stable", F64, 20.0, 0, 1e-12)];
        let (headline, sentences) = said(2, rows);
        assert!(headline.contains("in 0 of 1 functions"), "{headline}");
        assert_eq!(
            sentences,
            ["sphere: pick f64 robust, 20.5 ns with 16.0 digits and no wrong decision."]
        );
    }

    #[test]
    fn a_formula_that_loses_digits_is_not_picked_for_its_speed() {
        let rows = vec![
            row("robust", Precision::F64, 20.0, 0, 1e-14),
            row("nearest", Precision::F64, 10.0, 0, 1e-2),
        ];
        let (_, sentences) = said(2, rows);
        assert_eq!(
            sentences,
            ["sphere: pick f64 robust, 20.0 ns with 14.0 digits and no wrong decision; nearest \
                takes 50.0 % less time, with 2.0 digits and no wrong decision."]
        );
    }
}
