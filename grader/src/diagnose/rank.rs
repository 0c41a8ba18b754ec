//! Ranks the few mistakes that explain the evidence of all cases and checks.

use std::collections::{BTreeMap, BTreeSet};

use super::{Correctness, Evidence};

/// The maximum number of diagnoses.
const MOST: usize = 3;
/// A mistake is named only if at least this share of what it would change came out accordingly. The
/// threshold is low because some submissions make a mistake in one place only.
const TRUST: f64 = 0.2;
/// A mistake is named only if that share, times the share of the unexplained error that it
/// explains, is at least this value.
const WORTH: f64 = 0.15;
/// A case counts as explained if this share of its error is explained.
const EXPLAINED: f64 = 0.6;
/// Mistakes with values that differ by less than this share are named together.
const ALIKE: f64 = 0.01;

/// A mistake that is named, or several that the evidence does not distinguish.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Ids of the mistakes, ordered.
    pub mistakes: Vec<String>,
    /// Ids of the cases and checks that the mistakes explain, in the order of the evidence.
    pub explains: Vec<String>,
}

/// The evidence for and against one mistake, in thousandths of points.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    /// The weight of the unexplained errors, times the share that the mistake explains.
    gain: f64,
    /// The weight of what the mistake would change but did not.
    against: f64,
}

impl Tally {
    fn trust(self) -> f64 {
        if self.gain > 0.0 { self.gain / (self.gain + self.against) } else { 0.0 }
    }

    fn value(self) -> f64 {
        self.gain * self.trust()
    }
}

/// Returns at most three mistakes that explain the errors, the one that explains most first.
pub fn rank(evidence: &[Evidence]) -> Vec<Named> {
    let mut open: Vec<&Evidence> =
        evidence.iter().filter(|one| one.correctness == Correctness::Wrong).collect();
    let mut named: Vec<Named> = vec![];
    while named.len() < MOST && !open.is_empty() {
        let touched: BTreeSet<&str> = evidence
            .iter()
            .filter(|one| {
                named.iter().flat_map(|named| &named.mistakes).any(|id| one.shares.contains_key(id))
            })
            .map(|one| one.id.as_str())
            .collect();
        let tallies = tally(evidence, &open, &touched);
        let wrong: f64 = open.iter().map(|one| one.weight as f64).sum();
        let known: BTreeSet<&String> = named.iter().flat_map(|named| &named.mistakes).collect();
        let is_named = |(id, tally): &(&&str, &Tally)| {
            tally.trust() >= TRUST
                && tally.value() >= WORTH * wrong
                && !known.contains(&id.to_string())
        };
        let candidates: Vec<(&&str, &Tally)> = tallies.iter().filter(is_named).collect();
        let Some(best) = candidates.iter().map(|(_, tally)| tally.value()).max_by(f64::total_cmp)
        else {
            break;
        };
        let equals: Vec<String> = candidates
            .iter()
            .filter(|(_, tally)| tally.value() >= best * (1.0 - ALIKE))
            .map(|(id, _)| (**id).to_owned())
            .collect();
        let is_explained = |one: &&Evidence| {
            equals.iter().any(|id| one.shares.get(id).is_some_and(|share| *share >= EXPLAINED))
        };
        let (explained, rest): (Vec<&Evidence>, Vec<&Evidence>) =
            open.iter().copied().partition(is_explained);
        if explained.is_empty() {
            break;
        }
        open = rest;
        named.push(Named {
            mistakes: equals,
            explains: explained.into_iter().map(|one| one.id.clone()).collect(),
        });
    }
    named
}

/// Weighs all mistakes against all evidence. An error in a case or check that a named mistake also
/// affects does not count against another mistake, because the two mistakes overlap there.
fn tally<'a>(
    evidence: &'a [Evidence],
    open: &[&Evidence],
    touched: &BTreeSet<&str>,
) -> BTreeMap<&'a str, Tally> {
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    let open: BTreeSet<&str> = open.iter().map(|one| one.id.as_str()).collect();
    for one in evidence {
        let weight = one.weight as f64;
        for (id, share) in &one.shares {
            let tally = tallies.entry(id).or_default();
            let is_open = open.contains(one.id.as_str());
            if is_open {
                tally.gain += weight * share;
            }
            match one.correctness {
                Correctness::Right => tally.against += weight,
                Correctness::Wrong if !touched.contains(one.id.as_str()) => {
                    tally.against += weight * (1.0 - share)
                }
                Correctness::Wrong => {}
            }
        }
    }
    tallies
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of evidence. It holds the answer (`=` correct, `!` wrong), its weight, and the
    /// mistakes that fail it, each with the share of the error that it explains.
    type Line = (char, u64, &'static [(&'static str, f64)]);

    /// Checks the mistakes that are named, each with the numbers of the lines that it explains.
    fn check(lines: &[Line], expected: &[(&[&str], &[usize])]) {
        let evidence: Vec<Evidence> = lines
            .iter()
            .enumerate()
            .map(|(n, (correctness, weight, shares))| {
                let shares = shares.iter().map(|(id, share)| ((*id).to_owned(), *share)).collect();
                let correctness =
                    if *correctness == '=' { Correctness::Right } else { Correctness::Wrong };
                Evidence { id: n.to_string(), weight: *weight, correctness, shares }
            })
            .collect();
        let strings = |list: &[&str]| list.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
        let wanted = expected.iter().map(|(mistakes, explains)| Named {
            mistakes: strings(mistakes),
            explains: explains.iter().map(usize::to_string).collect(),
        });
        assert_eq!(rank(&evidence), wanted.collect::<Vec<_>>(), "{lines:?}");
    }

    #[test]
    fn a_mistake_that_explains_what_is_wrong_is_named() {
        check(&[], &[]);
        check(&[('=', 10, &[("a", 0.0)])], &[]);
        check(&[('!', 10, &[("a", 1.0), ("b", 0.2)]), ('=', 10, &[("b", 0.0)])], &[(&["a"], &[0])]);
        check(
            &[('!', 10, &[("a", 0.9)]), ('!', 10, &[("a", 0.8)]), ('!', 1, &[])],
            &[(&["a"], &[0, 1])],
        );
    }

    #[test]
    fn what_came_out_otherwise_speaks_against_it() {
        // A mistake in one place: a share of 1/6 is too small, 1/4 is enough.
        check(&[('!', 10, &[("a", 1.0)]), ('=', 50, &[("a", 0.0)])], &[]);
        check(&[('!', 10, &[("a", 1.0)]), ('=', 30, &[("a", 0.0)])], &[(&["a"], &[0])]);
        check(&[('!', 10, &[("a", 1.0)]), ('!', 10, &[("a", 0.0)])], &[(&["a"], &[0])]);
        check(&[('!', 10, &[("a", 1.0)]), ('!', 20, &[("a", 0.0)])], &[]);
    }

    #[test]
    fn what_nothing_explains_is_left_unnamed() {
        check(&[('!', 10, &[])], &[]);
        check(&[('!', 10, &[("a", 0.3), ("b", 0.4)])], &[]);
        check(&[('!', 10, &[("a", 1.0)]), ('!', 90, &[])], &[]);
    }

    #[test]
    fn mistakes_that_explain_alike_are_named_together_until_something_tells_them_apart() {
        check(&[('!', 10, &[("a", 1.0), ("b", 1.0)])], &[(&["a", "b"], &[0])]);
        check(&[('!', 10, &[("a", 1.0), ("b", 1.0)]), ('=', 1, &[("b", 0.0)])], &[(&["a"], &[0])]);
        check(&[('!', 10, &[("a", 1.0), ("b", 0.9)])], &[(&["a"], &[0])]);
    }

    #[test]
    fn two_mistakes_at_once_are_named_one_after_the_other() {
        let apart: [Line; 3] =
            [('!', 20, &[("a", 1.0)]), ('!', 10, &[("b", 1.0)]), ('=', 10, &[("c", 0.0)])];
        check(&apart, &[(&["a"], &[0]), (&["b"], &[1])]);
        // Where both mistakes show, neither explains the whole error. That does not count against
        // the second.
        let together: [Line; 3] = [
            ('!', 30, &[("a", 1.0)]),
            ('!', 10, &[("b", 1.0)]),
            ('!', 10, &[("a", 0.3), ("b", 0.3)]),
        ];
        check(&together, &[(&["a"], &[0]), (&["b"], &[1])]);
    }
}
