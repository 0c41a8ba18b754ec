//! A second look at each choice: the first choices are made before it is known what overlaps them.

use super::choose::Choice;
use super::place::Place;
use super::score::{self, Fields, Score};

/// The factor and the amount by which another mistake of the same decision must be better to
/// replace a choice.
const FACTOR: f64 = 1.1;
const AMOUNT: f64 = 1.0;

/// Weighs each choice again beside all others, and returns those that remain.
///
/// A choice whose evidence is no longer enough is dropped. Another mistake of the same decision
/// replaces it if that one is clearly better. At the end, the places are marked with the choices
/// that remain.
pub(super) fn second_look<'k>(
    places: &mut [Place],
    fields: &Fields<'k>,
    choices: Vec<Choice<'k>>,
) -> Vec<Choice<'k>> {
    if choices.len() < 2 {
        return choices;
    }
    let mut remaining: Vec<Option<Choice>> = choices.into_iter().map(Some).collect();
    for n in 0..remaining.len() {
        let Some(choice) = remaining[n].take() else { continue };
        let others: Vec<&Choice> = remaining.iter().flatten().collect();
        mark(places, &others);
        remaining[n] = weighed(places, fields, choice);
    }
    let remaining: Vec<Choice> = remaining.into_iter().flatten().collect();
    mark(places, &remaining.iter().collect::<Vec<_>>());
    remaining
}

/// Marks the places with the first mistakes of these choices and no others.
pub(super) fn mark(places: &mut [Place], choices: &[&Choice]) {
    use rayon::prelude::*;
    places.par_iter_mut().for_each(|place| {
        place.clear();
        for choice in choices {
            let evidence = place.count(choice.ids[0]);
            place.mark(choice.ids[0], evidence.as_ref().filter(|one| one.counts.hits > 0));
        }
    });
}

/// Returns the choice with its score beside the marked mistakes, or what replaces it.
fn weighed<'k>(places: &[Place], fields: &Fields<'k>, choice: Choice<'k>) -> Option<Choice<'k>> {
    let is_kin = |id: &&str| choice.ids.iter().any(|own| fields[own] == fields[id]);
    let table = score::table(places, &fields.keys().copied().filter(is_kin).collect());
    let mut scores: Vec<(&str, Score)> = score::scores(&table)
        .into_iter()
        .map(|(id, score)| (id, score::within_rings(places, &table, id, &score)))
        .filter(|(_, score)| score.is_enough())
        .collect();
    scores.sort_by(|(_, a), (_, b)| b.value().total_cmp(&a.value()));
    let (best, best_score) = scores.first()?.clone();
    let Some((own, own_score)) = scores.into_iter().find(|(id, _)| choice.ids.contains(id)) else {
        return Some(Choice { ids: vec![best], score: best_score });
    };
    if best_score.value() > FACTOR * own_score.value() + AMOUNT {
        return Some(Choice { ids: vec![best], score: best_score });
    }
    let others = choice.ids.into_iter().filter(|id| *id != own);
    Some(Choice { ids: std::iter::once(own).chain(others).collect(), score: own_score })
}
