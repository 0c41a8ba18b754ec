//! The places where a mistake can show: pictures and unit checks.

use layers::counts::Counts;
use layers::{Shot, speckle};

use super::reply::Reply;

/// A picture or an answer of the program. Correct ones are places too, because they speak against
/// mistakes.
#[derive(Clone, Debug)]
pub(super) enum Place<'a> {
    Picture(Shot<'a>),
    Check(Reply),
}

/// What a place says about a mistake.
#[derive(Clone, Debug, Default)]
pub(super) struct Evidence {
    pub(super) counts: Counts,
    /// The pixels that the mistake explains; none for a unit check.
    pub(super) hits: Vec<u32>,
}

impl Place<'_> {
    /// Returns the id of the case or check.
    pub(super) fn id(&self) -> &str {
        match self {
            Self::Picture(shot) => &shot.sheet.id,
            Self::Check(reply) => &reply.id,
        }
    }

    /// Returns the ids of the mistakes that can show here.
    pub(super) fn mistakes(&self) -> Vec<&str> {
        match self {
            Self::Picture(shot) => shot.sheet.layers.iter().map(|one| one.id.as_str()).collect(),
            Self::Check(reply) => reply.mistakes().collect(),
        }
    }

    /// Returns the evidence about a mistake beside the named ones, or `None` if it cannot show
    /// here.
    pub(super) fn count(&self, id: &str) -> Option<Evidence> {
        let (counts, hits) = match self {
            Self::Picture(shot) if id == speckle::MISTAKE => speckle::count(shot)?,
            Self::Picture(shot) => shot.count(shot.sheet.layer(id)?),
            Self::Check(reply) => (reply.count(id), vec![]),
        };
        (counts.all() > 0).then_some(Evidence { counts, hits })
    }

    /// Marks a mistake as named. `explained` is what it explains here; `None` for nothing.
    pub(super) fn mark(&mut self, id: &str, explained: Option<&Evidence>) {
        match self {
            Self::Picture(shot) => {
                let hits = explained.map_or(&[][..], |evidence| &evidence.hits);
                if let Some(layer) = shot.sheet.layer(id) {
                    shot.mark(layer, hits);
                }
            }
            Self::Check(reply) => reply.mark(id, explained.is_some()),
        }
    }

    /// Forgets all named mistakes.
    pub(super) fn clear(&mut self) {
        match self {
            Self::Picture(shot) => shot.clear(),
            Self::Check(reply) => reply.clear(),
        }
    }
}
