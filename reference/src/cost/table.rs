//! The report as text for a terminal.

use std::fmt::Write;

use pages::figures::{figure, percent};

use super::figures::signed;
use super::report::{EffectRow, Report, SettingRow};

const BOLD: &str = "\x1b[1m";
const SOFT: &str = "\x1b[2m";
const PLAIN: &str = "\x1b[0m";

/// Returns the tables and the advice. The text has escape codes, which the stream removes if it is
/// not a terminal.
pub fn text(report: &Report) -> String {
    let mut out = head(report);
    out += &accuracy(report);
    if !report.effects.is_empty() {
        out += &effects(report);
    }
    out.push('\n');
    for sentence in &report.advice {
        let _ = writeln!(out, "{sentence}");
    }
    if report.is_cut_short {
        let _ = writeln!(
            out,
            "Stopped before all rounds were complete: these results are from {} of them.",
            report.rounds
        );
    }
    if !report.machine.is_optimised {
        out +=
            "This program was compiled without optimisation: measure with `cargo run --release`.\n";
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

fn accuracy(report: &Report) -> String {
    let mut rows: Vec<&SettingRow> = report.rows.iter().collect();
    rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!(
        "\n  {:<width$}  {:>8} {:>15}  {:>9} {:>8}  {:>8} {:>8} {:>7}  {:>8} {:>8}  {:>8}\n",
        "setting",
        "ms",
        "least–most",
        "rays",
        "KiB",
        "RMS",
        "greatest",
        ">1/255",
        "changed",
        "greatest",
        "rounding"
    );
    for row in rows {
        let mark = if row.is_on_front { "*" } else { " " };
        let same = if row.is_on_same_rays_front { "+" } else { " " };
        let (on, off) = if row.is_on_front { (BOLD, PLAIN) } else { ("", "") };
        let _ = writeln!(
            out,
            "{mark} {on}{:<width$}{off}  {:>8} {:>15}  {:>9} {:>8}  {:>8} {:>8} {:>7}  {:>8} \
                {:>8}  {:>8} {same}",
            row.name,
            figure(row.time_ms.median),
            format!("{}–{}", figure(row.time_ms.least), figure(row.time_ms.greatest)),
            row.rays.total(),
            row.bytes.div_ceil(1024),
            figure(row.error.rms_levels),
            figure(row.error.max_levels),
            percent(row.error.off),
            percent(row.same_rays.changed),
            figure(row.same_rays.max_levels),
            row.rounding.map_or_else(String::new, |error| figure(error.max_levels)),
        );
    }
    let n = report.own.samples;
    let _ = writeln!(
        out,
        "{SOFT}RMS, greatest, >1/255: error against {}, in 8-bit levels. *: on the Pareto front \
            of time and RMS.\n\
         changed, greatest: 8-bit pixels that differ from the most accurate picture with as many \
         rays a pixel. +: on the Pareto front of this error, among {n}×{n}.\n\
         rounding: greatest difference from f64 robust with everything else equal, the error of \
         precision and formulas alone.{PLAIN}",
        report.truth
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
            format!("{}–{}", figure(time_ms.least), figure(time_ms.greatest)),
            signed(*more_ms),
            rays.eye,
            rays.shadow,
            rays.reflected,
            rays.refracted,
            percent(error.changed),
            figure(error.max_levels),
        );
    }
    let _ = writeln!(out, "{SOFT}Compared with the scene's own setting: {}.{PLAIN}", report.own);
    out
}
