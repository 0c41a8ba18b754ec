//! What to simulate in a picture, and how finely.

use cases::Effects;

use super::simulated::AllEffects;
use crate::world::World;

/// The effects to simulate, and the accuracy.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The effects to simulate.
    pub effects: Effects,
    /// N for a regular grid of N × N rays per pixel, at least 1. The colour of the pixel is their
    /// mean.
    pub samples: u32,
    /// Whether only pixels that differ from a neighbour get that grid; the others get one ray. See
    /// [`adaptive`](super::adaptive).
    pub adaptive: bool,
    /// The light below which a light source is skipped at a point; 0 skips none.
    pub light_cutoff: f64,
    /// Whether neighbouring eye rays may be searched for together.
    pub packets: bool,
}

impl Options {
    /// Returns the effects of the scene with one ray per pixel, no light cutoff, and packets.
    pub fn of<T>(world: &World<T>) -> Self {
        Self {
            effects: world.effects,
            samples: 1,
            adaptive: false,
            light_cutoff: 0.0,
            packets: true,
        }
    }

    /// Returns the effects, looked up by the kernel.
    pub(crate) fn any(&self) -> AllEffects {
        AllEffects::of(self.effects, self.light_cutoff)
    }
}
