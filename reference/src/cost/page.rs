//! The report as a self-contained HTML page: no network, no script.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use pages::figures::{figure, percent};
use pages::page::{Layout, Serde, Value, context, html};
use serde::Serialize;

use super::plot::{self, Place, Plot, Point, Shape};
use super::report::{Question, QuestionRow, Report};
use super::setting::Formula;
use crate::expect::variations::Precision;

const TEMPLATE: &str = include_str!("page.html");
const LOOK: &str = include_str!("page.css");

/// Returns a picture of each question: its error against time.
pub fn plots(report: &Report) -> Vec<Plot> {
    report.questions.iter().map(|question| plot(report, question)).collect()
}

fn plot(report: &Report, question: &Question) -> Plot {
    let has_numbers = |row: &QuestionRow| {
        (row.setting.formula, row.setting.precision) != (Formula::Robust, Precision::F64)
    };
    let key = if question.rows.iter().any(has_numbers) {
        vec![
            (Shape::Circle, false, "robust"),
            (Shape::Square, false, "stable"),
            (Shape::Triangle, false, "plain"),
            (Shape::Circle, true, "hollow: f32"),
        ]
    } else {
        Vec::new()
    };
    Plot {
        title: format!("{}: {}", report.scene, question.about.word()),
        x: "milliseconds a picture (median; the line: least to greatest)".to_owned(),
        y: "RMS error in 8-bit levels".to_owned(),
        line: plot::FRONT,
        key,
        points: question.rows.iter().map(|row| point(question, row)).collect(),
    }
}

fn point(question: &Question, row: &QuestionRow) -> Point {
    let shape = match row.setting.formula {
        Formula::Robust => Shape::Circle,
        Formula::Stable => Shape::Square,
        Formula::Plain => Shape::Triangle,
    };
    let (time, error) = (row.time_ms, row.error);
    Point {
        x: time.median,
        spread: (time.least, time.greatest),
        y: error.rms_levels,
        shape,
        is_hollow: row.setting.precision == Precision::F32,
        is_on_front: row.is_on_front,
        is_own: row.is_own,
        is_pick: row.is_pick,
        label: row.name.clone(),
        hover: format!(
            "{}\n{} ms ({} to {})\nRMS {} levels, greatest {}, {} of the pixels changed",
            row.setting,
            figure(time.median),
            figure(time.least),
            figure(time.greatest),
            figure(error.rms_levels),
            figure(error.max_levels),
            percent(error.changed),
        ),
        link: row.picture.as_ref().map(|_| id(question, row)),
    }
}

/// Returns the identifier on the page of the picture of an error. Equal pictures have one, which is
/// that of the first row.
fn id(question: &Question, row: &QuestionRow) -> String {
    let first = question.rows.iter().find(|other| other.picture == row.picture).unwrap_or(row);
    format!("{}-{}", question.about.word(), first.row)
}

/// A picture of an error as the page shows it.
#[derive(Serialize)]
struct Shown {
    id: String,
    /// The names of the settings whose errors are these.
    name: String,
    uri: String,
    gain: f64,
    width: u32,
    height: u32,
    changed: f64,
    max_levels: f64,
}

fn shown(question: &Question) -> Vec<Shown> {
    let mut all: Vec<Shown> = Vec::new();
    for row in &question.rows {
        let (Some(picture), id) = (&row.picture, id(question, row)) else { continue };
        match all.iter_mut().find(|shown| shown.id == id) {
            Some(shown) => shown.name += &format!("; {}", row.name),
            None => all.push(Shown {
                id,
                name: row.name.clone(),
                uri: format!("data:image/png;base64,{}", BASE64_STANDARD.encode(&picture.png)),
                gain: picture.gain,
                width: picture.width,
                height: picture.height,
                changed: row.error.changed,
                max_levels: row.error.max_levels,
            }),
        }
    }
    all
}

/// Returns the report as an HTML page.
pub fn page(report: &Report) -> String {
    let plots: Vec<String> =
        plots(report).iter().map(|plot| plot::svg(plot, Place::Page)).collect();
    let pictures: Vec<Vec<Shown>> = report.questions.iter().map(shown).collect();
    let titles: Vec<&str> =
        report.questions.iter().map(|question| question.about.title()).collect();
    let own = report.own.to_string();
    let more = context! { own, titles, pictures => Value::from(Serde(pictures)) };
    render(TEMPLATE, report, &plots, more)
}

/// Returns `template` rendered with `report`, `plots` and `more`, in the style of these pages.
pub(super) fn render(
    template: &str,
    report: &impl Serialize,
    plots: &[String],
    more: Value,
) -> String {
    let style = format!("{LOOK}{}", plot::STYLE);
    let report = Value::from(Serde(report));
    let values = context! { plots => plots.to_vec(), report, more };
    html(Layout { template, style: &style, script: "" }, &values)
}
