//! Histograms of the share of the points that submissions earned.

use serde::Serialize;

/// The number of bars: one for each tenth of the points, and one for all points.
const N_BARS: usize = 11;

/// A picture of 220 × 90 units, with the baseline of the bars at 70.
#[derive(Debug, Serialize)]
pub(super) struct Histogram {
    pub(super) title: String,
    pub(super) bars: Vec<Bar>,
}

/// One bar.
#[derive(Debug, Serialize)]
pub(super) struct Bar {
    pub(super) count: usize,
    /// The share of the points that the bar represents.
    pub(super) label: String,
    x: usize,
    y: f64,
    height: f64,
}

/// Returns the histogram of pairs (earned, possible). Pairs with nothing possible are left out.
pub(super) fn of(title: String, scores: impl Iterator<Item = (u64, u64)>) -> Histogram {
    let mut counts = [0; N_BARS];
    for (earned, possible) in scores.filter(|(_, possible)| *possible > 0) {
        let tenths = u128::from(earned.min(possible)) * 10 / u128::from(possible);
        counts[usize::try_from(tenths).unwrap_or(0).min(N_BARS - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let bar = |(n, count): (usize, &usize)| {
        let height = (*count as f64 / most as f64 * 54.0 * 10.0).round() / 10.0;
        let label =
            if n == 10 { "all".to_owned() } else { format!("{}–{} %", n * 10, n * 10 + 9) };
        Bar { count: *count, label, x: n * 20, y: 70.0 - height, height }
    };
    Histogram { title, bars: counts.iter().enumerate().map(bar).collect() }
}
