//! Advice on which setting to pick, in sentences.

use pages::figures::{figure, percent};

use super::figures::levels;
use super::report::{Report, SettingRow};
use super::setting::{Formula, Setting};
use crate::expect::variations::Precision;

/// Returns the sentences of a report.
///
/// They name the cheapest setting that changes no 8-bit pixel, the next step below it, the error
/// and the bound of the scene's own setting, and the gain of more rays a pixel. Without a row for
/// the scene's own setting there are none.
pub(super) fn advice(report: &Report) -> Vec<String> {
    let Some(own) = report.row(&report.own) else { return Vec::new() };
    let same: Vec<&SettingRow> =
        report.rows.iter().filter(|row| row.setting.samples == own.setting.samples).collect();
    let mut sentences = Vec::new();
    let cheapest = least(same.iter().filter(|row| row.same_rays.changed == 0.0).copied(), |row| {
        row.time_ms.median
    });
    if let Some(pick) = cheapest {
        sentences.push(pick_it(pick, own, &same));
        sentences.extend(step_below(pick, &same));
    }
    sentences.extend(own_error(own));
    sentences.extend(proven(own));
    sentences.extend(samples(report));
    sentences
}

fn least<'a>(
    rows: impl Iterator<Item = &'a SettingRow>,
    by: impl Fn(&SettingRow) -> f64,
) -> Option<&'a SettingRow> {
    rows.min_by(|a, b| by(a).total_cmp(&by(b)))
}

fn pick_it(pick: &SettingRow, own: &SettingRow, same: &[&SettingRow]) -> String {
    let n = own.setting.samples;
    let mut text = format!(
        "Pick {}: {} ms. It is the cheapest setting with {n}×{n} rays a pixel that changes no \
            8-bit pixel of the most accurate picture with as many rays.",
        pick.name,
        figure(pick.time_ms.median)
    );
    if pick.setting != own.setting {
        let share = pick.time_ms.median / own.time_ms.median;
        text += &format!(
            " The scene's own setting ({}) takes {} ms; this is {} of that.",
            own.name,
            figure(own.time_ms.median),
            percent(share)
        );
    }
    let is_as_fast = |row: &&&SettingRow| {
        row.setting != pick.setting
            && row.same_rays.changed == 0.0
            && row.time_ms.least <= pick.time_ms.greatest
    };
    let n_others = same.iter().filter(is_as_fast).count();
    if n_others > 0 {
        text += &if n_others == 1 {
            " 1 other setting changes none either; the times of the two overlap, so they are not \
                distinguished."
                .to_owned()
        } else {
            format!(
                " {n_others} other settings change none either; their times overlap, so they are \
                    not distinguished."
            )
        };
    }
    text
}

fn step_below(pick: &SettingRow, same: &[&SettingRow]) -> Option<String> {
    let cheaper = same
        .iter()
        .filter(|row| row.time_ms.median < pick.time_ms.median && row.same_rays.changed > 0.0);
    let next = least(cheaper.copied(), |row| row.same_rays.rms_levels)?;
    Some(format!(
        "The next step below is {}: {} ms; it changes {} of the pixels, {} by more than 1/255, \
            the worst by {} levels.",
        next.name,
        figure(next.time_ms.median),
        percent(next.same_rays.changed),
        percent(next.same_rays.off),
        figure(next.same_rays.max_levels)
    ))
}

fn own_error(own: &SettingRow) -> Option<String> {
    (own.same_rays.changed > 0.0).then(|| {
        format!(
            "The scene's own setting is not deep enough: a greater depth or no threshold changes \
                {} of its pixels, the worst by {} levels.",
            percent(own.same_rays.changed),
            figure(own.same_rays.max_levels)
        )
    })
}

fn proven(own: &SettingRow) -> Option<String> {
    let sends_on = own.rays.reflected + own.rays.refracted > 0;
    let text = match own.left_out_at_most {
        Some(0.0) | None if !sends_on => return None,
        Some(0.0) => "Proven: the scene's own setting leaves out no ray.".to_owned(),
        Some(most) => {
            let levels = figure(levels(most));
            format!(
                "Proven: the rays that the scene's own setting leaves out darken no pixel by more \
                    than {levels} levels."
            )
        }
        None => "No bound is known for the rays that are left out: some surface passes on all \
            light that it receives (kr + kt is not below 1)."
            .to_owned(),
    };
    Some(text)
}

/// Returns the sentence on more rays a pixel. It compares settings with f64, the robust formulas
/// and the truth's depth, whose only error is that of sampling. `None` if there are fewer than two
/// such settings, or no error.
fn samples(report: &Report) -> Option<String> {
    let exact = |row: &&SettingRow| {
        let s = &row.setting;
        let truth = Setting { samples: s.samples, ..report.truth };
        *s == truth
            && s.precision == Precision::F64
            && s.formula == Formula::Robust
            && *s != report.truth
    };
    let mut rows: Vec<&SettingRow> = report.rows.iter().filter(exact).collect();
    rows.sort_by_key(|row| row.setting.samples);
    let (first, last) = (rows.first()?, rows.last()?);
    if first.setting.samples == last.setting.samples || last.error.rms_levels == 0.0 {
        return None;
    }
    let step = |row: &&SettingRow| {
        let n = row.setting.samples;
        format!("{n}×{n} {} ms and {}", figure(row.time_ms.median), figure(row.error.rms_levels))
    };
    let steps: Vec<String> = rows.iter().map(step).collect();
    let ln = |x: f64| cases::maths::ln(x);
    let order = ln(first.error.rms_levels / last.error.rms_levels)
        / ln(f64::from(last.setting.samples) / f64::from(first.setting.samples));
    let n = report.truth.samples;
    Some(format!(
        "More rays a pixel, against {n}×{n}: {} levels (root mean square). The error falls as the \
            number of rays a side to the power −{}.",
        steps.join(", "),
        figure(order)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::error::Error;
    use crate::cost::report::Machine;
    use crate::cost::times::Times;
    use crate::watch::Counts;
    use cases::Effects;

    const OWN: Setting = Setting {
        precision: Precision::F64,
        formula: Formula::Robust,
        samples: 1,
        max_depth: 2,
        threshold: 0.0,
        effects: Effects::NONE,
    };
    const TRUTH: Setting = Setting { samples: 8, max_depth: 4, ..OWN };

    /// Returns a row that takes `ms` ± 1 ms, with the share `changed` of changed pixels, and with
    /// the RMS error `rms` against the truth.
    fn row(setting: Setting, ms: f64, changed: f64, rms: f64) -> SettingRow {
        SettingRow {
            name: setting.to_string(),
            setting,
            time_ms: Times { median: ms, least: ms - 1.0, greatest: ms + 1.0 },
            rays: Counts { reflected: 1, ..Counts::default() },
            bytes: 0,
            left_out_at_most: None,
            error: Error { rms_levels: rms, ..Error::default() },
            same_rays: Error {
                changed,
                rms_levels: changed,
                max_levels: 100.0 * changed,
                ..Error::default()
            },
            rounding: None,
            is_on_front: false,
            is_on_same_rays_front: false,
        }
    }

    fn said(rows: Vec<SettingRow>) -> Vec<String> {
        let machine =
            Machine { processor: String::new(), threads: 1, clock: "", is_optimised: true };
        let report = Report {
            schema: 1,
            scene: String::new(),
            width: 1,
            height: 1,
            machine,
            rounds: 1,
            own: OWN,
            truth: TRUTH,
            is_cut_short: false,
            advice: Vec::new(),
            rows,
            effects: Vec::new(),
        };
        advice(&report)
    }

    fn depth(max_depth: u32) -> Setting {
        Setting { max_depth, ..OWN }
    }

    #[test]
    fn the_cheapest_that_changes_nothing_is_picked_and_the_next_one_below_named() {
        let single = Setting { precision: Precision::F32, ..OWN };
        let all = said(vec![
            row(OWN, 40.0, 0.0, 3.0),
            row(single, 20.0, 0.0, 3.0),
            row(depth(1), 15.0, 0.25, 3.0),
            row(depth(0), 10.0, 0.5, 3.0),
            row(TRUTH, 900.0, 0.0, 0.0),
        ]);
        assert!(
            all[0].starts_with("Pick f32 robust, 1×1, depth 2: 20.0 ms. It is the cheapest"),
            "{all:?}"
        );
        assert!(
            all[0].contains("takes 40.0 ms; this is 50.0 % of that.")
                && !all[0].contains("overlap"),
            "{all:?}"
        );
        assert!(
            all[1].starts_with(
                "The next step below is f64 robust, 1×1, depth 1: 15.0 ms; it changes 25.0 %"
            ),
            "{all:?}"
        );
        assert!(all[2].starts_with("No bound is known for the rays"), "{all:?}");
        assert_eq!(all.len(), 3, "one number of samples gives no sentence on samples: {all:?}");
    }

    #[test]
    fn a_scene_that_is_not_deep_enough_is_reported_and_equals_are_counted() {
        let bound = SettingRow { left_out_at_most: Some(0.01), ..row(OWN, 40.0, 0.125, 4.0) };
        let all = said(vec![bound, row(depth(4), 50.0, 0.0, 4.0), row(depth(3), 51.0, 0.0, 4.0)]);
        assert!(
            all[0].starts_with("Pick f64 robust, 1×1, depth 4")
                && all[0].contains("1 other setting changes none either"),
            "{all:?}"
        );
        assert!(
            all[2].starts_with("The scene's own setting is not deep enough")
                && all[2].contains("12.5 %"),
            "{all:?}"
        );
        assert!(all[3].contains("darken no pixel by more than 2.55 levels"), "{all:?}");
    }

    #[test]
    fn the_gain_of_samples_is_a_power() {
        let exact = |samples| Setting { samples, ..TRUTH };
        let all = said(vec![
            row(OWN, 10.0, 0.0, 8.0),
            row(exact(1), 10.0, 0.0, 8.0),
            row(exact(2), 40.0, 0.0, 4.0),
            row(exact(4), 160.0, 0.0, 2.0),
            row(TRUTH, 640.0, 0.0, 0.0),
        ]);
        let last = all.last().unwrap();
        assert!(
            last.contains("1×1 10.0 ms and 8.00, 2×2 40.0 ms and 4.00, 4×4 160 ms and 2.00"),
            "{last}"
        );
        assert!(last.ends_with("to the power −1.00."), "{last}");
    }
}
