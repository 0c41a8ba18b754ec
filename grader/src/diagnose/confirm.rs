//! Confirms the named mistakes by rendering them together, and finds those that they hide.
//!
//! Where mistakes interact, a picture with all of them resembles no stored picture of a single one.

use std::collections::BTreeSet;

use cases::answer::Mistake;
use cases::film::Image;
use layers::{Colour, Sheet, apart, colours, regions, speckle};
use rayon::prelude::*;

use super::run::Explanation;
use crate::record::{Confidence, Diagnosis, Explained, WorstPixel};

/// Levels by which a pixel may differ from a rendered one and still count as the same.
const SAME: i16 = 2;
/// The number of pictures on which all candidates are tried.
const SAMPLE: usize = 6;
/// The greatest number of mistakes that are added.
const MOST: usize = 3;
/// The least number of pixels that a mistake must explain to be added, and the least share of the
/// pixels of the sample that are unexplained.
const FEW: usize = 60;
const SHARE: f64 = 0.15;
/// The share of the unexplained pixels from which an added mistake is named without a doubt.
const SURE: f64 = 0.5;

/// Renders the case with an index under mistakes. `None` if that fails or takes too long.
pub type Render<'a> = &'a (dyn Fn(usize, &[&str]) -> Option<Image> + Sync);

/// Returns the explanation of `pictures` after the mistakes were rendered together. Mistakes that
/// the pictures speak against are left out, and hidden ones are added.
///
/// A failure to render leaves the explanation as it is.
pub fn confirm(
    pictures: &[(&Sheet, &Image)],
    explanation: Explanation,
    known: &[Mistake],
    render: Render,
) -> Explanation {
    if explanation.is_undone
        || explanation.diagnoses.is_empty() && explanation.unexplained.is_none()
    {
        return explanation;
    }
    let wrong: Vec<Seen> = pictures
        .iter()
        .enumerate()
        .filter_map(|(at, (sheet, actual))| Seen::new(at, sheet, actual))
        .collect();
    confirmed(&wrong, &explanation, known, render).unwrap_or(explanation)
}

/// A wrong picture of the program.
struct Seen<'a> {
    /// The index of the case.
    at: usize,
    sheet: &'a Sheet,
    colours: Vec<Colour>,
    out: Vec<bool>,
}

/// For each pixel of a picture, whether it has the rendered colour.
type Match = Vec<bool>;

impl<'a> Seen<'a> {
    fn new(at: usize, sheet: &'a Sheet, actual: &Image) -> Option<Self> {
        let colours = colours(actual);
        if colours.len() != sheet.expected.len() || colours.iter().all(|one| *one == colours[0]) {
            return None;
        }
        let out: Vec<bool> =
            colours.iter().enumerate().map(|(n, one)| sheet.is_out(n, *one)).collect();
        out.contains(&true).then_some(Self { at, sheet, colours, out })
    }

    /// Compares the picture with what a program with these mistakes renders.
    fn compare(&self, mistakes: &[&str], render: Render) -> Option<Match> {
        if mistakes.is_empty() {
            return Some(self.out.iter().map(|is_out| !is_out).collect());
        }
        let rendered = colours(&render(self.at, mistakes)?);
        let pairs = rendered.iter().zip(&self.colours);
        Some(pairs.map(|(one, other)| apart(*one, *other) <= SAME).collect())
    }
}

fn n_same(one: &Match) -> usize {
    one.iter().filter(|is_same| **is_same).count()
}

/// Returns the explanation after rendering, or `None` if rendering fails.
fn confirmed(
    wrong: &[Seen],
    explanation: &Explanation,
    known: &[Mistake],
    render: Render,
) -> Option<Explanation> {
    let mut diagnoses = explanation.diagnoses.clone();
    let all = |set: &[&str]| -> Option<Vec<Match>> {
        wrong.par_iter().map(|one| one.compare(set, render)).collect()
    };
    let mut found: Vec<Mistake> = first_names(&diagnoses);
    let mut matches = all(&ids(&found))?;
    for _ in 0..MOST {
        let Some(best) = missing(wrong, &matches, &found, known, render) else { break };
        found.push(best.clone());
        let with = all(&ids(&found))?;
        let Some(diagnosis) = added(wrong, (&matches, &with), best) else {
            found.pop();
            break;
        };
        diagnoses.push(diagnosis);
        matches = with;
    }
    for at in (0..diagnoses.len()).rev().filter(|at| is_tested(&explanation.diagnoses, *at)) {
        let others = [&found[..at], &found[at + 1..]].concat();
        let without = all(&ids(&others))?;
        let sum = |matches: &[Match]| matches.iter().map(n_same).sum::<usize>();
        if sum(&without) >= sum(&matches) {
            diagnoses.remove(at);
            found = others;
            matches = without;
        }
    }
    let mut confirmed = Explanation { diagnoses, ..explanation.clone() };
    settle(&mut confirmed, wrong, &matches);
    Some(confirmed)
}

/// Returns whether a picture can speak against the diagnosis at an index. An added one was tested
/// before, one of unit checks shows in no picture, and speckles depend on the rounding of the
/// program.
fn is_tested(diagnoses: &[Diagnosis], at: usize) -> bool {
    diagnoses.get(at).is_some_and(|one| {
        one.explains.iter().any(|explained| explained.pixels > 0)
            && one.mistakes.iter().all(|mistake| mistake.id != speckle::MISTAKE)
    })
}

/// Returns the first mistake of each diagnosis.
fn first_names(diagnoses: &[Diagnosis]) -> Vec<Mistake> {
    diagnoses.iter().filter_map(|one| one.mistakes.first().cloned()).collect()
}

fn ids(mistakes: &[Mistake]) -> Vec<&str> {
    mistakes.iter().map(|one| one.id.as_str()).collect()
}

/// Returns the mistake that explains most of what `found` leaves, or `None` if none explains
/// enough. Mistakes of a decision that is taken are left out.
fn missing(
    wrong: &[Seen],
    matches: &[Match],
    found: &[Mistake],
    known: &[Mistake],
    render: Render,
) -> Option<Mistake> {
    let mut sample: Vec<(usize, &Seen, &Match)> = wrong
        .iter()
        .zip(matches)
        .map(|(one, own)| (own.len() - n_same(own), one, own))
        .filter(|(n_left, one, _)| *n_left > one.sheet.allowed.1 as usize)
        .collect();
    sample.sort_by_key(|(n_left, ..)| std::cmp::Reverse(*n_left));
    sample.truncate(SAMPLE);
    let n_left: usize = sample.iter().map(|(n_left, ..)| n_left).sum();
    let taken: BTreeSet<&str> = found.iter().map(|one| one.field.as_str()).collect();
    let gain = |candidate: &Mistake| -> Option<usize> {
        let mut set = ids(found);
        set.push(&candidate.id);
        let mut gain = 0;
        for (_, one, own) in &sample {
            if one.sheet.layer(&candidate.id).is_none() {
                continue;
            }
            let with = n_same(&one.compare(&set, render)?);
            // A mistake of the program spoils no picture.
            if n_same(own) > with + one.sheet.allowed.1 as usize {
                return None;
            }
            gain += with.saturating_sub(n_same(own));
        }
        Some(gain)
    };
    let candidates = known.par_iter().filter(|one| !taken.contains(one.field.as_str()));
    let gains = candidates.filter_map(|one| Some((gain(one)?, one)));
    let (gain, best) = gains.max_by(|(a, one), (b, other)| a.cmp(b).then(other.id.cmp(&one.id)))?;
    (gain >= FEW && gain as f64 >= SHARE * n_left as f64).then(|| best.clone())
}

/// Returns the diagnosis of an added mistake, from the matches before and after it. `None` if it
/// spoils more of all pictures than it explains.
fn added(
    wrong: &[Seen],
    (before, after): (&[Match], &[Match]),
    mistake: Mistake,
) -> Option<Diagnosis> {
    let (mut explains, mut n_left, mut n_gained, mut n_lost) = (vec![], 0, 0, 0);
    for ((one, before), after) in wrong.iter().zip(before).zip(after) {
        let gained: Match =
            before.iter().zip(after).map(|(before, after)| !before & after).collect();
        let n = n_same(&gained);
        n_left += before.len() - n_same(before);
        n_gained += n;
        n_lost += (n_same(before) + n).saturating_sub(n_same(after));
        if n > one.sheet.allowed.1 as usize {
            let width = one.sheet.width;
            let region = regions::bounds(&regions::largest(&gained, width), width);
            explains.push(Explained { id: one.sheet.id.clone(), pixels: n as u64, region });
        }
    }
    let is_sure = explains.len() > 1 && n_gained as f64 >= SURE * n_left as f64;
    let confidence = if is_sure { Confidence::Surely } else { Confidence::Perhaps };
    let is_better = !explains.is_empty() && 10 * n_lost < n_gained;
    is_better.then(|| Diagnosis { mistakes: vec![mistake], confidence, explains })
}

/// Removes from what is unexplained the pictures that look as rendered.
fn settle(explanation: &mut Explanation, wrong: &[Seen], matches: &[Match]) {
    let Some(mut rest) = explanation.unexplained.take() else { return };
    let (mut pixels, mut worst): (u64, Option<WorstPixel>) = (0, None);
    for (one, own) in wrong.iter().zip(matches) {
        let Some(place) = rest.checks.iter().position(|id| *id == one.sheet.id) else { continue };
        let open: Vec<bool> =
            one.out.iter().zip(own).map(|(is_out, is_same)| *is_out && !is_same).collect();
        let region = regions::largest(&open, one.sheet.width);
        let (n_open, (cluster, count)) = (n_same(&open), one.sheet.allowed);
        if region.len() as u32 <= cluster && n_open as u32 <= count {
            rest.checks.remove(place);
            continue;
        }
        pixels += n_open as u64;
        let off = |n: &u32| apart(one.colours[*n as usize], one.sheet.expected[*n as usize]);
        let farthest = region.iter().copied().max_by_key(off).unwrap_or(0);
        if worst.as_ref().is_none_or(|worst| worst.cluster < region.len() as u64) {
            let width = one.sheet.width as u32;
            worst = Some(WorstPixel {
                check: one.sheet.id.clone(),
                cluster: region.len() as u64,
                pixel: [farthest % width, farthest / width],
            });
        }
    }
    if !rest.checks.is_empty() {
        rest.pixels = pixels;
        rest.worst = worst;
        explanation.unexplained = Some(rest);
    }
}
