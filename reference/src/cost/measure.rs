//! Runs a sweep: pictures and errors first, then times, in rounds that render each setting once.

use cases::film::Image;

use super::bench::Bench;
use super::error::Error;
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
    /// The error against the truth; for an effect, against the scene's own setting.
    pub error: Error,
    /// The error against the most accurate setting with as many rays a pixel; for an effect, equal
    /// to `error`.
    pub same_rays: Error,
    /// The error of precision and formulas alone: against f64 and the robust formulas, with
    /// everything else equal. `None` if that setting was not rendered.
    pub rounding: Option<Error>,
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
        let is_kept = *about == About::Accuracy
            && (*setting == sweep.own || *setting == sweep.exact(setting));
        if is_kept {
            let (image, stats) = picture(bench, setting, outside)?;
            kept.push((*setting, image, stats));
        }
    }
    let mut rows = Vec::new();
    let mut last_exact: Option<(Setting, Image)> = None;
    for (setting, about) in &sweep.subjects {
        let found = kept.iter().find(|(s, ..)| s == setting);
        let (image, stats) = match found {
            Some((_, image, stats)) => (image.clone(), *stats),
            None => picture(bench, setting, outside)?,
        };
        let against = |other: &Setting| {
            let other = kept.iter().find(|(s, ..)| s == other);
            other.map_or_else(Error::default, |(_, truth, _)| {
                Error::of(truth, &image, bench.rules().quantiser)
            })
        };
        let (error, same_rays) = match about {
            About::Accuracy => (against(&sweep.truth), against(&sweep.exact(setting))),
            About::Without(_) | About::Everything => (against(&sweep.own), against(&sweep.own)),
        };
        let exact = setting.by_exact_numbers();
        let sibling = kept
            .iter()
            .map(|(s, picture, _)| (s, picture))
            .chain(last_exact.iter().map(|(s, picture)| (s, picture)));
        let sibling = sibling.into_iter().find(|(s, _)| **s == exact).map(|(_, picture)| picture);
        let rounding = if exact == *setting { Some(&image) } else { sibling };
        let rounding = rounding.map(|picture| Error::of(picture, &image, bench.rules().quantiser));
        let bytes = bench.bytes(setting);
        let (setting, about) = (*setting, *about);
        rows.push(Measured {
            setting,
            about,
            error,
            same_rays,
            rounding,
            stats,
            bytes,
            times_s: Vec::new(),
        });
        if exact == setting {
            last_exact = Some((setting, image));
        }
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
