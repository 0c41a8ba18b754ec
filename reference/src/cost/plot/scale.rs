//! Logarithmic scales and their ticks.

use cases::maths;

/// A logarithmic scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// The decimal logarithms of the ends.
    pub(super) from: (f64, f64),
    /// The places of the ends.
    pub(super) to: (f64, f64),
}

impl Scale {
    /// Returns the scale that maps the range of `values`, with a margin on either side, to `to`.
    /// Without values the range is 1 to 10.
    pub(super) fn new(values: impl Iterator<Item = f64>, to: (f64, f64)) -> Self {
        let (least, greatest) =
            values.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        let (least, greatest) = if least <= greatest { (least, greatest) } else { (1.0, 10.0) };
        let room = 0.06 * (log10(greatest) - log10(least)).max(0.5);
        Self { from: (log10(least) - room, log10(greatest) + room), to }
    }

    /// Returns the place of a value above 0.
    pub(super) fn at(&self, value: f64) -> f64 {
        let share = (log10(value) - self.from.0) / (self.from.1 - self.from.0);
        self.to.0 + share * (self.to.1 - self.to.0)
    }

    /// Returns the values to mark, at least three: powers of ten, or some of them if there are
    /// many. If there are few, also twice and five times each power; if there are still fewer than
    /// three, multiples of one step.
    pub(super) fn ticks(&self) -> Vec<f64> {
        let (first, last) = (self.from.0.floor() as i32, self.from.1.ceil() as i32);
        let step = (last - first).div_euclid(8) + 1;
        let multiples: &[f64] =
            if self.from.1 - self.from.0 < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = (first..=last).filter(|n| n.rem_euclid(step) == 0);
        let values =
            decades.flat_map(|n| multiples.iter().map(move |m| m * maths::pow(10.0, f64::from(n))));
        let ticks: Vec<f64> =
            values.filter(|v| (self.from.0..=self.from.1).contains(&log10(*v))).collect();
        if ticks.len() < 3 { self.even_ticks() } else { ticks }
    }

    /// Returns the multiples of the greatest step of 1, 2 or 5 times a power of ten that lie on the
    /// scale at least three times.
    fn even_ticks(&self) -> Vec<f64> {
        let (low, high) = (maths::pow(10.0, self.from.0), maths::pow(10.0, self.from.1));
        let top = log10(high - low).ceil() as i32;
        let steps = (0..4).flat_map(|n| [5.0, 2.0, 1.0].map(|m| (m, top - n)));
        let multiples = |(m, power): (f64, i32)| {
            // A division by a power of ten is exact where a product is not: 3 / 10, not 3 · 0.1.
            let of = |n: f64| {
                let scale = maths::pow(10.0, f64::from(power.abs()));
                if power < 0 { n * m / scale } else { n * m * scale }
            };
            let first = (low / of(1.0)).ceil() as i64;
            let last = (high / of(1.0)).floor() as i64;
            (first..=last).map(|n| of(n as f64)).collect::<Vec<f64>>()
        };
        steps.map(multiples).find(|ticks| ticks.len() >= 3).unwrap_or_default()
    }
}

fn log10(x: f64) -> f64 {
    maths::ln(x) / std::f64::consts::LN_10
}

/// Returns the text of a tick: a decimal from 0.001 to below 100,000, otherwise with an exponent.
pub(super) fn number(x: f64) -> String {
    if (1e-3..1e5).contains(&x) {
        format!("{:.4}", x).trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{x:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(scale: &Scale) -> Vec<String> {
        scale.ticks().into_iter().map(number).collect()
    }

    #[test]
    fn a_scale_takes_powers_of_ten_to_equal_steps() {
        let scale = Scale { from: (0.0, 2.0), to: (100.0, 300.0) };
        for (value, at) in [(1.0, 100.0), (10.0, 200.0), (100.0, 300.0)] {
            assert!((scale.at(value) - at).abs() < 1e-9, "{value}");
        }
        assert_eq!(texts(&scale), ["1", "2", "5", "10", "20", "50", "100"]);
        let long = Scale { from: (-12.5, 3.5), to: (0.0, 1.0) };
        assert_eq!(texts(&long), ["1e-12", "1e-9", "1e-6", "0.001", "1", "1000"]);
    }

    #[test]
    fn a_short_scale_has_three_ticks_too() {
        let between = |low, high| Scale { from: (log10(low), log10(high)), to: (0.0, 1.0) };
        assert_eq!(texts(&between(5.1, 9.2)), ["6", "7", "8", "9"]);
        for (low, high) in [(5.1, 5.9), (9.7, 10.4), (0.31, 0.32), (1234.0, 1236.0), (3.0, 3.3)] {
            let ticks = between(low, high).ticks();
            assert!(ticks.len() >= 3, "{low} to {high}: {ticks:?}");
            assert!(ticks.iter().all(|tick| (low..=high).contains(tick)), "{ticks:?}");
        }
    }
}
