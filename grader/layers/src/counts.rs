//! The evidence that one place gives about a mistake: pixels for and against it, and their weight.

/// The worth of a unit check, in pixels.
pub const CHECK: u32 = 100;

/// Weight beyond which more pixels make no better evidence. The pixels of a region depend on each
/// other: 10,000 of them are not a hundred times as good as 100.
const CAP: f64 = 40.0;
/// Weights of the counts, in hits.
const RIGHT: f64 = 1.2;
const OPEN: f64 = 0.4;
const MIXED: f64 = 0.2;
const OTHER: f64 = 0.3;
/// Number of hits below which a place does not speak for a mistake.
const FEW: u32 = 10;
/// Share of hits among hits and right pixels below which a place does not speak for a mistake.
const SHARE: f64 = 0.35;

/// Numbers of the pixels that a mistake changes, by what the program shows there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// The colour of the mistake, which no named mistake explains.
    pub hits: u32,
    /// The right colour.
    pub right: u32,
    /// Another wrong colour, where no named mistake changes the pixel.
    pub open: u32,
    /// Another wrong colour, where a named mistake changes the pixel too.
    pub mixed: u32,
    /// The colour of a named mistake, which is not that of this one.
    pub other: u32,
}

impl Counts {
    /// Returns the number of all pixels.
    pub fn all(&self) -> u32 {
        self.hits + self.right + self.open + self.mixed + self.other
    }

    /// Returns the share of hits among all pixels, 0 if there are none.
    pub fn share(&self) -> f64 {
        f64::from(self.hits) / f64::from(self.all().max(1))
    }

    /// Returns the weight of the evidence: positive for the mistake, negative against it, and 0 for
    /// no pixels.
    pub fn weight(&self) -> f64 {
        let all = f64::from(self.all());
        if all == 0.0 {
            return 0.0;
        }
        let [hits, right, open, mixed, other] =
            [self.hits, self.right, self.open, self.mixed, self.other].map(f64::from);
        let sum = hits - RIGHT * right - OPEN * open - MIXED * mixed - OTHER * other;
        let weight = all.sqrt().min(CAP) * sum / all;
        let is_for = self.hits >= FEW && hits >= SHARE * (hits + right);
        if is_for { weight } else { weight.min(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_speak_for_a_mistake_and_everything_else_against_it() {
        let counts = |hits, right, open, mixed, other| Counts { hits, right, open, mixed, other };
        for (counts, weight) in [
            (counts(0, 0, 0, 0, 0), 0.0),
            (counts(100, 0, 0, 0, 0), 10.0),
            (counts(0, 100, 0, 0, 0), -12.0),
            (counts(0, 0, 100, 0, 0), -4.0),
            (counts(0, 0, 0, 100, 0), -2.0),
            (counts(0, 0, 0, 0, 100), -3.0),
            (counts(10_000, 0, 0, 0, 0), 40.0),
            // Too few hits, and too small a share of them.
            (counts(9, 0, 0, 0, 0), 0.0),
            (counts(30, 70, 0, 0, 0), -5.4),
            (counts(50, 50, 0, 0, 0), -1.0),
            (counts(80, 20, 0, 0, 0), 5.6),
        ] {
            assert!((counts.weight() - weight).abs() < 1e-9, "{counts:?}: {}", counts.weight());
        }
    }
}
