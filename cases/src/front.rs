//! What accuracy costs in the cases: how long the reference took by each of its settings, and how
//! far its picture was off.
//!
//! `reference cost --store` measures it once and stores it as `fronts.json` beside the stages; a
//! student's report shows the student's own time and error among these points. It decides nothing:
//! no score depends on it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::Error;
use serde::{Deserialize, Serialize};

use crate::film::{Image, byte};

/// All that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fronts {
    /// The machine it was measured on, in a few words for people.
    pub machine: String,
    /// By id of the case, each in the order it was measured.
    pub cases: BTreeMap<String, Vec<FrontPoint>>,
}

/// One setting of the reference in one case, one ray a pixel, as pictures are judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrontPoint {
    /// A few words for it, such as `f32, plain formulas`.
    pub setting: String,
    /// Seconds of one thread for rendering alone: the median of several runs, above 0.
    pub time_s: f64,
    /// [`rmse_levels`] against the expected picture.
    pub rmse_levels: f64,
}

/// Where [`Fronts`] lie beside the stages.
pub fn fronts_path(stages: &Path) -> PathBuf {
    stages.join("fronts.json")
}

/// The text to store for them.
///
/// # Errors
/// What the encoder says.
pub fn fronts_to_string(fronts: &Fronts) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(fronts).map(|text| text + "\n")
}

/// What `text` holds.
///
/// # Errors
/// What is missing or of the wrong kind, with line and column; a point that no measurement gives.
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

/// Which points no other one beats: none is as fast and as exact, and better in one of the two. Of
/// equals all count.
pub fn on_front(points: &[FrontPoint]) -> Vec<bool> {
    let beats = |a: &FrontPoint, b: &FrontPoint| {
        let is_as_good = a.time_s <= b.time_s && a.rmse_levels <= b.rmse_levels;
        is_as_good && (a.time_s < b.time_s || a.rmse_levels < b.rmse_levels)
    };
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

/// The root of the mean squared difference of two pictures of one size over all channels, in levels
/// of the 8-bit pictures. NaN counts as black.
///
/// # Panics
/// Where the sizes differ.
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

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points =
            [point(1.0, 4.0), point(2.0, 1.0), point(3.0, 1.0), point(2.5, 0.0), point(2.0, 1.0)];
        assert_eq!(on_front(&points), [true, true, false, true, true]);
        assert!(on_front(&[]).is_empty());
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
        let fronts = Fronts { machine: "two cores".to_owned(), cases };
        assert_eq!(fronts_from_str(&fronts_to_string(&fronts).unwrap()).unwrap(), fronts);
        assert!(fronts_from_str("{}").is_err());
        for (time_s, rmse_levels) in
            [(0.0, 0.5), (-1.0, 0.5), (5e-324, 0.5), (1.0, -0.5), (1.0, 256.0)]
        {
            let cases = BTreeMap::from([("a/b".to_owned(), vec![point(time_s, rmse_levels)])]);
            let text = fronts_to_string(&Fronts { machine: String::new(), cases }).unwrap();
            let why = fronts_from_str(&text).unwrap_err().to_string();
            assert!(why.contains("a/b") && why.contains("cannot have been measured"), "{why}");
        }
    }
}
