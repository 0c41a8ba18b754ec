//! `stage.toml` and case files as they are written.

use crate::scene::raw::effect::EffectName;
use crate::scene::raw::numbers::{Points, Rule};
use crate::scene::raw::read::{At, Maybe, table};
use crate::scene::raw::vary::RawVary;
use crate::scene::raw::{RawRender, RawScene};

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

table! {
    /// An image case of a stage: what to render, and what it is worth.
    "a case" RawCase {
        /// One line for people: what the case shows.
        title: String,
        /// What the case tests, and what a wrong answer looks like.
        about: String,
        /// The numbers of the rules of light that the case tests, each from 1 to 25.
        rules: Vec<Rule>,
        /// What a right picture earns, with at most three decimals.
        points: Points,
        /// Size of the picture and depth of the recursion.
        render: Maybe<RawRender>,
        /// Camera, lights, materials and objects.
        scene: Maybe<RawScene>,
        /// How far `reference vary` may move its numbers. Left out: the case cannot be varied.
        vary: Option<RawVary>,
    }
}
