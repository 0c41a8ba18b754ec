//! A small plot of the student's time and error among the measured settings of the reference. Both
//! axes are logarithmic.

use cases::front::{FrontPoint, on_front, rmse_levels};
use cases::maths;
use serde::Serialize;

use crate::graded::Pictures;
use crate::plain::shown;
use crate::report::words::seconds;

/// The inner size of the plot; `submission.html` draws margins around it.
const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 110.0;
/// The least error on the scale, in levels. A smaller error is drawn on the lowest line.
const LEAST: f64 = 1e-3;
/// The greatest possible error, in levels.
const MOST: f64 = 255.0;

/// The values that the template draws. Places are in pixels from the top left of the plot.
#[derive(Serialize)]
pub(super) struct FrontView {
    width: f64,
    height: f64,
    points: Vec<Mark>,
    /// The front as a list of points for an SVG polyline.
    line: String,
    yours: Mark,
    x_ticks: Vec<Tick>,
    y_ticks: Vec<Tick>,
    sentence: String,
    machine: String,
    is_old: bool,
}

#[derive(Serialize)]
struct Mark {
    x: String,
    y: String,
    is_on_front: bool,
    title: String,
}

#[derive(Serialize)]
struct Tick {
    at: String,
    label: String,
}

/// Returns the plot. `None` if nothing was measured for the case, if a time is not positive and
/// finite, or if there is no picture of the expected size.
pub(super) fn view(pictures: &Pictures, time_s: f64) -> Option<FrontView> {
    let (expected, actual) = (&pictures.answer.expected, pictures.actual.as_ref()?);
    let front = pictures.front.as_ref()?;
    let same_size = (actual.width(), actual.height()) == (expected.width(), expected.height());
    let is_time = |time_s: f64| time_s > 0.0 && time_s.is_finite();
    let are_times = is_time(time_s) && front.points.iter().all(|point| is_time(point.time_s));
    if !same_size || front.points.is_empty() || !are_times {
        return None;
    }
    let yours = FrontPoint {
        setting: "yours".to_owned(),
        time_s,
        rmse_levels: rmse_levels(expected, actual),
    };
    let times = || front.points.iter().chain([&yours]).map(|point| point.time_s);
    let (least, most) = (times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max));
    let decades = decades(least, most);
    let at = |point: &FrontPoint| {
        (along(point.time_s, decades) * WIDTH, down(point.rmse_levels) * HEIGHT)
    };
    let mark = |point: &FrontPoint, is_on_front: bool| {
        let (x, y) = at(point);
        let title = format!(
            "{}: {}, {}",
            shown(&point.setting),
            seconds(point.time_s),
            error(point.rmse_levels)
        );
        Mark { x: place(x), y: place(y), is_on_front, title }
    };
    let prices = front.points.iter().map(|point| (point.time_s, point.rmse_levels));
    let is_front = on_front(&prices.collect::<Vec<_>>());
    let mut line: Vec<(f64, f64)> =
        front.points.iter().zip(&is_front).filter(|(_, is)| **is).map(|(p, _)| at(p)).collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sentence = sentence(&yours, &front.points, &is_front);
    Some(FrontView {
        width: WIDTH,
        height: HEIGHT,
        points: front.points.iter().zip(is_front).map(|(point, is)| mark(point, is)).collect(),
        line: line
            .iter()
            .map(|(x, y)| format!("{},{}", place(*x), place(*y)))
            .collect::<Vec<_>>()
            .join(" "),
        yours: mark(&yours, false),
        x_ticks: (decades.0..=decades.1)
            .map(|n| tick(along(power(n), decades) * WIDTH, seconds(power(n))))
            .collect(),
        y_ticks: [0.0, 0.01, 1.0, 100.0]
            .map(|error| tick(down(error) * HEIGHT, error.to_string()))
            .into(),
        sentence,
        machine: shown(&front.machine),
        is_old: front.is_old,
    })
}

/// Describes the plot in a sentence: the student's point, and the point with the least error on the
/// front of the reference.
fn sentence(yours: &FrontPoint, points: &[FrontPoint], is_front: &[bool]) -> String {
    let best = points.iter().zip(is_front).filter(|(_, is)| **is).map(|(point, _)| point);
    let best = best.min_by(|a, b| a.rmse_levels.total_cmp(&b.rmse_levels));
    let of_best = best.map_or(String::new(), |best| {
        format!(
            "; the reference at best ({}) {}, {}",
            shown(&best.setting),
            seconds(best.time_s),
            error(best.rmse_levels)
        )
    });
    format!(
        "Yours took {}, its start included, {}{of_best}.",
        seconds(yours.time_s),
        error(yours.rmse_levels)
    )
}

fn error(rmse_levels: f64) -> String {
    if rmse_levels == 0.0 {
        "without error".to_owned()
    } else {
        format!("{rmse_levels:.2} levels off (RMSE)")
    }
}

/// Returns the exponents of the powers of ten around the times.
fn decades(least: f64, most: f64) -> (i32, i32) {
    let (low, high) = (maths::log10(least).floor() as i32, maths::log10(most).ceil() as i32);
    (low, high.max(low + 1))
}

fn power(n: i32) -> f64 {
    maths::pow(10.0, f64::from(n))
}

/// Returns the share of the width at which a time lies.
fn along(time_s: f64, (first, last): (i32, i32)) -> f64 {
    (maths::log10(time_s) - f64::from(first)) / f64::from(last - first)
}

/// Returns the share of the height at which an error lies. The greatest error is at the top.
fn down(rmse_levels: f64) -> f64 {
    maths::log10(MOST / rmse_levels.clamp(LEAST, MOST)) / maths::log10(MOST / LEAST)
}

fn place(x: f64) -> String {
    format!("{x:.1}")
}

fn tick(at: f64, label: String) -> Tick {
    Tick { at: place(at), label }
}
