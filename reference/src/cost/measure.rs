//! Runs a sweep: pictures and errors first, then times, in rounds that render each setting once.

use cases::film::Image;

use super::bench::Bench;
use super::error::Error;
use super::error_picture::ErrorPicture;
use super::setting::Setting;
use super::sweep::{About, Sweep};
use super::times::Times;
use crate::trace::render::Stats;

/// The measurements of one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The setting.
    pub setting: Setting,
    /// The purpose of the setting.
    pub about: About,
    /// The difference from the scene's own setting.
    pub error: Error,
    /// The error of precision and formulas alone: against f64 and the robust formulas, with
    /// everything else equal. `None` if that setting was not rendered.
    pub rounding: Option<Compared>,
    /// The error of depth and cut-offs, and of rounding: against the sweep's deepest setting.
    /// `None` if the sampling differs.
    pub depth: Option<Compared>,
    /// The error of sampling, and of rounding: against the sweep's truth. `None` if the depth or a
    /// cut-off differs.
    pub sampling: Option<Compared>,
    /// The rays by kind, and the weight that was left out.
    pub stats: Stats,
    /// The memory, as [`Bench::bytes`] gives it.
    pub bytes: usize,
    /// The seconds of each round.
    pub times_s: Vec<f64>,
}

impl Measured {
    /// Returns the milliseconds of the rounds.
    pub fn time_ms(&self) -> Times {
        Times::of(&self.times_s.iter().map(|seconds| 1e3 * seconds).collect::<Vec<_>>())
    }
}

/// An error, and its picture if it can be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The error.
    pub error: Error,
    /// The picture of the error. `None` if no 8-bit pixel changes.
    pub picture: Option<ErrorPicture>,
}

/// The outside world of a measurement: the clock, the user who may stop it, and the progress bar.
pub trait Outside {
    /// Returns the seconds since any fixed moment.
    fn now_s(&mut self) -> f64;
    /// Returns whether to go on. Called before every picture.
    fn goes_on(&mut self) -> bool;
    /// Reports that another picture is done, which took as much work as `work` pictures of one ray
    /// a pixel.
    fn done(&mut self, work: u64);
}

/// Returns the work of a sweep with `n_rounds` rounds, in pictures of one ray a pixel, for a
/// progress bar.
pub fn work(sweep: &Sweep, n_rounds: usize) -> u64 {
    let one: u64 = sweep.subjects.iter().map(|(setting, _)| weight(setting)).sum();
    one * (n_rounds as u64 + 1)
}

fn weight(setting: &Setting) -> u64 {
    u64::from(setting.samples) * u64::from(setting.samples)
}

/// Measures a sweep. Returns a row for each subject, in the sweep's order, all with the same number
/// of times.
///
/// Returns `None` if it is stopped before the first round is complete. If it is stopped later, the
/// complete rounds count.
///
/// Each round renders every setting once and begins at a different one. A machine that slows down
/// or is busy for a while therefore affects all settings alike. The pictures from which errors are
/// computed are rendered before the rounds, and not timed: they warm the caches.
pub fn measure(
    bench: &mut Bench,
    sweep: &Sweep,
    n_rounds: usize,
    outside: &mut impl Outside,
) -> Option<Vec<Measured>> {
    let mut rows = pictures(bench, sweep, outside)?;
    for round in 0..n_rounds {
        let Some(times) = one_round(bench, &rows, round, outside) else { break };
        for (row, time) in rows.iter_mut().zip(times) {
            row.times_s.push(time);
        }
    }
    (!rows.is_empty() && !rows[0].times_s.is_empty()).then_some(rows)
}

/// Returns the index of the setting that is rendered `n`-th in a round. From round to round, the
/// first setting advances by about the golden section of all settings.
fn turn(round: usize, n: usize, n_settings: usize) -> usize {
    let step = (n_settings * 5).div_ceil(8);
    (n + round * step) % n_settings
}

fn one_round(
    bench: &mut Bench,
    rows: &[Measured],
    round: usize,
    outside: &mut impl Outside,
) -> Option<Vec<f64>> {
    let mut times = vec![0.0; rows.len()];
    for n in 0..rows.len() {
        let at = turn(round, n, rows.len());
        if !outside.goes_on() {
            return None;
        }
        let start = outside.now_s();
        std::hint::black_box(bench.render(&rows[at].setting));
        times[at] = outside.now_s() - start;
        outside.done(weight(&rows[at].setting));
    }
    Some(times)
}

/// Returns the rows, without times. Only the pictures that others are compared with are kept.
/// `None` if it was stopped.
fn pictures(bench: &mut Bench, sweep: &Sweep, outside: &mut impl Outside) -> Option<Vec<Measured>> {
    let mut kept: Vec<(Setting, Image, Stats)> = Vec::new();
    for (setting, about) in &sweep.subjects {
        let is_kept = [sweep.own, sweep.truth, sweep.deepest].contains(setting);
        if *about == About::Accuracy && is_kept {
            let (image, stats) = picture(bench, setting, outside)?;
            kept.push((*setting, image, stats));
        }
    }
    let mut rows = Vec::new();
    let mut last_exact: Option<(Setting, Image)> = None;
    for (setting, about) in &sweep.subjects {
        let (image, stats) = match kept.iter().find(|(s, ..)| s == setting) {
            Some((_, image, stats)) => (image.clone(), *stats),
            None => picture(bench, setting, outside)?,
        };
        let exact = setting.by_exact_numbers();
        if exact == *setting {
            last_exact = Some((exact, image.clone()));
        }
        let against = |other: &Setting| {
            let of_kept = kept.iter().map(|(s, truth, _)| (s, truth));
            let all = of_kept.chain(last_exact.iter().map(|(s, truth)| (s, truth)));
            let (_, truth) = all.into_iter().find(|(s, _)| *s == other)?;
            let error = Error::of(truth, &image, bench.rules().quantiser);
            let is_shown = *about == About::Accuracy && error.changed > 0.0;
            let picture = is_shown.then(|| ErrorPicture::of(truth, &image)).flatten();
            Some(Compared { error, picture })
        };
        let error = against(&sweep.own).map_or_else(Error::default, |compared| compared.error);
        let rounding = against(&exact);
        let is_as_sampled = exact.with_depth_of(&sweep.deepest) == sweep.deepest;
        let depth = is_as_sampled.then(|| against(&sweep.deepest)).flatten();
        let is_as_deep = exact.with_sampling_of(&sweep.truth) == sweep.truth;
        let sampling = is_as_deep.then(|| against(&sweep.truth)).flatten();
        rows.push(Measured {
            setting: *setting,
            about: *about,
            error,
            rounding,
            depth,
            sampling,
            stats,
            bytes: bench.bytes(setting),
            times_s: Vec::new(),
        });
    }
    Some(rows)
}

fn picture(
    bench: &mut Bench,
    setting: &Setting,
    outside: &mut impl Outside,
) -> Option<(Image, Stats)> {
    if !outside.goes_on() {
        return None;
    }
    let done = bench.render(setting);
    outside.done(weight(setting));
    Some(done)
}
