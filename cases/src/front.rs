//! The cost of accuracy in the cases: the time that the reference takes with each of its settings,
//! and the error of its picture.
//!
//! `reference cost --store` measures it once and stores it as `fronts.json` beside the stages. A
//! student's report shows the student's own time and error among these points. No score depends on
//! it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::Error;
use serde::{Deserialize, Serialize};

use crate::film::{Image, byte};

/// All measured points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fronts {
    /// The machine that they were measured on, in a few words for people.
    pub machine: String,
    /// The code and cases that they were measured on, as [`sources_digest`] gives them. `None` if
    /// they were measured without the sources at hand.
    ///
    /// [`sources_digest`]: crate::files::sources_digest
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured_on: Option<String>,
    /// Points by id of the case, in the order in which they were measured.
    pub cases: BTreeMap<String, Vec<FrontPoint>>,
}

/// One setting of the reference in one case, with one ray per pixel, as pictures are judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrontPoint {
    /// The setting in a few words, such as `f32, plain formulas`.
    pub setting: String,
    /// Seconds that one thread takes to render: the median of several runs, above 0.
    pub time_s: f64,
    /// The result of [`rmse_levels`] for its picture and the expected one.
    pub rmse_levels: f64,
}

/// Returns the path of the stored [`Fronts`] below `stages`.
pub fn fronts_path(stages: &Path) -> PathBuf {
    stages.join("fronts.json")
}

/// Returns the workspace whose cases lie in `stages`: the folder that contains `cases/stages`.
pub fn workspace_of(stages: &Path) -> PathBuf {
    stages.join("../..")
}

/// Returns the text to store for `fronts`.
///
/// # Errors
/// An error of the JSON encoder.
pub fn fronts_to_string(fronts: &Fronts) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(fronts).map(|text| text + "\n")
}

/// Parses the stored fronts in `text`.
///
/// # Errors
/// A part that is missing or of the wrong kind, with line and column. A point that no measurement
/// gives: a time that is not a normal number above 0, or an error outside 0..=255.
pub fn fronts_from_str(text: &str) -> Result<Fronts, serde_json::Error> {
    let fronts: Fronts = serde_json::from_str(text)?;
    let is_measured = |point: &FrontPoint| {
        point.time_s.is_normal() && point.time_s > 0.0 && (0.0..=255.0).contains(&point.rmse_levels)
    };
    match fronts
        .cases
        .iter()
        .find_map(|(id, points)| Some((id, points.iter().find(|point| !is_measured(point))?)))
    {
        Some((id, FrontPoint { setting, time_s, rmse_levels })) => {
            Err(serde_json::Error::custom(format!(
                "{id}, {setting}: {time_s} s and {rmse_levels} levels cannot have been measured"
            )))
        }
        None => Ok(fronts),
    }
}

/// Returns for every point (time, error) whether it is on the Pareto front.
///
/// A point is off the front if another one is as fast and as exact, and better in one of the two.
/// Equal points are all on the front, or all off it. A point with a NaN is off the front, and beats
/// no other point. The units do not matter.
pub fn on_front(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: (f64, f64), b: (f64, f64)| {
        let is_as_good = a.0 <= b.0 && a.1 <= b.1;
        is_as_good && (a.0 < b.0 || a.1 < b.1)
    };
    let is_on = |point: &(f64, f64)| {
        let is_number = !point.0.is_nan() && !point.1.is_nan();
        is_number && !points.iter().any(|other| beats(*other, *point))
    };
    points.iter().map(is_on).collect()
}

/// Returns the root of the mean squared difference of two pictures over all channels, in 8-bit
/// levels. NaN counts as black.
///
/// # Panics
/// The sizes differ.
pub fn rmse_levels(one: &Image, other: &Image) -> f64 {
    assert_eq!(
        (one.width(), one.height()),
        (other.width(), other.height()),
        "pictures of one size"
    );
    let pairs = one.pixels().iter().zip(other.pixels());
    let off = |a: f64, b: f64| u64::from(byte(a).abs_diff(byte(b)));
    let squares =
        pairs.map(|(a, b)| (0..3).map(|c| off(a[c], b[c]) * off(a[c], b[c])).sum::<u64>());
    let sum = squares.sum::<u64>() as f64;
    (sum / (one.pixels().len() * 3) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn point(time_s: f64, rmse_levels: f64) -> FrontPoint {
        FrontPoint { setting: format!("{time_s} s"), time_s, rmse_levels }
    }

    /// Points, and the indices of those on the front.
    type Row = (&'static [(f64, f64)], &'static [usize]);

    #[test]
    fn the_front_is_what_nothing_beats() {
        let table: [Row; 8] = [
            (&[], &[]),
            (&[(1.0, 1.0)], &[0]),
            (&[(1.0, 3.0), (2.0, 2.0), (3.0, 1.0)], &[0, 1, 2]),
            (&[(1.0, 3.0), (2.0, 4.0), (3.0, 0.0), (4.0, 0.0)], &[0, 2]),
            (&[(2.0, 2.0), (2.0, 1.0), (1.0, 2.0)], &[1, 2]),
            (&[(1.0, 4.0), (2.0, 1.0), (3.0, 1.0), (2.5, 0.0), (2.0, 1.0)], &[0, 1, 3, 4]),
            (&[(1.0, 1.0), (1.0, 1.0), (2.0, 2.0), (2.0, 2.0)], &[0, 1]),
            (&[(f64::NAN, 0.0), (1.0, f64::NAN), (2.0, 5.0)], &[2]),
        ];
        for (points, expected) in table {
            let is_on = on_front(points);
            let on: Vec<usize> = (0..points.len()).filter(|n| is_on[*n]).collect();
            assert_eq!(on, expected, "{points:?}");
        }
    }

    #[test]
    fn one_channel_of_one_pixel_in_four_off_by_two_levels() {
        let grey = Image::from_fn(2, 2, |_, _| DVec3::splat(0.5));
        let off = Image::from_fn(2, 2, |i, j| {
            DVec3::splat(0.5) + DVec3::X * if i + j == 0 { 2.0 / 255.0 } else { 0.0 }
        });
        assert!((rmse_levels(&grey, &off) - (4.0f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(rmse_levels(&grey, &grey), 0.0);
    }

    #[test]
    fn fronts_come_back() {
        let cases = BTreeMap::from([("01_ray_casting/ball".to_owned(), vec![point(0.001, 0.25)])]);
        let fronts = Fronts { machine: "two cores".to_owned(), measured_on: None, cases };
        assert_eq!(fronts_from_str(&fronts_to_string(&fronts).unwrap()).unwrap(), fronts);
        let dated = Fronts { measured_on: Some("0123456789abcdef".to_owned()), ..fronts };
        assert_eq!(fronts_from_str(&fronts_to_string(&dated).unwrap()).unwrap(), dated);
        assert!(fronts_from_str("{}").is_err());
        for (time_s, rmse_levels) in
            [(0.0, 0.5), (-1.0, 0.5), (5e-324, 0.5), (1.0, -0.5), (1.0, 256.0)]
        {
            let cases = BTreeMap::from([("a/b".to_owned(), vec![point(time_s, rmse_levels)])]);
            let text =
                fronts_to_string(&Fronts { machine: String::new(), measured_on: None, cases })
                    .unwrap();
            let why = fronts_from_str(&text).unwrap_err().to_string();
            assert!(why.contains("a/b") && why.contains("cannot have been measured"), "{why}");
        }
    }
}
