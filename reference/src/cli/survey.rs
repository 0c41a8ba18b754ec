//! `reference vary --check`: how well the bounds of the cases hold over many seeds.

use std::fmt::Write;

use rayon::prelude::*;

use super::progress::Bar;
use super::{Stop, Talk, print};
use crate::vary::{Original, Varied};

/// What was seen of one case, over any number of seeds; adding up two gives the same in either order.
#[derive(Clone, Debug, Default)]
struct Seen {
    n_seeds: u64,
    n_first: u64,
    most_draws: u32,
    /// The least share of pixels that show what the stage adds; `None` before the first.
    least: Option<f64>,
    failed: Vec<String>,
}

impl Seen {
    fn of(drawn: Result<Varied, String>) -> Self {
        let seen = Self { n_seeds: 1, ..Self::default() };
        match drawn {
            Ok(varied) => Self {
                n_first: u64::from(varied.n_draws == 1),
                most_draws: varied.n_draws,
                least: Some(varied.shows),
                ..seen
            },
            Err(why) => Self { failed: vec![why], ..seen },
        }
    }

    fn and(mut self, other: Self) -> Self {
        self.failed.extend(other.failed);
        Self {
            n_seeds: self.n_seeds + other.n_seeds,
            n_first: self.n_first + other.n_first,
            most_draws: self.most_draws.max(other.most_draws),
            least: match (self.least, other.least) {
                (Some(one), Some(other)) => Some(one.min(other)),
                (one, other) => one.or(other),
            },
            failed: self.failed,
        }
    }
}

/// Draws `n_seeds` sets from `first` on and prints a line a case.
pub(super) fn run(originals: &[Original], first: u64, n_seeds: u64, talk: Talk) -> Result<(), Stop> {
    let bar = Bar::cases(n_seeds * originals.len() as u64, talk);
    let seeds: Vec<u64> = (0..n_seeds).map(|n| first.wrapping_add(n)).collect();
    let set = |seed: &u64| -> Vec<Seen> {
        let one = |original: &Original| {
            let seen = Seen::of(original.vary(*seed));
            bar.add(1);
            seen
        };
        originals.par_iter().map(one).collect()
    };
    let both = |one: Vec<Seen>, other: Vec<Seen>| one.into_iter().zip(other).map(|(a, b)| a.and(b)).collect();
    let seen: Vec<Seen> = seeds.par_iter().map(set).reduce(|| vec![Seen::default(); originals.len()], both);
    drop(bar);
    print(table(originals, &seen).as_bytes())?;
    let failed: Vec<&str> = seen.iter().flat_map(|seen| &seen.failed).map(String::as_str).collect();
    if failed.is_empty() { Ok(()) } else { Err(Stop::NotPassed(failed.join("\n"))) }
}

fn table(originals: &[Original], seen: &[Seen]) -> String {
    let width = originals.iter().map(|original| original.id().len()).max().unwrap_or_default();
    let mut text = format!("{:<width$}  first draw  draws  shows  least\n", "case");
    for (original, seen) in originals.iter().zip(seen) {
        let first = 100.0 * seen.n_first as f64 / seen.n_seeds.max(1) as f64;
        let draws = if seen.failed.is_empty() { seen.most_draws.to_string() } else { "failed".to_owned() };
        let least = seen.least.map_or("–".to_owned(), |least| format!("{:.1} %", 100.0 * least));
        let shows = format!("{:.1} %", 100.0 * original.shows());
        let _ = writeln!(text, "{:<width$}  {first:>8.1} %  {draws:>5}  {shows:>6} {least:>6}", original.id());
    }
    text
}
