//! Finds submissions whose sources are equal or nearly equal. The list is a reason for a person to
//! look, never a verdict.
//!
//! Sources are compared by fingerprints of short sequences of tokens (Schleimer, Wilkerson and
//! Aiken, *Winnowing: local algorithms for document fingerprinting*, SIGMOD 2003). Names, comments
//! and white space do not count, and neither do sequences of the template or of most submissions.

mod sketch;
mod tokens;

pub use sketch::Sketch;

use std::collections::BTreeMap;

/// The share of the fingerprints of the smaller submission above which a pair is listed.
const LISTED: f64 = 0.8;
/// The least number of fingerprints of a submission that is compared. Shorter programs are alike by
/// chance.
const FEWEST: usize = 40;
/// The least number of submissions of which most may share a sequence before it counts as known to
/// all.
const MANY: usize = 10;

/// Two submissions that are alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The ids of the submissions, in order.
    pub ids: [String; 2],
    /// The share of the fingerprints of the smaller submission that the other one has too.
    pub share: f64,
}

/// Returns the pairs of submissions that are alike, the most similar first. The result does not
/// depend on the order of `sketches`, which are given with the ids of their submissions.
pub fn pairs(sketches: &[(&str, &Sketch)]) -> Vec<Pair> {
    let mut owners: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (n, (_, sketch)) in sketches.iter().enumerate() {
        sketch.fingerprints().for_each(|one| owners.entry(one).or_default().push(n));
    }
    let n_most = if sketches.len() < MANY { sketches.len() } else { sketches.len() / 2 };
    owners.retain(|_, owners| owners.len() <= n_most);
    let mut sizes = vec![0; sketches.len()];
    let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for owners in owners.values() {
        for (at, one) in owners.iter().enumerate() {
            sizes[*one] += 1;
            owners[at + 1..]
                .iter()
                .for_each(|other| *shared.entry((*one, *other)).or_default() += 1);
        }
    }
    let listed = shared.into_iter().filter_map(|((one, other), n)| {
        let smaller = sizes[one].min(sizes[other]);
        let share = n as f64 / smaller as f64;
        let mut ids = [one, other].map(|n| sketches[n].0.to_owned());
        ids.sort();
        (smaller >= FEWEST && share >= LISTED).then_some(Pair { ids, share })
    });
    let mut pairs: Vec<Pair> = listed.collect();
    pairs.sort_by(|a, b| b.share.total_cmp(&a.share).then_with(|| a.ids.cmp(&b.ids)));
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPHERE: &str = include_str!("../../../tests/solution/src/sphere.rs");
    const TRIANGLE: &str = include_str!("../../../tests/solution/src/triangle.rs");
    const SHADOW: &str = include_str!("../../../tests/solution/src/shadow.rs");

    fn sketch(sources: &[&str]) -> Sketch {
        Sketch::new(sources.iter().copied(), &Sketch::default())
    }

    #[test]
    fn renamed_and_commented_copies_are_alike_and_other_programs_are_not() {
        let renamed = SPHERE
            .replace("ray", "beam")
            .replace("discriminant", "d")
            .replace("    ", "  ")
            .replace(";\n", "; // my own idea\n");
        let all = [SPHERE, TRIANGLE, SHADOW].join("\n");
        let (a, b, c) = (sketch(&[&all]), sketch(&[&renamed, SHADOW, TRIANGLE]), sketch(&[SHADOW]));
        let found = pairs(&[("b", &b), ("a", &a), ("other", &sketch(&[TRIANGLE])), ("tiny", &c)]);
        let ids: Vec<[&str; 2]> =
            found.iter().map(|pair| pair.ids.each_ref().map(String::as_str)).collect();
        assert_eq!(ids[0], ["a", "b"], "{found:?}");
        assert!(found[0].share > 0.95, "{found:?}");
        assert!(!ids.contains(&["other", "tiny"]), "{found:?}");
    }

    #[test]
    fn what_the_template_or_most_of_a_class_has_does_not_count() {
        let given = sketch(&[SPHERE]);
        assert_eq!(Sketch::new([SPHERE], &given).fingerprints().count(), 0);
        let class: Vec<(String, Sketch)> =
            (0..12).map(|n| (n.to_string(), sketch(&[SPHERE, TRIANGLE]))).collect();
        let class: Vec<(&str, &Sketch)> = class.iter().map(|(id, one)| (&**id, one)).collect();
        assert_eq!(pairs(&class), []);
        assert_eq!(pairs(&class[..9]).len(), 36);
        assert_eq!(pairs(&[]), []);
    }
}
