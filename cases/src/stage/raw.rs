//! `stage.toml` and case files as they are written.

use crate::scene::raw::effect::EffectName;
use crate::scene::raw::numbers::{PartialShare, Points, Rule};
use crate::scene::raw::read::{At, Maybe, table};
use crate::scene::raw::vary::RawVary;
use crate::scene::raw::{RawRender, RawScene};

table! {
    /// A stage, in `stages/NN_name/stage.toml`.
    "a stage" RawStage {
        /// One line for people.
        title: String,
        /// A description of the stage, in a few sentences.
        about: String,
        /// The effects that its cases may show. A case shows those that its scene calls for.
        allows: Vec<EffectName>,
        /// The stages that a student needs first, by the names of their folders.
        needs: Vec<At<String>> = "[]",
        /// Points for all unit checks together, with at most three decimals.
        unit_points: Points,
        /// The share of a case's points up to which counts as right what a known mistake explains
        /// whose rule another stage teaches.
        explained_share: PartialShare = "0.8",
    }
}

table! {
    /// An image case of a stage: a scene to render, and the points for it.
    "a case" RawCase {
        /// One line for people that says what the case shows.
        title: String,
        /// A description of the test, and of how a wrong picture looks.
        about: String,
        /// The numbers of the rules of light that the case tests, each from 1 to 25.
        rules: Vec<Rule>,
        /// Points for a right picture, with at most three decimals.
        points: Points,
        /// Size of the picture and depth of the recursion.
        render: Maybe<RawRender>,
        /// Camera, lights, materials and objects.
        scene: Maybe<RawScene>,
        /// Bounds for `reference vary` to move its numbers. Left out: it cannot be varied.
        vary: Option<RawVary>,
    }
}
