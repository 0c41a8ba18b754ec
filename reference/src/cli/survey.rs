//! The command `reference vary --check`: how well the bounds of the cases hold over many seeds.

use std::fmt::Write;

use pages::say;
use rayon::prelude::*;

use super::args::VaryArgs;
use super::output::{Talk, print};
use super::progress::Bar;
use super::stop::Stop;
use crate::expect::Set;
use crate::vary::{Care, Original, Varied, VaryError};

/// The results of one case over any number of seeds. The sum of two does not depend on their order.
#[derive(Clone, Debug, Default)]
struct Seen {
    n_seeds: u64,
    n_first: u64,
    most_draws: u32,
    /// The least share of pixels that show what the stage adds; `None` without an accepted draw.
    least: Option<f64>,
    /// The greatest share of contested pixels; `None` if it was not measured.
    contested: Option<f64>,
    failed: Vec<String>,
}

impl Seen {
    fn of(drawn: Result<Varied, VaryError>) -> Self {
        let seen = Self { n_seeds: 1, ..Self::default() };
        match drawn {
            Ok(varied) => Self {
                n_first: u64::from(varied.n_draws == 1),
                most_draws: varied.n_draws,
                least: Some(varied.shows),
                contested: varied.contested,
                ..seen
            },
            Err(why) => Self { failed: vec![say::chain(&why)], ..seen },
        }
    }

    fn and(mut self, other: Self) -> Self {
        self.failed.extend(other.failed);
        Self {
            n_seeds: self.n_seeds + other.n_seeds,
            n_first: self.n_first + other.n_first,
            most_draws: self.most_draws.max(other.most_draws),
            least: either(self.least, other.least, f64::min),
            contested: either(self.contested, other.contested, f64::max),
            failed: self.failed,
        }
    }
}

/// Returns the result of `choose` for two numbers, or the only number.
fn either(one: Option<f64>, other: Option<f64>, choose: fn(f64, f64) -> f64) -> Option<f64> {
    match (one, other) {
        (Some(one), Some(other)) => Some(choose(one, other)),
        _ => one.or(other),
    }
}

/// Draws the requested sets and prints a table with a line for each case.
pub(super) fn run(
    originals: &[Original],
    set: &Set,
    args: &VaryArgs,
    talk: Talk,
) -> Result<(), Stop> {
    let first = args.seed.unwrap_or(1);
    let bar = Bar::cases(args.seeds * originals.len() as u64, talk);
    let draw = |n: u64| -> Vec<Seen> {
        let care = if n < args.contested { Care::Whole } else { Care::Quick };
        let one = |original: &Original| {
            let seen = Seen::of(original.vary(set, first.wrapping_add(n), care));
            bar.add(1);
            seen
        };
        originals.par_iter().map(one).collect()
    };
    let both = |one: Vec<Seen>, other: Vec<Seen>| {
        one.into_iter().zip(other).map(|(a, b)| a.and(b)).collect()
    };
    let seen: Vec<Seen> = (0..args.seeds)
        .into_par_iter()
        .map(draw)
        .reduce(|| vec![Seen::default(); originals.len()], both);
    drop(bar);
    print(table(originals, &seen).as_bytes())?;
    let failed: Vec<&str> = seen.iter().flat_map(|seen| &seen.failed).map(String::as_str).collect();
    if failed.is_empty() { Ok(()) } else { Err(Stop::NotPassed(failed.join("\n"))) }
}

fn table(originals: &[Original], seen: &[Seen]) -> String {
    let width = originals.iter().map(|original| original.id().len()).max().unwrap_or_default();
    let mut text = format!("{:<width$}  first draw   draws    shows    least  contested\n", "case");
    let percent = |share: Option<f64>| {
        share.map_or("–".to_owned(), |share| format!("{:.1} %", 100.0 * share))
    };
    for (original, seen) in originals.iter().zip(seen) {
        let first = percent(Some(seen.n_first as f64 / seen.n_seeds.max(1) as f64));
        let draws =
            if seen.failed.is_empty() { seen.most_draws.to_string() } else { "failed".to_owned() };
        let (shows, least, contested) =
            (percent(Some(original.shows())), percent(seen.least), percent(seen.contested));
        let _ = writeln!(
            text,
            "{:<width$}  {first:>10}  {draws:>6}  {shows:>7}  {least:>7}  {contested:>9}",
            original.id()
        );
    }
    text
}
