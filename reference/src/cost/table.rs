//! The report as text for a terminal.

use std::fmt::Write;

use cases::film::level;

use super::report::{EffectRow, Report, Row};

const BOLD: &str = "\x1b[1m";
const SOFT: &str = "\x1b[2m";
const PLAIN: &str = "\x1b[0m";

/// The tables and the advice. Escape codes are for a stream that takes them out where there is no terminal.
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
        let _ = writeln!(out, "Stopped before all rounds were done: what stands here is of {} of them.", report.rounds);
    }
    if !report.machine.is_optimised {
        out += "This program was compiled without optimisation: measure with `cargo run --release`.\n";
    }
    out
}

fn head(report: &Report) -> String {
    let Report { scene, width, height, machine, rounds, .. } = report;
    format!(
        "{BOLD}{scene}{PLAIN}, {width}×{height}; medians of {rounds} interleaved rounds, {} of {} thread{}, {}\n",
        machine.clock,
        machine.threads,
        if machine.threads == 1 { "" } else { "s" },
        machine.processor
    )
}

fn accuracy(report: &Report) -> String {
    let mut rows: Vec<&Row> = report.rows.iter().collect();
    rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!(
        "\n  {:<width$}  {:>8} {:>15}  {:>9} {:>8}  {:>8} {:>8} {:>7}  {:>8} {:>8}  {:>8}\n",
        "setting", "ms", "least–most", "rays", "KiB", "RMS", "greatest", ">1/255", "changed", "greatest", "rounding"
    );
    for row in rows {
        let mark = if row.is_on_front { "*" } else { " " };
        let same = if row.is_on_same_rays_front { "+" } else { " " };
        let (on, off) = if row.is_on_front { (BOLD, PLAIN) } else { ("", "") };
        let _ = writeln!(
            out,
            "{mark} {on}{:<width$}{off}  {:>8} {:>15}  {:>9} {:>8}  {:>8} {:>8} {:>7}  {:>8} {:>8}  {:>8} {same}",
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
        "{SOFT}RMS, greatest, >1/255: against {}, in 8-bit levels. * no setting is faster and nearer to it.\n\
         changed, greatest: 8-bit pixels that differ from the most accurate picture with as many rays a pixel; + the front by that, of {n}×{n}.\n\
         rounding: greatest difference from f64 robust, all else the same: what precision and formulas alone do.{PLAIN}",
        report.truth
    );
    out
}

fn effects(report: &Report) -> String {
    let width = report.effects.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    let mut out = format!(
        "\n  {:<width$}  {:>8} {:>15}  {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>8} {:>8}\n",
        "effects", "ms", "least–most", "more ms", "eye", "shadow", "reflected", "refracted", "changed", "greatest"
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
    let _ = writeln!(out, "{SOFT}Against the scene as it stands: {}.{PLAIN}", report.own);
    out
}

/// Three significant digits; small and large numbers with an exponent.
pub fn figure(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        a if !(1e-3..1e7).contains(&a) => format!("{x:.1e}"),
        a if a < 1.0 => format!("{x:.3}"),
        a if a < 10.0 => format!("{x:.2}"),
        a if a < 100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// A share in percent; what is above 0 never reads as 0, and what is below 1 never as all.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0 %".to_owned(),
        p if p < 0.01 => "<0.01 %".to_owned(),
        p if p < 10.0 => format!("{p:.2} %"),
        p if p < 100.0 => format!("{:.1} %", p.min(99.9)),
        p => format!("{p:.0} %"),
    }
}

/// Linear light on the scale of 8-bit levels, without an end.
pub fn levels(light: f64) -> f64 {
    light * level(1.0)
}

fn signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", figure(x)) } else { figure(x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        for (x, text) in [
            (0.0, "0"),
            (1.2345e-5, "1.2e-5"),
            (0.01234, "0.012"),
            (1.2345, "1.23"),
            (12.345, "12.3"),
            (1234.5, "1234"),
            (1.2e8, "1.2e8"),
            (-3.456, "-3.46"),
        ] {
            assert_eq!(figure(x), text);
        }
    }

    #[test]
    fn a_share_is_all_or_nothing_only_where_it_is() {
        for (share, text) in
            [(0.0, "0 %"), (1e-6, "<0.01 %"), (0.01234, "1.23 %"), (0.5, "50.0 %"), (0.99999, "99.9 %"), (1.0, "100 %")]
        {
            assert_eq!(percent(share), text);
        }
    }
}
