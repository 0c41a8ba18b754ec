//! From the evidence of all cases and checks to the few mistakes that explain it.

use std::collections::{BTreeMap, BTreeSet};

use super::{Came, Evidence};

/// Most mistakes that are named.
const MOST: usize = 3;
/// A mistake is named only where at least this share of what it would change came out as it says:
/// some make a mistake in one place, not all over.
const TRUST: f64 = 0.2;
/// And where that share, times the share that it explains of what is wrong and not explained yet,
/// is at least this.
const WORTH: f64 = 0.15;
/// A case is explained where this share of what is wrong in it is.
const EXPLAINED: f64 = 0.6;
/// Mistakes whose values differ by less than this share explain alike.
const ALIKE: f64 = 0.01;

/// A mistake that is named, or several that the evidence does not tell apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Ids of the mistakes, ordered.
    pub mistakes: Vec<String>,
    /// Ids of the cases and checks that it explains, in the order of the evidence.
    pub explains: Vec<String>,
}

/// How a mistake stands against the evidence; in thousandths of points.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    /// Weight of what is wrong and not explained yet, as far as it explains it.
    gain: f64,
    /// Weight of what it would change, but which came out otherwise.
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

/// The mistakes that explain what is wrong, the one that explains most first.
pub fn rank(evidence: &[Evidence]) -> Vec<Named> {
    let mut open: Vec<&Evidence> = evidence.iter().filter(|one| one.came == Came::Wrong).collect();
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

/// All mistakes against all evidence. What is wrong in what a named mistake touches too does not
/// count against another one: there two mistakes meet.
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
            match one.came {
                Came::Right => tally.against += weight,
                Came::Wrong if !touched.contains(one.id.as_str()) => {
                    tally.against += weight * (1.0 - share)
                }
                Came::Wrong => {}
            }
        }
    }
    tallies
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of evidence: what came (`=` right, `!` wrong), its weight, and the mistakes that make
    /// it fail, with the share of what is wrong that each explains.
    type Line = (char, u64, &'static [(&'static str, f64)]);

    /// What is named, with the numbers of the lines that it explains.
    fn check(lines: &[Line], expected: &[(&[&str], &[usize])]) {
        let evidence: Vec<Evidence> = lines
            .iter()
            .enumerate()
            .map(|(n, (came, weight, shares))| {
                let shares = shares.iter().map(|(id, share)| ((*id).to_owned(), *share)).collect();
                let came = if *came == '=' { Came::Right } else { Came::Wrong };
                Evidence { id: n.to_string(), weight: *weight, came, shares }
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
        // One in five, or in four: made in one place.
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
        // Where both show, neither explains the whole; that does not speak against the second.
        let together: [Line; 3] = [
            ('!', 30, &[("a", 1.0)]),
            ('!', 10, &[("b", 1.0)]),
            ('!', 10, &[("a", 0.3), ("b", 0.3)]),
        ];
        check(&together, &[(&["a"], &[0]), (&["b"], &[1])]);
    }
}
