//! `stage.toml` as it is written.

use crate::scene::raw::effect::EffectName;
use crate::scene::raw::numbers::Points;
use crate::scene::raw::read::{At, table};

table! {
    /// What a stage is about, in `stages/NN_name/stage.toml`.
    "a stage" RawStage {
        /// One line for people.
        title: String,
        /// What the stage is about, in a few sentences.
        about: String,
        /// The effects its cases may show; a case renders what its scene calls for and this allows.
        allows: Vec<EffectName>,
        /// The stages that a student needs first, by the names of their folders.
        needs: Vec<At<String>> = "[]",
        /// What all unit checks together earn, with at most three decimals.
        unit_points: Points,
    }
}
