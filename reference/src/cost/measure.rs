//! Runs a sweep: pictures and errors first, then times, in rounds that take each setting once.

use cases::film::Image;

use super::bench::Bench;
use super::error::Error;
use super::setting::Setting;
use super::sweep::{About, Sweep};
use crate::render::Stats;

/// What was measured of one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// How the picture was computed.
    pub setting: Setting,
    /// What it is there to show.
    pub about: About,
    /// Against the truth; for an effect, against the scene as it stands.
    pub error: Error,
    /// Against the most accurate setting with as many rays a pixel; for an effect, the same as
    /// `error`.
    pub same_rays: Error,
    /// What precision and formulas alone do: against f64 and the robust formulas, all else the
    /// same; none where that was not rendered.
    pub rounding: Option<Error>,
    /// Rays by kind, and what was left out.
    pub stats: Stats,
    /// See [`Bench::bytes`].
    pub bytes: usize,
    /// Seconds of each round.
    pub times_s: Vec<f64>,
}

/// The clock, the user, and the bar: what a measurement needs of the world outside.
pub trait Outside {
    /// Seconds since any fixed moment.
    fn now_s(&mut self) -> f64;
    /// Whether to go on; asked before every picture.
    fn goes_on(&mut self) -> bool;
    /// Another picture is done, worth `work` pictures of one ray a pixel.
    fn done(&mut self, work: u64);
}

/// Pictures of one ray a pixel that a sweep comes to, with that many rounds: for a progress bar.
pub fn work(sweep: &Sweep, n_rounds: usize) -> u64 {
    let one: u64 = sweep.subjects.iter().map(|(setting, _)| weight(setting)).sum();
    one * (n_rounds as u64 + 1)
}

fn weight(setting: &Setting) -> u64 {
    u64::from(setting.samples) * u64::from(setting.samples)
}

/// Measures a sweep: a row for each subject, in its order, each with as many times. `None` where it
/// was stopped before the first round was done; where it is stopped later, the rounds done by then
/// count.
///
/// Each round renders every setting once and begins at another one, so that a machine that slows
/// down or is busy for a while is hard on all alike. The pictures from which errors are taken are
/// rendered before, and not timed: they warm the caches.
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

/// Which setting is the n-th of a round: the first one moves on by about a golden section of them.
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

/// Rows without times. The pictures that others are compared with are kept, all others dropped.
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
