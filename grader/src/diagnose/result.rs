//! The diagnoses in the form of the record, and what remains unexplained.

use std::collections::BTreeMap;

use cases::answer::Mistake;
use layers::film::FilmMistake;
use layers::{STRONG, Shot, regions};

use super::choose::Choice;
use super::film_names;
use super::place::Place;
use crate::record::{Confidence, Diagnosis, Explained, Unexplained, WorstPixel};

/// The value and the trust from which a mistake is named without a doubt.
const SURE_VALUE: f64 = 30.0;
const SURE_TRUST: f64 = 0.8;
/// The share of the out pixels that a film mistake must explain for the same.
const SURE_SHARE: f64 = 0.8;

/// Returns the index in the program's picture of a pixel of an undone picture; `None` if it lies
/// outside.
pub(super) type Origin<'a> = &'a dyn Fn(&Shot, u32) -> Option<u32>;

/// Returns the diagnosis of a film mistake.
pub(super) fn of_film(film: &FilmMistake, known: &[Mistake]) -> Diagnosis {
    let explained =
        |(id, n): &(String, usize)| Explained { id: id.clone(), pixels: *n as u64, region: None };
    Diagnosis {
        mistakes: vec![film_names::mistake(film.kind, known)],
        confidence: confidence(film.share >= SURE_SHARE),
        explains: film.cases.iter().map(explained).collect(),
    }
}

/// Returns the diagnosis of each choice, in order. Also marks what the choices explain, each in the
/// places that support it. The places have to be clear of marks.
pub(super) fn of_choices(
    places: &mut [Place],
    choices: &[Choice],
    known: &BTreeMap<&str, &Mistake>,
    origin: Origin,
) -> Vec<Diagnosis> {
    let mut diagnoses = vec![];
    for Choice { ids, score } in choices {
        let mut explains = vec![];
        for (at, place) in places.iter_mut().enumerate() {
            let evidence = place.count(ids[0]).filter(|_| score.support.contains(&at));
            if let Some(evidence) = &evidence {
                explains.push(explained(place, &evidence.hits, origin));
            }
            place.mark(ids[0], evidence.as_ref());
        }
        let is_sure =
            score.value() >= SURE_VALUE && score.trust() >= SURE_TRUST && score.support.len() > 1;
        diagnoses.push(Diagnosis {
            mistakes: ids.iter().filter_map(|id| Some((*known.get(id)?).clone())).collect(),
            confidence: confidence(is_sure),
            explains,
        });
    }
    diagnoses
}

fn confidence(is_sure: bool) -> Confidence {
    if is_sure { Confidence::Surely } else { Confidence::Perhaps }
}

/// Returns what a mistake explains in a place: its number of pixels and their largest region.
fn explained(place: &Place, hits: &[u32], origin: Origin) -> Explained {
    let Place::Picture(shot) = place else {
        return Explained { id: place.id().to_owned(), pixels: 0, region: None };
    };
    let mut mask = vec![false; shot.seen.len()];
    hits.iter().filter_map(|n| origin(shot, *n)).for_each(|n| mask[n as usize] = true);
    let region = regions::bounds(&regions::largest(&mask, shot.sheet.width), shot.sheet.width);
    Explained { id: place.id().to_owned(), pixels: hits.len() as u64, region }
}

/// Returns what the marked mistakes leave unexplained, or `None` if that is nothing.
///
/// A picture counts if its unexplained pixels alone would make it fail. A pixel that a named
/// mistake changes, and that differs from its right colour too faintly to be recognised, is not
/// unexplained.
pub(super) fn rest(places: &[Place], origin: Origin) -> Option<Unexplained> {
    let mut rest = Unexplained { checks: vec![], pixels: 0, worst: None };
    for place in places {
        match place {
            Place::Check(reply) if reply.is_open() => rest.checks.push(reply.id.clone()),
            Place::Check(_) => {}
            Place::Picture(shot) => {
                let Some((pixels, worst)) = rest_of(shot, origin) else { continue };
                rest.checks.push(shot.sheet.id.clone());
                rest.pixels += pixels;
                let is_worse = rest.worst.as_ref().is_none_or(|one| one.cluster < worst.cluster);
                if is_worse {
                    rest.worst = Some(worst);
                }
            }
        }
    }
    (!rest.checks.is_empty()).then_some(rest)
}

/// Returns the number of unexplained pixels of a picture, and the worst one in their largest
/// cluster. `None` if the picture would pass with these pixels.
fn rest_of(shot: &Shot, origin: Origin) -> Option<(u64, WorstPixel)> {
    let is_faint = |n: usize| shot.marks.touched[n] && shot.off[n] < STRONG;
    let open: Vec<bool> = (0..shot.seen.len())
        .map(|n| shot.out[n] && !shot.marks.explained[n] && !is_faint(n))
        .collect();
    let n_open = open.iter().filter(|is_open| **is_open).count() as u32;
    let region = regions::largest(&open, shot.sheet.width);
    let (cluster, count) = shot.sheet.allowed;
    if region.len() as u32 <= cluster && n_open <= count {
        return None;
    }
    let worst = region.iter().copied().max_by_key(|n| shot.off[*n as usize])?;
    let (worst, width) = (origin(shot, worst)?, shot.sheet.width as u32);
    let worst = WorstPixel {
        check: shot.sheet.id.clone(),
        cluster: region.len() as u64,
        pixel: [worst % width, worst / width],
    };
    Some((u64::from(n_open), worst))
}
