//! The report as CSV, for other programs.

use pages::plain::csv_cell;
use serde::{Serialize, Serializer};

use super::error::Error;
use super::report::{EffectRow, Report, SettingRow};
use super::setting::Setting;
use super::times::Times;
use crate::watch::Counts;

/// One line of the file. The names of the fields are the header; `None` is an empty cell.
#[derive(Serialize)]
struct Line<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    what: &'a str,
    precision: &'static str,
    formula: &'static str,
    samples: u32,
    adaptive: bool,
    max_depth: u32,
    threshold: Decimal,
    light_cutoff: Decimal,
    median_ms: Decimal,
    least_ms: Decimal,
    greatest_ms: Decimal,
    rounds: usize,
    rays_eye: u64,
    rays_shadow: u64,
    rays_reflected: u64,
    rays_refracted: u64,
    bytes: Option<usize>,
    rms_levels: Option<Decimal>,
    max_levels: Option<Decimal>,
    rms_light: Option<Decimal>,
    max_light: Option<Decimal>,
    off_share: Option<Decimal>,
    changed_share: Option<Decimal>,
    on_front: Option<bool>,
    as_it_stands: Option<bool>,
    pick: Option<bool>,
    left_out_at_most: Option<Decimal>,
}

/// A number that is written as a decimal without an exponent. For floats themselves, the CSV writer
/// has another format: `500.0` instead of `500`, and `1e-7`.
struct Decimal(f64);

impl Serialize for Decimal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

/// Returns the report as CSV: a header, a line for each setting of each question, a line for each
/// setting that belongs to no question, then a line for each effect. The column `what` names the
/// question, and the errors are those of that question. Cells without a value are empty. A report
/// without settings and effects gives an empty file.
///
/// # Errors
/// Returns the errors of the writer. A writer into memory has none.
pub fn csv(report: &Report) -> Result<Vec<u8>, csv::Error> {
    let scene = csv_cell(&report.scene);
    let mut out = csv::Writer::from_writer(Vec::new());
    for question in &report.questions {
        for one in &question.rows {
            out.serialize(Line {
                what: question.about.word(),
                on_front: Some(one.is_on_front),
                as_it_stands: Some(one.is_own),
                pick: Some(one.is_pick),
                ..with_error(of_setting(report, &scene, &report.rows[one.row]), one.error)
            })?;
        }
    }
    for row in report.others() {
        out.serialize(of_setting(report, &scene, row))?;
    }
    for EffectRow { name, time_ms, rays, error, .. } in &report.effects {
        let line = measured(report, &scene, &report.own, *time_ms, *rays);
        out.serialize(Line { what: name, ..with_error(line, *error) })?;
    }
    out.into_inner().map_err(|why| why.into_error().into())
}

fn of_setting<'a>(report: &Report, scene: &'a str, row: &SettingRow) -> Line<'a> {
    Line {
        bytes: Some(row.bytes),
        left_out_at_most: row.left_out_at_most.map(Decimal),
        ..measured(report, scene, &row.setting, row.time_ms, row.rays)
    }
}

fn with_error(line: Line<'_>, error: Error) -> Line<'_> {
    Line {
        rms_levels: Some(Decimal(error.rms_levels)),
        max_levels: Some(Decimal(error.max_levels)),
        rms_light: Some(Decimal(error.rms_light)),
        max_light: Some(Decimal(error.max_light)),
        off_share: Some(Decimal(error.off)),
        changed_share: Some(Decimal(error.changed)),
        ..line
    }
}

/// Returns a line without errors.
fn measured<'a>(
    report: &Report,
    scene: &'a str,
    setting: &Setting,
    time_ms: Times,
    rays: Counts,
) -> Line<'a> {
    Line {
        scene,
        width: report.width,
        height: report.height,
        what: "other",
        precision: setting.precision.says(),
        formula: setting.formula.name(),
        samples: setting.samples,
        adaptive: setting.adaptive,
        max_depth: setting.max_depth,
        threshold: Decimal(setting.threshold),
        light_cutoff: Decimal(setting.light_cutoff),
        median_ms: Decimal(time_ms.median),
        least_ms: Decimal(time_ms.least),
        greatest_ms: Decimal(time_ms.greatest),
        rounds: report.rounds,
        rays_eye: rays.eye,
        rays_shadow: rays.shadow,
        rays_reflected: rays.reflected,
        rays_refracted: rays.refracted,
        bytes: None,
        rms_levels: None,
        max_levels: None,
        rms_light: None,
        max_light: None,
        off_share: None,
        changed_share: None,
        on_front: None,
        as_it_stands: None,
        pick: None,
        left_out_at_most: None,
    }
}
