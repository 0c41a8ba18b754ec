//! A scene without each of its effects in turn: the picture itself shows which effects it needs.

use cases::effects::Reason;
use cases::{Effect, Scene};
use serde::Serialize;

use super::measure::Measured;
use super::need::Need;
use super::sweep::About;
use super::times::Times;
use crate::watch::Counts;

/// The measurements of a scene, and of the scene without each effect that it simulates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EffectCosts {
    /// The number of pixels of the picture.
    pub n_pixels: u64,
    /// The complete rounds.
    pub rounds: usize,
    /// Milliseconds a picture with all simulated effects.
    pub time_ms: Times,
    /// The rays of that picture, by kind.
    pub rays: Counts,
    /// A row for every effect, in the order of [`Effect::ALL`].
    pub effects: Vec<EffectCost>,
}

/// An effect of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EffectCost {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it.
    pub called_for: bool,
    /// The reason why, or why not.
    pub because: String,
    /// The picture without the effect; `None` if the effect is not simulated anyway.
    pub without: Option<Without>,
}

/// A picture without one effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Without {
    /// The pixels whose 8-bit colour differs. Those whose light is not finite without the effect
    /// count too.
    pub n_changed: u64,
    /// Milliseconds a picture.
    pub time_ms: Times,
    /// The rays by kind.
    pub rays: Counts,
}

impl EffectCost {
    /// Returns how the effect is needed.
    pub fn need(&self) -> Need {
        let n_changed = self.without.map(|without| without.n_changed);
        Need::of(self.called_for, n_changed.is_some(), n_changed)
    }
}

impl EffectCosts {
    /// Returns the costs that were `measured` by [`Sweep::of_effects`] of `scene`, with the
    /// `reasons` for which the scene calls for its effects.
    ///
    /// [`Sweep::of_effects`]: super::sweep::Sweep::of_effects
    pub fn new(scene: &Scene, reasons: Vec<Reason>, measured: &[Measured]) -> Self {
        let n_pixels = u64::from(scene.render.width) * u64::from(scene.render.height);
        let without = |effect| {
            let row = measured.iter().find(|row| row.about == About::Without(effect))?;
            let n_changed = row.error.n_changed(n_pixels as usize);
            Some(Without { n_changed, time_ms: row.time_ms(), rays: row.stats.rays })
        };
        let row = |Reason { effect, called_for, because }| EffectCost {
            effect,
            called_for,
            because,
            without: without(effect),
        };
        let own = measured.iter().find(|row| row.about == About::Accuracy);
        Self {
            n_pixels,
            rounds: own.map_or(0, |row| row.times_s.len()),
            time_ms: own.map_or_else(Times::default, Measured::time_ms),
            rays: own.map_or_else(Counts::default, |row| row.stats.rays),
            effects: reasons.into_iter().map(row).collect(),
        }
    }
}
