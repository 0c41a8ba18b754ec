//! How new rays leave surfaces: wrong pixels of a scene in every size, and times.

use cases::Scene;
use cases::film::Image;
use serde::Serialize;

use super::bench::Bench;
use super::error::Error;
use super::measure::Outside;
use super::scaled::scaled;
use super::setting::{Formula, Setting};
use super::times::Times;
use crate::expect::variations::Precision;
use crate::rules::{Epsilon, Rules};

/// The exponents of the sizes, which are powers of ten.
pub const SIZES: [i32; 9] = [-8, -6, -4, -2, 0, 2, 4, 6, 8];

/// A way in which new rays leave surfaces.
#[derive(Clone, Debug)]
pub struct Way {
    name: String,
    rules: Rules,
    setting: Setting,
}

/// The measurements of one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StartRow {
    /// The way in words.
    pub name: String,
    /// The share of the pixels with a wrong 8-bit colour, for each of [`SIZES`].
    pub changed: Vec<f64>,
    /// Milliseconds a picture in its own size, in kernels that are compiled alike.
    pub time_ms: Times,
}

impl StartRow {
    /// Returns the sentence on the sizes at which no pixel is wrong.
    pub fn safe_sizes(&self) -> String {
        let all = SIZES.iter().zip(&self.changed);
        let safe: Vec<String> = all
            .filter(|(_, share)| **share == 0.0)
            .map(|(power, _)| format!("10^{power}"))
            .collect();
        let name = &self.name;
        match safe.len() {
            0 => format!("{name}: no size is free of wrong pixels."),
            n if n == SIZES.len() => format!("{name}: no pixel is wrong at any size."),
            _ => format!("{name}: no pixel is wrong at {}.", safe.join(", ")),
        }
    }
}

/// Returns the reference's own way and that by each RAY_EPSILON, in each precision.
///
/// The reference's way needs its formulas, which bound the error of a hit. A RAY_EPSILON is
/// measured with formulas that do not cancel.
pub fn ways(rules: &Rules, own: &Setting, precisions: &[Precision], epsilons: &[f64]) -> Vec<Way> {
    let of = |precision: &Precision| {
        let (precision, setting) = (*precision, Setting { precision: *precision, ..*own });
        let setting = Setting { alike: true, ..setting };
        let bound = Way {
            name: format!("{}, by the bound on the hit's error", precision.says()),
            rules: *rules,
            setting,
        };
        let fixed = epsilons.iter().map(move |epsilon| Way {
            name: format!("{}, t > {epsilon:e}", precision.says()),
            rules: Rules { epsilon: Epsilon::Fixed(*epsilon), ..*rules },
            setting: Setting { formula: Formula::Stable, ..setting },
        });
        std::iter::once(bound).chain(fixed).collect::<Vec<_>>()
    };
    precisions.iter().flat_map(of).collect()
}

/// Returns the number of pictures of a measurement, for a progress bar.
pub fn work(n_ways: usize, n_rounds: usize) -> u64 {
    1 + n_ways as u64 * (SIZES.len() + n_rounds) as u64
}

/// Measures `ways` on `scene`: first the pictures in every size, against that of the scene's own
/// setting, then times in interleaved rounds. `None` if it is stopped.
pub fn measure(
    scene: &Scene,
    ways: &[Way],
    n_rounds: usize,
    outside: &mut impl Outside,
) -> Option<Vec<StartRow>> {
    let own = Setting::of(scene);
    let rules = ways.first()?.rules;
    let truth = picture(&mut Bench::new(scene, &rules), &own, outside)?;
    let mut rows = Vec::new();
    for way in ways {
        let mut changed = Vec::new();
        for power in SIZES {
            let scene = scaled(scene, cases::maths::pow(10.0, f64::from(power)));
            let image = picture(&mut Bench::new(&scene, &way.rules), &way.setting, outside)?;
            changed.push(Error::of(&truth, &image, way.rules.quantiser).changed);
        }
        rows.push(StartRow { name: way.name.clone(), changed, time_ms: Times::default() });
    }
    let mut benches: Vec<Bench> = ways.iter().map(|way| Bench::new(scene, &way.rules)).collect();
    let mut times_ms = vec![Vec::new(); ways.len()];
    for _ in 0..n_rounds {
        for ((bench, way), times) in benches.iter_mut().zip(ways).zip(&mut times_ms) {
            let start = outside.now_s();
            picture(bench, &way.setting, outside)?;
            times.push(1e3 * (outside.now_s() - start));
        }
    }
    rows.iter_mut().zip(times_ms).for_each(|(row, times)| row.time_ms = Times::of(&times));
    Some(rows)
}

fn picture(bench: &mut Bench, setting: &Setting, outside: &mut impl Outside) -> Option<Image> {
    if !outside.goes_on() {
        return None;
    }
    let (image, _) = bench.render(setting);
    outside.done(1);
    Some(image)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_without_a_wrong_pixel_are_listed() {
        let says = |changed: [f64; 9]| {
            let (name, changed) = ("f64".to_owned(), changed.to_vec());
            StartRow { name, changed, time_ms: Times::default() }.safe_sizes()
        };
        assert_eq!(says([0.0; 9]), "f64: no pixel is wrong at any size.");
        assert_eq!(says([0.1; 9]), "f64: no size is free of wrong pixels.");
        assert_eq!(
            says([0.1, 0.1, 0.1, 0.0, 0.0, 0.1, 0.1, 0.1, 0.1]),
            "f64: no pixel is wrong at 10^-2, 10^0."
        );
    }
}
