//! The fingerprints of the sources of a submission.

use std::collections::BTreeSet;

use super::tokens::{START, Token, mix, tokens};

/// Number of tokens in a sequence.
const SEQUENCE: usize = 16;
/// Of so many sequences in a row, one becomes a fingerprint. Equal sources of
/// `SEQUENCE + WINDOW − 1` tokens therefore share one, wherever they stand.
const WINDOW: usize = 8;

/// The fingerprints of the sources of a submission.
#[derive(Clone, Debug, Default)]
pub struct Sketch(BTreeSet<u64>);

impl Sketch {
    /// Returns the fingerprints of `sources` that `given` lacks.
    pub fn new<'a>(sources: impl IntoIterator<Item = &'a str>, given: &Self) -> Self {
        let all = sources.into_iter().flat_map(winnow);
        Self(all.filter(|one| !given.0.contains(one)).collect())
    }

    pub(super) fn fingerprints(&self) -> impl Iterator<Item = u64> + '_ {
        self.0.iter().copied()
    }
}

/// Returns the least hash in each window of sequences.
fn winnow(source: &str) -> BTreeSet<u64> {
    let tokens = tokens(source);
    let hashes: Vec<u64> = tokens.windows(SEQUENCE).map(of_sequence).collect();
    let least = |window: &[u64]| window.iter().min().copied();
    match hashes.len() {
        0..WINDOW => least(&hashes).into_iter().collect(),
        _ => hashes.windows(WINDOW).filter_map(least).collect(),
    }
}

/// Returns a hash of a sequence of tokens that is the same on every machine.
fn of_sequence(tokens: &[Token]) -> u64 {
    tokens.iter().fold(START, |hash, token| match token {
        Token::Name => mix(hash, 1),
        Token::Text => mix(hash, 2),
        Token::Sign(sign) => mix(mix(hash, 3), u64::from(*sign)),
        Token::Number(number) => mix(mix(hash, 4), *number),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_that_is_long_enough_is_found_wherever_it_stands() {
        let shared: String = (0..SEQUENCE + WINDOW).map(|n| format!("f({n}) + ")).collect();
        let one = winnow(&format!("begin [ {shared} ]"));
        let other = winnow(&format!("x = 17; y = x * x; {shared} - 3"));
        assert!(one.intersection(&other).next().is_some());
        assert!(winnow("a + b").is_empty());
    }
}
