//! The report as CSV, for other programs.

use pages::plain::csv_cell;
use serde::{Serialize, Serializer};

use super::error::Error;
use super::report::{EffectRow, Report, SettingRow};
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
    max_depth: u32,
    threshold: Decimal,
    median_ms: Decimal,
    least_ms: Decimal,
    greatest_ms: Decimal,
    rounds: usize,
    rays_eye: u64,
    rays_shadow: u64,
    rays_reflected: u64,
    rays_refracted: u64,
    bytes: Option<usize>,
    rms_levels: Decimal,
    max_levels: Decimal,
    rms_light: Decimal,
    max_light: Decimal,
    off_share: Decimal,
    changed_share: Decimal,
    same_rays_rms_levels: Option<Decimal>,
    same_rays_max_levels: Option<Decimal>,
    same_rays_changed_share: Option<Decimal>,
    on_front: Option<bool>,
    on_same_rays_front: Option<bool>,
    left_out_at_most: Option<Decimal>,
    rounding_max_levels: Option<Decimal>,
    rounding_changed_share: Option<Decimal>,
}

/// A number that is written as a decimal without an exponent. For floats themselves, the CSV writer
/// has another format: `500.0` instead of `500`, and `1e-7`.
struct Decimal(f64);

impl Serialize for Decimal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

/// Returns the report as CSV: a header, a line for each setting, then a line for each effect.
/// Columns that an effect has no value for are empty. A report without settings and effects gives
/// an empty file.
///
/// # Errors
/// Returns the errors of the writer. A writer into memory has none.
pub fn csv(report: &Report) -> Result<Vec<u8>, csv::Error> {
    let scene = csv_cell(&report.scene);
    let mut out = csv::Writer::from_writer(Vec::new());
    for row in &report.rows {
        out.serialize(of_setting(report, &scene, row))?;
    }
    for effect in &report.effects {
        out.serialize(of_effect(report, &scene, effect))?;
    }
    out.into_inner().map_err(|why| why.into_error().into())
}

fn of_setting<'a>(report: &Report, scene: &'a str, row: &SettingRow) -> Line<'a> {
    let same = row.same_rays;
    Line {
        what: "setting",
        precision: row.setting.precision.says(),
        formula: row.setting.formula.name(),
        samples: row.setting.samples,
        max_depth: row.setting.max_depth,
        threshold: Decimal(row.setting.threshold),
        bytes: Some(row.bytes),
        same_rays_rms_levels: Some(Decimal(same.rms_levels)),
        same_rays_max_levels: Some(Decimal(same.max_levels)),
        same_rays_changed_share: Some(Decimal(same.changed)),
        on_front: Some(row.is_on_front),
        on_same_rays_front: Some(row.is_on_same_rays_front),
        left_out_at_most: row.left_out_at_most.map(Decimal),
        rounding_max_levels: row.rounding.map(|error| Decimal(error.max_levels)),
        rounding_changed_share: row.rounding.map(|error| Decimal(error.changed)),
        ..measured(report, scene, row.time_ms, row.rays, row.error)
    }
}

/// Returns the line of an effect. Its setting is the scene's own.
fn of_effect<'a>(report: &Report, scene: &'a str, effect: &'a EffectRow) -> Line<'a> {
    let EffectRow { name, time_ms, rays, error, .. } = effect;
    Line { what: name, ..measured(report, scene, *time_ms, *rays, *error) }
}

/// Returns a line with the columns that settings and effects share, and with the scene's own
/// setting.
fn measured<'a>(
    report: &Report,
    scene: &'a str,
    time_ms: Times,
    rays: Counts,
    error: Error,
) -> Line<'a> {
    let own = report.own;
    Line {
        scene,
        width: report.width,
        height: report.height,
        what: "",
        precision: own.precision.says(),
        formula: own.formula.name(),
        samples: own.samples,
        max_depth: own.max_depth,
        threshold: Decimal(own.threshold),
        median_ms: Decimal(time_ms.median),
        least_ms: Decimal(time_ms.least),
        greatest_ms: Decimal(time_ms.greatest),
        rounds: report.rounds,
        rays_eye: rays.eye,
        rays_shadow: rays.shadow,
        rays_reflected: rays.reflected,
        rays_refracted: rays.refracted,
        bytes: None,
        rms_levels: Decimal(error.rms_levels),
        max_levels: Decimal(error.max_levels),
        rms_light: Decimal(error.rms_light),
        max_light: Decimal(error.max_light),
        off_share: Decimal(error.off),
        changed_share: Decimal(error.changed),
        same_rays_rms_levels: None,
        same_rays_max_levels: None,
        same_rays_changed_share: None,
        on_front: None,
        on_same_rays_front: None,
        left_out_at_most: None,
        rounding_max_levels: None,
        rounding_changed_share: None,
    }
}
