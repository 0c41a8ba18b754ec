//! The report as text for a terminal.

use std::fmt::Write;

use pages::figures::{figure, percent};

use super::error::Error;
use super::figures::signed;
use super::report::{EffectRow, Question, Report, SettingRow};
use super::times::Times;

const BOLD: &str = "\x1b[1m";
const SOFT: &str = "\x1b[2m";
const PLAIN: &str = "\x1b[0m";

/// Returns the headline, a table and the sentences of each question, all other settings, and the
/// effects. The text has escape codes, which the stream removes if it is not a terminal.
pub fn text(report: &Report) -> String {
    let mut out = head(report);
    let _ = writeln!(out, "\n{BOLD}{}{PLAIN}", report.headline);
    for question in &report.questions {
        out += &answered(question);
    }
    let others: Vec<&SettingRow> = report.others().collect();
    if !others.is_empty() {
        out += &other_settings(others);
    }
    if !report.effects.is_empty() {
        out += &effects(report);
    }
    for fact in &report.facts {
        let _ = writeln!(out, "{fact}");
    }
    if report.is_cut_short {
        let _ = writeln!(
            out,
            "\nStopped before all rounds were complete: these results are from {} of them.",
            report.rounds
        );
    }
    if !report.machine.is_optimised {
        out += "\nThis program was compiled without optimisation: measure with `cargo run \
            --release`.\n";
    }
    out
}

fn head(report: &Report) -> String {
    let Report { scene, width, height, machine, rounds, .. } = report;
    format!(
        "{BOLD}{scene}{PLAIN}, {width}×{height}; medians of {rounds} interleaved rounds, {} of {} \
            thread{}, {}\n",
        machine.clock,
        machine.threads,
        if machine.threads == 1 { "" } else { "s" },
        machine.processor
    )
}

fn answered(question: &Question) -> String {
    let width = question.rows.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!("\n{BOLD}{}{PLAIN}\n", question.about.title());
    for sentence in [&question.answer].into_iter().filter(|text| !text.is_empty()) {
        let _ = writeln!(out, "{sentence}");
    }
    let _ = writeln!(
        out,
        "\n  {:<width$}  {:>8} {:>15}  {:>7}  {:>8} {:>8} {:>7} {:>8}",
        "setting", "ms", "least–most", "time", "RMS", "greatest", ">1/255", "changed"
    );
    for row in &question.rows {
        let front = if row.is_on_front { "*" } else { " " };
        let (on, off) = if row.is_own || row.is_pick { (BOLD, PLAIN) } else { ("", "") };
        let mark = match (row.is_own, row.is_pick) {
            (true, true) => "  as it stands, pick",
            (true, false) => "  as it stands",
            (false, true) => "  pick",
            (false, false) => "",
        };
        let _ = writeln!(
            out,
            "{front} {on}{:<width$}{off}  {:>8} {:>15}  {:>7}  {:>8} {:>8} {:>7} {:>8}{mark}",
            row.name,
            figure(row.time_ms.median),
            spread(&row.time_ms),
            percent(row.of_own),
            figure(row.error.rms_levels),
            figure(row.error.max_levels),
            percent(row.error.off),
            percent(row.error.changed),
        );
    }
    let _ = writeln!(
        out,
        "{SOFT}Errors are against {}, in 8-bit levels. *: on the Pareto front of time and \
            RMS.{PLAIN}",
        question.against
    );
    for fact in &question.facts {
        let _ = writeln!(out, "{fact}");
    }
    out
}

fn spread(times: &Times) -> String {
    format!("{}–{}", figure(times.least), figure(times.greatest))
}

/// Returns the settings that belong to no question, sorted by time, with their errors by rounding.
fn other_settings(mut rows: Vec<&SettingRow>) -> String {
    rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!(
        "\n  {:<width$}  {:>8} {:>15}  {:>8} {:>8}\n",
        "other settings", "ms", "least–most", "greatest", "changed"
    );
    for row in rows {
        let rounding = |text: fn(f64) -> String, of: fn(&Error) -> f64| {
            row.rounding.as_ref().map_or_else(String::new, |error| text(of(error)))
        };
        let _ = writeln!(
            out,
            "  {:<width$}  {:>8} {:>15}  {:>8} {:>8}",
            row.name,
            figure(row.time_ms.median),
            spread(&row.time_ms),
            rounding(figure, |error| error.max_levels),
            rounding(percent, |error| error.changed),
        );
    }
    let _ = writeln!(
        out,
        "{SOFT}Errors are those of rounding: against f64 robust with everything else equal.{PLAIN}"
    );
    out
}

fn effects(report: &Report) -> String {
    let width = report.effects.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!(
        "\n  {:<width$}  {:>8} {:>15}  {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>8} {:>8}\n",
        "effects",
        "ms",
        "least–most",
        "more ms",
        "eye",
        "shadow",
        "reflected",
        "refracted",
        "changed",
        "greatest"
    );
    for EffectRow { name, time_ms, more_ms, rays, error, .. } in &report.effects {
        let _ = writeln!(
            out,
            "  {name:<width$}  {:>8} {:>15}  {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>8} {:>8}",
            figure(time_ms.median),
            spread(time_ms),
            signed(*more_ms),
            rays.eye,
            rays.shadow,
            rays.reflected,
            rays.refracted,
            percent(error.changed),
            figure(error.max_levels),
        );
    }
    let _ = writeln!(out, "{SOFT}Compared with the scene as it stands: {}.{PLAIN}", report.own);
    out
}
