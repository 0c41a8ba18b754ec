//! The value of each mistake over all places.

use std::collections::{BTreeMap, BTreeSet};

use layers::ring;
use rayon::prelude::*;

use super::place::{Evidence, Place};

/// The value from which a mistake may be named.
pub(super) const ENOUGH: f64 = 4.0;
/// The least share of the evidence for a mistake in all evidence about it.
const TRUST: f64 = 0.43;
/// The part of the evidence against a mistake that lowers its value. The part is small because some
/// programs make a mistake in one place only.
const AGAINST: f64 = 0.25;
/// The share of right surroundings below which a place does not support a mistake.
const CLEAN: f64 = 0.25;
/// The share of hits from which a single place is enough to support a mistake, and from which the
/// hits may have any colours.
const SINGLE: f64 = 0.6;
const WHOLE: f64 = 0.95;
/// Number of colours that the hits in a single place need. A region of one or two colours fits too
/// easily.
const COLOURS: usize = 3;
/// Step in levels by which these colours are distinguished, and the least share of the hits that
/// each of them has.
const STEP: i16 = 24;
const LEAST: f64 = 0.02;

/// The known mistakes, each with the decision that it takes wrongly.
pub(super) type Fields<'k> = BTreeMap<&'k str, &'k str>;
/// For each place, the evidence about the mistakes that can show there.
pub(super) type Table<'k> = Vec<BTreeMap<&'k str, Evidence>>;

/// The evidence about a mistake over all places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Score {
    /// The sum of the weights that speak for the mistake.
    pub(super) pro: f64,
    /// The sum of the weights that speak against it, positive.
    pub(super) contra: f64,
    /// The indices of the places that speak for it, ascending.
    pub(super) support: Vec<usize>,
}

impl Score {
    /// Returns the value by which mistakes are compared.
    pub(super) fn value(&self) -> f64 {
        self.pro - AGAINST * self.contra
    }

    /// Returns the share of the evidence for the mistake in all evidence about it, 0 to 1.
    pub(super) fn trust(&self) -> f64 {
        if self.pro > 0.0 { self.pro / (self.pro + self.contra) } else { 0.0 }
    }

    /// Returns whether the evidence is enough to name the mistake.
    pub(super) fn is_enough(&self) -> bool {
        self.value() >= ENOUGH && self.trust() >= TRUST
    }
}

/// Returns the evidence of each place about the mistakes in `wanted`.
pub(super) fn table<'k>(places: &[Place], wanted: &BTreeSet<&'k str>) -> Table<'k> {
    places.par_iter().map(|place| row(place, wanted)).collect()
}

/// Returns the evidence of one place about the mistakes in `wanted`.
pub(super) fn row<'k>(place: &Place, wanted: &BTreeSet<&'k str>) -> BTreeMap<&'k str, Evidence> {
    let known = place.mistakes().into_iter().filter_map(|id| wanted.get(id).copied());
    known.filter_map(|id| Some((id, place.count(id)?))).collect()
}

/// Returns the score of each mistake, without a look at the surroundings.
pub(super) fn scores<'k>(table: &Table<'k>) -> BTreeMap<&'k str, Score> {
    let mut scores: BTreeMap<&str, Score> = BTreeMap::new();
    for (at, row) in table.iter().enumerate() {
        for (id, evidence) in row {
            let (score, weight) = (scores.entry(id).or_default(), evidence.counts.weight());
            if weight > 0.0 {
                score.pro += weight;
                score.support.push(at);
            } else {
                score.contra -= weight;
            }
        }
    }
    scores
}

/// Returns `score` without what the surroundings of the hits take away, and without a single place
/// that is not enough.
pub(super) fn within_rings(places: &[Place], table: &Table, id: &str, score: &Score) -> Score {
    let kept: Vec<(usize, f64)> = score
        .support
        .par_iter()
        .filter_map(|at| {
            let evidence = table[*at].get(id)?;
            let clean = 1.0 - wrong_around(&places[*at], id, evidence);
            (clean > CLEAN).then_some((*at, clean * evidence.counts.weight()))
        })
        .collect();
    let is_weak = match kept.as_slice() {
        [(at, _)] => !is_enough_alone(&places[*at], &table[*at][id], score.contra),
        _ => false,
    };
    let kept = if is_weak { vec![] } else { kept };
    Score {
        pro: kept.iter().map(|(_, weight)| weight).sum(),
        contra: score.contra,
        support: kept.into_iter().map(|(at, _)| at).collect(),
    }
}

fn wrong_around(place: &Place, id: &str, evidence: &Evidence) -> f64 {
    let Place::Picture(shot) = place else { return 0.0 };
    shot.sheet.layer(id).map_or(0.0, |layer| ring::wrong_share(shot, layer, &evidence.hits))
}

/// Returns whether a mistake may be named for this place alone, where all evidence against it has
/// the weight `contra`.
///
/// One wrong answer to a unit check is a number that other bugs may give as well. It is enough only
/// if nothing speaks against the mistake.
fn is_enough_alone(place: &Place, evidence: &Evidence, contra: f64) -> bool {
    let share = evidence.counts.share();
    let Place::Picture(shot) = place else { return share >= SINGLE && contra == 0.0 };
    share >= WHOLE || share >= SINGLE && n_colours(shot.seen.as_slice(), &evidence.hits) >= COLOURS
}

/// Returns the number of clearly different colours that the pixels `hits` show.
fn n_colours(seen: &[[i16; 3]], hits: &[u32]) -> usize {
    let mut counts: BTreeMap<[i16; 3], usize> = BTreeMap::new();
    for n in hits {
        *counts.entry(seen[*n as usize].map(|level| level / STEP)).or_default() += 1;
    }
    let least = LEAST * hits.len() as f64;
    counts.values().filter(|count| **count as f64 > least).count()
}

#[cfg(test)]
mod tests {
    use cases::answer::{ImageAnswer, Wrong};
    use cases::film::Image;
    use cases::glam::DVec3;
    use layers::{Sheet, Shot};

    use super::super::reply::tests::reply;
    use super::*;

    #[test]
    fn evidence_adds_up_over_places() {
        let places = [
            Place::Check(reply("a", 2.0, &[("m", 2.0), ("o", 3.0)])),
            Place::Check(reply("b", 1.0, &[("o", 3.0)])),
            Place::Check(reply("c", 2.0, &[("m", 2.0)])),
        ];
        let scores = scores(&table(&places, &["m", "o"].into()));
        assert_eq!(scores["m"], Score { pro: 20.0, contra: 0.0, support: vec![0, 2] });
        assert_eq!(scores["o"], Score { pro: 0.0, contra: 16.0, support: vec![] });
        assert!(scores["m"].is_enough() && !scores["o"].is_enough());
        let weak = Score { pro: 10.0, contra: 20.0, support: vec![0] };
        assert!((weak.value(), weak.is_enough()) == (5.0, false), "{}", weak.trust());
    }

    #[test]
    fn a_single_picture_of_few_colours_supports_a_mistake_only_if_it_fits_wholly() {
        let grey = Image::from_fn(10, 10, |_, _| DVec3::splat(100.0 / 255.0));
        let wrong = Wrong::new("m", vec![Some([40; 3]); 100]);
        let sheet = Sheet::new("a", &ImageAnswer::exact(grey, 1.0, 0), &[wrong]);
        let support = |seen: &dyn Fn(usize) -> i16| {
            let seen = (0..100).map(|n| [seen(n); 3]).collect();
            let places = [Place::Picture(Shot::new(&sheet, seen, 100))];
            let table = table(&places, &["m"].into());
            within_rings(&places, &table, "m", &scores(&table)["m"]).support
        };
        assert_eq!(support(&|_| 40), [0]);
        assert_eq!(support(&|n| if n < 10 { 160 } else { 40 }), [0usize; 0]);
    }
}
