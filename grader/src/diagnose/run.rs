//! All steps of a diagnosis in order.

use std::collections::BTreeMap;

use cases::answer::Mistake;
use cases::film::Image;
use layers::film::{self, Frame, Undone};
use layers::{Sheet, Shot};

use super::choose::choose;
use super::place::Place;
use super::reply::Reply;
use super::result;
use super::score::Fields;
use super::second_look::second_look;
use crate::record::{Diagnosis, Unexplained};

/// The explanation of what is wrong with a submission.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// The mistakes: first those that the program makes in whole pictures, then those that explain
    /// most.
    pub diagnoses: Vec<Diagnosis>,
    /// What no mistake explains, or `None` if that is nothing.
    pub unexplained: Option<Unexplained>,
    /// Whether a mistake of whole pictures was undone first. The pictures then do not show what the
    /// layers of the other mistakes hold.
    pub is_undone: bool,
}

/// Explains pictures and answers of a program by the mistakes in `known`.
///
/// Right pictures and answers belong to the evidence. A picture of another size than its sheet is
/// left out. A picture of one colour speaks neither for nor against a mistake, and stays
/// unexplained if it is wrong.
pub fn diagnose(
    pictures: &[(&Sheet, &Image)],
    mut replies: Vec<Reply>,
    known: &[Mistake],
) -> Explanation {
    Reply::mute(&mut replies);
    let frames = pictures.iter().filter_map(|(sheet, actual)| Frame::new(sheet, actual));
    let (mute, frames): (Vec<Frame>, Vec<Frame>) = frames.partition(Frame::is_mute);
    let Undone { frames, curved, moved, mistakes } = film::undo(frames);
    let shots = frames.into_iter().enumerate().map(|(n, Frame { sheet, seen, end })| {
        let sheet = curved.as_ref().map_or(sheet, |sheets| &sheets[n]);
        Place::Picture(Shot::new(sheet, seen, end))
    });
    let mut places: Vec<Place> = shots.chain(replies.into_iter().map(Place::Check)).collect();

    let by_id: BTreeMap<&str, &Mistake> = known.iter().map(|one| (one.id.as_str(), one)).collect();
    let fields: Fields = known.iter().map(|one| (one.id.as_str(), one.field.as_str())).collect();
    let choices = choose(&mut places, &fields);
    let choices = second_look(&mut places, &fields, choices);

    let origin = |shot: &Shot, n: u32| match moved {
        None => Some(n),
        Some(moved) => {
            let (width, n_pixels) = (shot.sheet.width, shot.seen.len());
            moved.place(n as usize, width, n_pixels / width.max(1)).map(|place| place as u32)
        }
    };
    places.iter_mut().for_each(Place::clear);
    let mut diagnoses: Vec<Diagnosis> =
        mistakes.iter().map(|one| result::of_film(one, known)).collect();
    diagnoses.extend(result::of_choices(&mut places, &choices, &by_id, &origin));
    let mute = mute.into_iter().map(|one| Place::Picture(Shot::new(one.sheet, one.seen, one.end)));
    places.extend(mute);
    Explanation {
        diagnoses,
        unexplained: result::rest(&places, &origin),
        is_undone: !mistakes.is_empty(),
    }
}
