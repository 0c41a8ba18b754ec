//! Builds a report from the measurements of a sweep.

use cases::Scene;
use cases::front::on_front;
use pages::plain;

use super::advice;
use super::measure::Measured;
use super::report::{EffectRow, Machine, Report, SettingRow};
use super::sweep::{About, Sweep};
use crate::rules::Rules;
use crate::trace::cutoff::Limits;

impl Report {
    /// Returns the report of `measured`, for `scene` by `rules`. `n_rounds` is the number of rounds
    /// that were requested; with fewer, the report is marked as cut short.
    pub fn new(
        name: &str,
        scene: &Scene,
        rules: &Rules,
        machine: Machine,
        sweep: &Sweep,
        measured: &[Measured],
        n_rounds: usize,
    ) -> Self {
        let rounds = measured.first().map_or(0, |row| row.times_s.len());
        let mut report = Self {
            schema: 1,
            scene: one_line(name),
            width: scene.render.width,
            height: scene.render.height,
            machine,
            rounds,
            own: sweep.own,
            truth: sweep.truth,
            is_cut_short: rounds < n_rounds,
            advice: Vec::new(),
            rows: rows(sweep, measured, &Limits::of(scene, rules, sweep.own.effects)),
            effects: effects(sweep, measured),
        };
        report.advice = advice::advice(&report);
        report
    }
}

/// Returns a row for each setting, with both fronts marked.
fn rows(sweep: &Sweep, measured: &[Measured], limits: &Limits) -> Vec<SettingRow> {
    let mut rows: Vec<SettingRow> = measured
        .iter()
        .filter(|one| one.about == About::Accuracy)
        .map(|one| row(one, limits))
        .collect();
    let all: Vec<(f64, f64)> =
        rows.iter().map(|row| (row.time_ms.median, three_digits(row.error.rms_levels))).collect();
    let outside = (f64::NAN, f64::NAN);
    let same = |row: &SettingRow| (row.time_ms.median, three_digits(row.same_rays.rms_levels));
    let same: Vec<_> = rows
        .iter()
        .map(|row| if row.setting.samples == sweep.own.samples { same(row) } else { outside })
        .collect();
    for ((row, is_on), is_on_same) in rows.iter_mut().zip(on_front(&all)).zip(on_front(&same)) {
        (row.is_on_front, row.is_on_same_rays_front) = (is_on, is_on_same);
    }
    rows
}

/// Rounds an error to three digits, so that two errors that print alike count as equal.
fn three_digits(error: f64) -> f64 {
    format!("{error:.2e}").parse().unwrap_or(error)
}

/// Returns the row of a setting, not yet marked as on a front.
fn row(one: &Measured, limits: &Limits) -> SettingRow {
    SettingRow {
        name: one.setting.to_string(),
        setting: one.setting,
        time_ms: one.time_ms(),
        rays: one.stats.rays,
        bytes: one.bytes,
        left_out_at_most: Some(limits.of_weight(one.stats.left_out.into()).max_element())
            .filter(|most| most.is_finite()),
        error: one.error,
        same_rays: one.same_rays,
        rounding: one.rounding,
        is_on_front: false,
        is_on_same_rays_front: false,
    }
}

/// Returns the rows of effects, compared with the scene's own setting.
fn effects(sweep: &Sweep, measured: &[Measured]) -> Vec<EffectRow> {
    let own = measured.iter().find(|one| one.about == About::Accuracy && one.setting == sweep.own);
    let own_ms = own.map_or(f64::NAN, |own| own.time_ms().median);
    let row = |one: &Measured| {
        let (name, without) = match one.about {
            About::Accuracy => return None,
            About::Without(effect) => (format!("without {effect}"), Some(effect)),
            About::Everything => ("with all effects".to_owned(), None),
        };
        let time_ms = one.time_ms();
        let more_ms = time_ms.median - own_ms;
        Some(EffectRow { name, without, time_ms, more_ms, rays: one.stats.rays, error: one.error })
    };
    measured.iter().filter_map(row).collect()
}

/// Returns the name of a scene as reports show it: guarded, with line breaks and tabs as codes, so
/// that no name adds a line to a report.
fn one_line(name: &str) -> String {
    plain::shown(name).replace('\n', "\\u{a}").replace('\t', "\\u{9}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_adds_no_line() {
        assert_eq!(one_line("ball.toml"), "ball.toml");
        assert_eq!(one_line("a\n## b\tc"), "a\\u{a}## b\\u{9}c");
        assert!(!one_line("a\r\u{2028}\u{202e}b").contains(['\r', '\u{2028}', '\u{202e}']));
    }
}
