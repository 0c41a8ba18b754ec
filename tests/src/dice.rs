//! Random-looking numbers that are the same everywhere.

use reference::numbers::stream::Stream;

/// A sequence of numbers that depends only on its seed.
#[derive(Clone, Debug)]
pub struct Dice(Stream);

impl Dice {
    /// Returns the sequence of `seed`.
    pub fn new(seed: u64) -> Self {
        Self(Stream::of_seed(seed))
    }

    /// Returns the next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.bits()
    }

    /// Returns the next whole number below `n`, which must not be 0.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Returns the next number in [`least`, `most`), with 53 random bits.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + self.0.unit() * (most - least)
    }
}

#[cfg(test)]
mod tests {
    use super::Dice;

    #[test]
    fn numbers_stay_between_their_bounds_and_fill_them() {
        let mut dice = Dice::new(1);
        let drawn: Vec<f64> = (0..10_000).map(|_| dice.between(-2.0, 6.0)).collect();
        assert!(drawn.iter().all(|x| (-2.0..6.0).contains(x)));
        let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
        assert!((mean - 2.0).abs() < 0.1, "{mean}"); // four standard errors
    }
}
