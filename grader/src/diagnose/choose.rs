//! Chooses the mistakes that explain most, one after the other.

use std::collections::{BTreeMap, BTreeSet};

use layers::counts::CHECK;

use super::place::{Evidence, Place};
use super::score::{self, Fields, Score, Table};

/// The greatest number of mistakes that are named.
const MOST: usize = 8;
/// The number of candidates whose surroundings are looked at in any case.
const CANDIDATES: usize = 6;
/// The part of the best value from which a mistake with the same hits is named beside the best one.
const ALIKE: f64 = 0.95;
/// The share of the same hits from which two mistakes explain the same.
const SAME: f64 = 0.9;

/// A mistake that is named, or several that the run does not distinguish.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Choice<'k> {
    /// Ids of the mistakes, the best one first.
    pub(super) ids: Vec<&'k str>,
    pub(super) score: Score,
}

/// Returns the mistakes that explain the places, the one that explains most first, and marks them
/// in the places.
///
/// After a choice, its hits are explained. All mistakes of the same decisions are then left out,
/// because a program takes each decision in one way.
pub(super) fn choose<'k>(places: &mut [Place], fields: &Fields<'k>) -> Vec<Choice<'k>> {
    let mut wanted: BTreeSet<&str> = fields.keys().copied().collect();
    let mut table = score::table(places, &wanted);
    let mut choices: Vec<Choice> = vec![];
    while choices.len() < MOST {
        let Some(choice) = best(places, &table) else { break };
        let id = choice.ids[0];
        let decided: BTreeSet<&str> = choice.ids.iter().map(|id| fields[id]).collect();
        wanted.retain(|other| !decided.contains(fields[other]));
        let rows: Vec<Option<Evidence>> = table.iter_mut().map(|row| row.remove(id)).collect();
        for (at, evidence) in rows.iter().enumerate() {
            let explained = evidence.as_ref().filter(|_| choice.score.support.contains(&at));
            if evidence.is_some() {
                places[at].mark(id, explained);
            }
        }
        table = renewed(places, table, &rows, &wanted);
        choices.push(choice);
    }
    choices
}

/// Returns the table after a choice, which changes the rows of the places where it can show.
fn renewed<'k>(
    places: &[Place],
    table: Table<'k>,
    changed: &[Option<Evidence>],
    wanted: &BTreeSet<&'k str>,
) -> Table<'k> {
    use rayon::prelude::*;
    let row = |(at, mut row): (usize, BTreeMap<&'k str, Evidence>)| {
        if changed[at].is_some() {
            return score::row(&places[at], wanted);
        }
        row.retain(|id, _| wanted.contains(id));
        row
    };
    table.into_par_iter().enumerate().map(row).collect()
}

/// Returns the best mistake with those that explain the same, or `None` if no mistake explains
/// enough.
fn best<'k>(places: &[Place], table: &Table<'k>) -> Option<Choice<'k>> {
    let scores = score::scores(table);
    let mut candidates: Vec<(&str, &Score)> = scores
        .iter()
        .filter(|(_, score)| score.is_enough())
        .map(|(id, score)| (*id, score))
        .collect();
    candidates.sort_by(|(_, a), (_, b)| b.value().total_cmp(&a.value()));
    let mut looked_at: Vec<(&str, Score)> = vec![];
    for (n, (id, score)) in candidates.into_iter().enumerate() {
        let best = looked_at.iter().map(|(_, score)| score.value()).fold(0.0, f64::max);
        if n >= CANDIDATES && score.value() <= best {
            break;
        }
        let score = score::within_rings(places, table, id, score);
        if score.is_enough() {
            looked_at.push((id, score));
        }
    }
    looked_at.sort_by(|(_, a), (_, b)| b.value().total_cmp(&a.value()));
    let (id, score) = looked_at.first()?.clone();
    let is_alike = |(other, its): &&(&'k str, Score)| {
        its.value() >= ALIKE * score.value() && explain_the_same(table, &score.support, id, other)
    };
    let others = looked_at[1..].iter().filter(is_alike).map(|(id, _)| *id);
    Some(Choice { ids: std::iter::once(id).chain(others).collect(), score })
}

/// Returns whether two mistakes have nearly the same hits in the places `support`.
fn explain_the_same(table: &Table, support: &[usize], one: &str, other: &str) -> bool {
    let (mut n_all, mut n_same) = (0, 0);
    for row in support.iter().map(|at| &table[*at]) {
        let Some(own) = row.get(one) else { continue };
        let other = row.get(other);
        if own.hits.is_empty() {
            n_all += CHECK as usize;
            n_same += other.map_or(0, |other| other.counts.hits.min(CHECK) as usize);
        } else {
            n_all += own.hits.len();
            n_same += other.map_or(0, |other| n_common(&own.hits, &other.hits));
        }
    }
    n_same as f64 >= SAME * n_all as f64
}

/// Returns the number of common elements of two ascending lists.
fn n_common(one: &[u32], other: &[u32]) -> usize {
    one.iter().filter(|n| other.binary_search(n).is_ok()).count()
}

#[cfg(test)]
mod tests {
    use super::super::reply::tests::reply;
    use super::*;

    /// A check: the value that the program gives, where 1 is right, and those of the mistakes.
    type Line = (f64, &'static [(&'static str, f64)]);

    /// Checks the mistakes that are chosen. The decision of a mistake is its first letter.
    fn check(lines: &[Line], expected: &[&[&str]]) {
        let mut places: Vec<Place> = lines
            .iter()
            .enumerate()
            .map(|(n, (actual, wrong))| Place::Check(reply(&n.to_string(), *actual, wrong)))
            .collect();
        let ids = lines.iter().flat_map(|(_, wrong)| wrong.iter().map(|(id, _)| *id));
        let fields: Fields = ids.map(|id| (id, &id[..1])).collect();
        let chosen = choose(&mut places, &fields);
        let ids: Vec<Vec<&str>> = chosen.into_iter().map(|choice| choice.ids).collect();
        assert_eq!(ids, expected, "{lines:?}");
    }

    #[test]
    fn a_mistake_that_explains_what_is_wrong_is_chosen() {
        check(&[], &[]);
        check(&[(1.0, &[("a", 2.0)])], &[]);
        check(&[(2.0, &[("a", 2.0), ("b", 3.0)])], &[&["a"]]);
        check(&[(4.0, &[("a", 2.0), ("b", 3.0)])], &[]);
    }

    #[test]
    fn what_is_right_speaks_against_a_mistake() {
        let right: Line = (1.0, &[("a", 2.0)]);
        check(&[(2.0, &[("a", 2.0)]), right], &[]);
        check(&[(2.0, &[("a", 2.0)]), (3.0, &[("a", 3.0)]), right], &[&["a"]]);
        check(&[(2.0, &[("a", 2.0)]), (3.0, &[("a", 3.0)]), right, right, right], &[]);
    }

    #[test]
    fn mistakes_that_explain_the_same_are_chosen_together() {
        check(&[(2.0, &[("a", 2.0), ("b", 2.0)])], &[&["a", "b"]]);
        check(&[(2.0, &[("a", 2.0), ("b", 2.0)]), (1.0, &[("b", 2.0)])], &[&["a"]]);
    }

    #[test]
    fn several_mistakes_are_chosen_but_not_two_of_the_same_decision() {
        let lines: [Line; 3] =
            [(2.0, &[("a", 2.0)]), (3.0, &[("a", 2.0), ("b", 3.0)]), (2.0, &[("a", 2.0)])];
        check(&lines, &[&["a"], &["b"]]);
        let lines: [Line; 3] =
            [(2.0, &[("a1", 2.0)]), (3.0, &[("a1", 2.0), ("a2", 3.0)]), (2.0, &[("a1", 2.0)])];
        check(&lines, &[&["a1"]]);
    }
}
