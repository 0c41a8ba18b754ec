//! The report as a self-contained HTML page: no network, no script.

use pages::figures::{figure, percent};
use pages::page::{Layout, Serde, Value, context, html};
use serde::Serialize;

use super::plot::{self, Place, Plot, Point, Shape};
use super::report::{Report, SettingRow};
use super::setting::Formula;
use crate::expect::variations::Precision;

const TEMPLATE: &str = include_str!("page.html");
const LOOK: &str = include_str!("page.css");

/// Returns the two pictures of a report. The first one shows errors against the truth, the second
/// one errors against the most accurate picture with as many rays a pixel as the scene's own
/// setting.
pub fn plots(report: &Report) -> [Plot; 2] {
    let n = report.own.samples;
    let plot = |title: String, y: String, points: Vec<Point>| Plot {
        title,
        x: "milliseconds a picture (median; the line: least to greatest)".to_owned(),
        y,
        line: plot::FRONT,
        key: vec![
            (Shape::Circle, false, "robust"),
            (Shape::Square, false, "stable"),
            (Shape::Triangle, false, "plain"),
            (Shape::Circle, true, "hollow: f32"),
        ],
        points,
    };
    let truth = report.rows.iter().map(|row| point(row, row.error.rms_levels, row.is_on_front));
    let is_own = |row: &&SettingRow| row.setting.samples == n;
    let same = report
        .rows
        .iter()
        .filter(is_own)
        .map(|row| point(row, row.same_rays.rms_levels, row.is_on_same_rays_front));
    [
        plot(
            format!("{}: error against time", report.scene),
            format!(
                "RMS error in 8-bit levels, against {0}×{0} rays a pixel",
                report.truth.samples
            ),
            truth.collect(),
        ),
        plot(
            format!("{}: error of precision, formula, depth and threshold, {n}×{n}", report.scene),
            format!("RMS error in 8-bit levels, against the most accurate {n}×{n}"),
            same.collect(),
        ),
    ]
}

fn point(row: &SettingRow, error: f64, is_on_front: bool) -> Point {
    let shape = match row.setting.formula {
        Formula::Robust => Shape::Circle,
        Formula::Stable => Shape::Square,
        Formula::Plain => Shape::Triangle,
    };
    let (time, rays) = (row.time_ms, row.rays.total());
    Point {
        x: time.median,
        spread: (time.least, time.greatest),
        y: error,
        shape,
        is_hollow: row.setting.precision == Precision::F32,
        is_on_front,
        label: row.name.clone(),
        hover: format!(
            "{}\n{} ms ({} to {}), {rays} rays\n\
                RMS {} levels, greatest {}, {} of the pixels changed",
            row.name,
            figure(time.median),
            figure(time.least),
            figure(time.greatest),
            figure(error),
            figure(row.error.max_levels),
            percent(row.error.changed),
        ),
    }
}

/// Returns the report as an HTML page, with the rows sorted by time.
pub fn page(report: &Report) -> String {
    let plots = plots(report).map(|plot| plot::svg(&plot, Place::Page));
    let mut sorted = report.clone();
    sorted.rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    let names = context! { own => report.own.to_string(), truth => report.truth.to_string() };
    render(TEMPLATE, &sorted, &plots, names)
}

/// Returns `template` rendered with `report`, `plots` and `names`, in the style of these pages.
pub(super) fn render(
    template: &str,
    report: &impl Serialize,
    plots: &[String],
    names: Value,
) -> String {
    let style = format!("{LOOK}{}", plot::STYLE);
    let report = Value::from(Serde(report));
    let values = context! { plots => plots.to_vec(), report, names };
    html(Layout { template, style: &style, script: "" }, &values)
}
