//! The report as a table for other programs.

use super::report::{Report, Row};
use super::setting::Setting;

const HEAD: [&str; 32] = [
    "scene",
    "width",
    "height",
    "what",
    "precision",
    "formula",
    "samples",
    "max_depth",
    "threshold",
    "median_ms",
    "least_ms",
    "greatest_ms",
    "rounds",
    "rays_eye",
    "rays_shadow",
    "rays_reflected",
    "rays_refracted",
    "bytes",
    "rms_levels",
    "max_levels",
    "rms_light",
    "max_light",
    "off_share",
    "changed_share",
    "same_rays_rms_levels",
    "same_rays_max_levels",
    "same_rays_changed_share",
    "on_front",
    "on_same_rays_front",
    "left_out_at_most",
    "rounding_max_levels",
    "rounding_changed_share",
];

/// A line a setting, then a line an effect; what an effect has none of stays empty.
///
/// # Errors
/// None that can happen while memory takes it all; the writer's are handed on.
pub fn csv(report: &Report) -> Result<Vec<u8>, csv::Error> {
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record(HEAD)?;
    for row in &report.rows {
        out.write_record(line(report, row))?;
    }
    for effect in &report.effects {
        let row = Row {
            name: String::new(),
            setting: report.own,
            time_ms: effect.time_ms,
            rays: effect.rays,
            bytes: 0,
            left_out_at_most: None,
            error: effect.error,
            same_rays: effect.error,
            rounding: None,
            is_on_front: false,
            is_on_same_rays_front: false,
        };
        let mut line = line(report, &row);
        line[3].clone_from(&effect.name);
        for empty in [17, 24, 25, 26, 27, 28] {
            line[empty].clear();
        }
        out.write_record(line)?;
    }
    out.into_inner().map_err(|why| why.into_error().into())
}

fn line(report: &Report, row: &Row) -> Vec<String> {
    let Setting { precision, formula, samples, max_depth, threshold, .. } = row.setting;
    let mut line = vec![
        harmless(&report.scene),
        report.width.to_string(),
        report.height.to_string(),
        "setting".to_owned(),
    ];
    line.extend([precision.says().to_owned(), formula.name().to_owned()]);
    line.extend([samples, max_depth].map(|n| n.to_string()));
    line.extend(
        [threshold, row.time_ms.median, row.time_ms.least, row.time_ms.greatest]
            .map(|x| x.to_string()),
    );
    line.push(report.rounds.to_string());
    let rays = row.rays;
    line.extend(
        [rays.eye, rays.shadow, rays.reflected, rays.refracted, row.bytes as u64]
            .map(|n| n.to_string()),
    );
    let (error, same) = (row.error, row.same_rays);
    line.extend(
        [
            error.rms_levels,
            error.max_levels,
            error.rms_light,
            error.max_light,
            error.off,
            error.changed,
            same.rms_levels,
            same.max_levels,
            same.changed,
        ]
        .map(|x| x.to_string()),
    );
    line.extend([row.is_on_front, row.is_on_same_rays_front].map(|is_on| is_on.to_string()));
    line.push(row.left_out_at_most.map_or_else(String::new, |most| most.to_string()));
    let rounding =
        [row.rounding.map(|error| error.max_levels), row.rounding.map(|error| error.changed)];
    line.extend(rounding.map(|x| x.map_or_else(String::new, |x| x.to_string())));
    line
}

/// A name that no spreadsheet takes for a formula.
fn harmless(name: &str) -> String {
    if name.starts_with(['=', '+', '-', '@']) { format!("'{name}") } else { name.to_owned() }
}
