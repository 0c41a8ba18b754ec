//! A set of stages with their course, from which the answers to the cases are made.

use cases::answer::{ImageAnswer, Wrong, largest_cluster};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::stage::{Base, Case, Stage};
use cases::{Course, Effects, Scene, effects};
use rayon::prelude::*;

use super::{envelope, weight};
use crate::expect::variations::variations;
use crate::rules::Rules;
use crate::rules::misconceptions::{self, Misconception};
use crate::trace::render::{self, Options};
use crate::world::{Search, World};

/// The stages of a folder with their course.
#[derive(Clone, Debug)]
pub struct Set {
    /// The course for which the stages were loaded.
    pub course: Course,
    /// The rules of the course.
    pub rules: Rules,
    /// The stages, in order.
    pub stages: Vec<Stage>,
}

impl Set {
    /// Returns the set of `stages`, which were loaded for `course`.
    pub fn new(stages: Vec<Stage>, course: &Course) -> Self {
        Self { course: *course, rules: Rules::of(course), stages }
    }

    /// Renders the correct picture of a case in f64, one ray per pixel.
    pub fn picture(&self, case: &Case) -> Image {
        picture(&case.scene, &self.rules, case.scene.effects)
    }

    /// Returns the answer to a case of the stage with index `n`, whose correct picture is `right`:
    /// envelope, limits, weights. The answer depends on the case and the base of its stage, and not
    /// on other cases.
    pub fn answer(&self, n: usize, case: &Case, right: Image) -> ImageAnswer {
        let mut answer = self.envelope(case, right);
        let without = self.without(n, case);
        answer.weight = weight::weights(&answer.expected, &without);
        answer.limits.unearned = weight::unearned(&answer, [&without, &background(&case.scene)]);
        answer
    }

    /// Returns the envelope of correct tracers for a case, by the rules of this set, around its
    /// correct picture. All pixels have the same weight.
    pub fn envelope(&self, case: &Case, right: Image) -> ImageAnswer {
        let variations = variations(&self.rules);
        let members = variations
            .par_iter()
            .map(|variation| variation.picture(&case.scene, case.scene.effects));
        envelope::envelope(right, &members.collect::<Vec<Image>>())
    }

    /// Returns the picture of a case of the stage with index `n` by a tracer that lacks all effects
    /// of the stage. In the first stage, the picture is the background alone.
    pub fn without(&self, n: usize, case: &Case) -> Image {
        let Base::Without(added) = self.stages[n].base else { return background(&case.scene) };
        let effects = case.scene.effects.difference(added);
        let mut scene = case.scene.clone();
        effects::simulate_only(&mut scene, effects);
        picture(&scene, &self.rules, effects)
    }

    /// Returns the pictures of the known mistakes that fail `answer`.
    pub fn mistakes(&self, case: &Case, answer: &ImageAnswer) -> Vec<Wrong> {
        let render = |wrong: &&Misconception| {
            let image = students_picture(&case.scene, &wrong.in_student_style(&self.rules));
            let out = answer.out(&image);
            let count = out.iter().filter(|out| **out).count() as u32;
            let fails = !answer.allows(largest_cluster(&out, image.width()), count);
            let change = |(light, out): (&DVec3, &bool)| out.then(|| light.to_array().map(byte));
            fails.then(|| Wrong::new(wrong.id, image.pixels().iter().zip(&out).map(change)))
        };
        misconceptions::of(&self.rules).par_iter().filter_map(render).collect()
    }
}

/// Renders a picture in f64, one ray per pixel.
pub fn picture(scene: &Scene, rules: &Rules, effects: Effects) -> Image {
    let world = World::<f64>::new(scene);
    let options = Options { effects, ..Options::of(&world) };
    render::render_by(&world, rules, &options, |_| {}).0
}

/// Renders a picture in f64 as a student's program does: its loop tests every object, even where a
/// wrong intersection lies outside the bounds of a tree.
pub fn students_picture(scene: &Scene, rules: &Rules) -> Image {
    let world = World::<f64>::with_search(scene, Search::Scan);
    render::render_by(&world, rules, &Options::of(&world), |_| {}).0
}

fn background(scene: &Scene) -> Image {
    Image::from_fn(scene.render.width, scene.render.height, |_, _| scene.background)
}
