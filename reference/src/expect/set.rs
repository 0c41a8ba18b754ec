//! All cases of a set with their pictures: what the answer to one of them is made from.

use std::collections::BTreeMap;

use cases::answer::{ImageAnswer, Wrong, largest_cluster};
use cases::film::{Image, byte};
use cases::glam::DVec3;
use cases::stage::{Case, Stage};
use cases::{Effect, Effects, Scene, effects};
use rayon::prelude::*;

use super::{envelope, weight};
use crate::misconceptions::{self, Misconception};
use crate::render::{self, Options};
use crate::rules::Rules;
use crate::variations::variations;
use crate::world::{Search, World};

/// The stages of a folder, the rules they follow, and the right picture of every case.
#[derive(Clone, Debug)]
pub struct Set {
    /// In order.
    pub stages: Vec<Stage>,
    /// The course's.
    pub rules: Rules,
    /// By id of the case.
    pictures: BTreeMap<String, Image>,
}

impl Set {
    /// Renders every case once.
    pub fn new(stages: Vec<Stage>, rules: Rules) -> Self {
        let cases: Vec<&Case> = stages.iter().flat_map(|stage| &stage.cases).collect();
        let picture = |case: &&Case| (case.id.clone(), picture(&case.scene, &rules, case.scene.effects));
        let pictures = cases.par_iter().map(picture).collect();
        Self { stages, rules, pictures }
    }

    /// The right picture of a case of the set.
    ///
    /// # Panics
    /// Where the case is of another set.
    pub fn picture(&self, case: &Case) -> &Image {
        &self.pictures[&case.id]
    }

    /// The effects that the stage with index `n` brings: those that none before it allows.
    pub fn added(&self, n: usize) -> Effects {
        let before = |effect: Effect| self.stages[..n].iter().any(|stage| stage.allows.has(effect));
        self.stages[n].allows.iter().filter(|effect| !before(*effect)).collect()
    }

    /// The answer to a case of the stage with index `n`: envelope, limits, weights.
    pub fn answer(&self, n: usize, case: &Case) -> ImageAnswer {
        let mut answer = self.envelope(case, self.picture(case).clone());
        let without = self.without(n, case);
        answer.weight = weight::weights(&answer.expected, &without);
        let others = self.pictures.iter().filter(|(id, _)| **id != case.id).map(|(_, picture)| picture);
        answer.limits.unearned = weight::unearned(&answer, others.chain([&without, &background(&case.scene)]));
        answer
    }

    /// What right tracers give of a case, of this set or of another by the same rules, around its right picture; every pixel weighs alike.
    pub fn envelope(&self, case: &Case, right: Image) -> ImageAnswer {
        let variations = variations(&self.rules);
        let members = variations.par_iter().map(|variation| variation.picture(&case.scene, case.scene.effects));
        envelope::envelope(right, &members.collect::<Vec<Image>>())
    }

    /// The picture of a case of the stage with index `n` by a tracer that has nothing of what the stage brings: the background alone in
    /// the first stage.
    pub fn without(&self, n: usize, case: &Case) -> Image {
        if n == 0 {
            return background(&case.scene);
        }
        let added = self.added(n);
        let effects = added.iter().fold(case.scene.effects, |effects, effect| effects.without(effect));
        let mut scene = case.scene.clone();
        effects::simulate_only(&mut scene, effects);
        picture(&scene, &self.rules, effects)
    }

    /// What each known mistake changes that `answer` would not let pass, by id.
    pub fn mistakes(&self, case: &Case, answer: &ImageAnswer) -> Vec<Wrong> {
        let render = |wrong: &&Misconception| {
            // A student's loop asks every object, even where a wrong test leaves the bounds that a tree goes by.
            let world = World::<f64>::with_search(&case.scene, Search::Scan);
            let image = render::render_by(&world, &wrong.in_student_style(&self.rules), &Options::of(&world), |_| {}).0;
            let out = answer.out(&image);
            let count = out.iter().filter(|out| **out).count() as u32;
            let fails = !answer.allows(largest_cluster(&out, image.width()), count);
            let change = |(light, out): (&DVec3, &bool)| out.then(|| light.to_array().map(byte));
            let changes = || image.pixels().iter().zip(&out).map(change).collect();
            fails.then(|| Wrong { id: wrong.id.to_owned(), changes: changes() })
        };
        misconceptions::of(&self.rules).par_iter().filter_map(render).collect()
    }
}

/// A picture in f64, one ray a pixel.
pub fn picture(scene: &Scene, rules: &Rules, effects: Effects) -> Image {
    let world = World::<f64>::new(scene);
    let options = Options { effects, ..Options::of(&world) };
    render::render_by(&world, rules, &options, |_| {}).0
}

fn background(scene: &Scene) -> Image {
    Image::from_fn(scene.render.width, scene.render.height, |_, _| scene.background)
}
