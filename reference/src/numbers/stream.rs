//! Pseudorandom numbers that are the same on every machine: SplitMix64, with a stream for each seed
//! and name.

/// A stream of pseudorandom numbers.
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// Returns the stream of a name (of a case, of a family) under a seed. It depends on no other
    /// stream.
    pub fn new(seed: u64, name: &str) -> Self {
        // FNV-1a of the name, so that neighbouring seeds of one case, and equal seeds of two cases,
        // give unrelated streams.
        let name = name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        });
        Self(Self(seed).bits() ^ name)
    }

    /// Returns the stream that the published generator gives for a seed.
    pub fn of_seed(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns the next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// Returns a number in [0, 1), one of 2⁵³ values at equal distances.
    pub fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1u64 << 53) as f64;
        (self.bits() >> 11) as f64 * STEP
    }

    /// Returns a whole number from −`most` to `most`. For `most` < 2²³, all are equally likely
    /// except for one part in 2⁴⁰.
    pub fn within(&mut self, most: u32) -> i64 {
        let n_values = 2 * u128::from(most) + 1;
        let drawn = (u128::from(self.bits()) * n_values) >> 64;
        drawn as i64 - i64::from(most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of the published generator from the state 1234567.
    #[test]
    fn is_split_mix_64() {
        let mut stream = Stream::of_seed(1_234_567);
        let drawn: Vec<u64> = (0..5).map(|_| stream.bits()).collect();
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(drawn, published);
    }

    #[test]
    fn reaches_both_ends_and_no_farther() {
        let mut stream = Stream::new(1, "a");
        let drawn: Vec<i64> = (0..1000).map(|_| stream.within(3)).collect();
        for value in -3..=3 {
            assert!(drawn.contains(&value), "{value} was never drawn");
        }
        assert!(drawn.iter().all(|value| value.abs() <= 3));
        assert_eq!(stream.within(0), 0);
    }

    #[test]
    fn seeds_and_cases_have_streams_of_their_own() {
        let first = |seed, case| Stream::new(seed, case).bits();
        let firsts = [first(1, "a"), first(2, "a"), first(1, "b"), first(2, "b"), first(0, "a")];
        for (at, one) in firsts.iter().enumerate() {
            assert!(!firsts[..at].contains(one), "{firsts:?}");
        }
        assert_eq!(first(7, "a"), first(7, "a"));
    }
}
