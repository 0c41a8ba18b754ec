//! What each effect does in the picture of a scene, in counts: its rays or work, and the pixels
//! that change without it.

use cases::effects::{self, Reason};
use cases::{Effect, Effects, Scene};
use serde::Serialize;

use super::error::Error;
use super::need::Need;
use crate::rules::Rules;
use crate::trace::render::{Options, Stats, count_within};
use crate::watch::work::Amounts;
use crate::watch::{Counts, made_by};
use crate::world::World;

/// The effects of a scene, and what they do in its picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct View {
    /// The number of pixels.
    pub n_pixels: u64,
    /// The rays of the picture, by kind; `None` if there are too many to trace.
    pub rays: Option<Counts>,
    /// A row for every effect, in the order of [`Effect::ALL`].
    pub effects: Vec<EffectInView>,
}

/// An effect of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EffectInView {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it.
    pub called_for: bool,
    /// Whether it is simulated.
    pub simulated: bool,
    /// The reason why the scene calls for it, or why not.
    pub because: String,
    /// What it does in the picture; `None` if it is not simulated, or if there are too many rays.
    pub done: Option<Done>,
}

/// What an effect does in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Done {
    /// The number of rays or units of work that the effect causes.
    pub made: u64,
    /// The name of these rays or units of work.
    pub of: &'static str,
    /// The pixels whose 8-bit colour differs without the effect.
    pub n_changed: u64,
}

impl EffectInView {
    /// Returns how the effect is needed.
    pub fn need(&self) -> Need {
        Need::of(self.called_for, self.simulated, self.done.map(|done| done.n_changed))
    }
}

impl View {
    /// Examines the picture of `scene` by `rules`, with the `reasons` for which the scene calls for
    /// its effects. Renders it with its effects, and without each of them. The result is the same
    /// on every machine. Runs in the current `rayon` pool.
    ///
    /// What takes more than `most_rays` rays is not examined.
    pub fn of(scene: &Scene, rules: &Rules, reasons: Vec<Reason>, most_rays: u64) -> Self {
        let own = picture(scene, rules, most_rays);
        let done = |effect| {
            let (truth, stats, work) = own.as_ref().filter(|_| scene.effects.has(effect))?;
            let (image, ..) = picture(&without(scene, effect), rules, most_rays)?;
            let error = Error::of(truth, &image, rules.quantiser);
            let (made, of) = made_by(effect, &stats.rays, work);
            Some(Done { made, of, n_changed: error.n_changed(truth.pixels().len()) })
        };
        let row = |Reason { effect, called_for, because }| EffectInView {
            effect,
            called_for,
            simulated: scene.effects.has(effect),
            because,
            done: done(effect),
        };
        Self {
            n_pixels: u64::from(scene.render.width) * u64::from(scene.render.height),
            rays: own.as_ref().map(|(_, stats, _)| stats.rays),
            effects: reasons.into_iter().map(row).collect(),
        }
    }
}

type Picture = (cases::film::Image, Stats, Amounts);

fn picture(scene: &Scene, rules: &Rules, most_rays: u64) -> Option<Picture> {
    let world = World::<f64>::new(scene);
    count_within(&world, rules, &Options::of(&world), most_rays, |_| {})
}

/// Returns the scene with one effect less.
fn without(scene: &Scene, effect: Effect) -> Scene {
    let mut less = scene.clone();
    // This leaves transforms and attenuation out of the scene itself.
    effects::simulate_only(&mut less, Effects::ALL.without(effect));
    less.effects = scene.effects.without(effect);
    less
}
