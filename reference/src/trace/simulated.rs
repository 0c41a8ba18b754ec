//! The effects that a kernel simulates, and those that it could simulate.

use cases::{Effect, Effects};

/// The source of the simulated effects. The kernel casts no ray of a kind that is switched off.
pub trait EffectSource: Copy + Send + Sync {
    /// Returns whether `effect` is simulated.
    fn has(self, effect: Effect) -> bool;

    /// Returns the light below which a light source is skipped at a point; 0 skips none.
    fn light_cutoff(self) -> f64;
}

/// Effects to simulate, all of them in `MOST`, the [bits](Effects::bits) of the effects that the
/// kernel can simulate. The code of other effects is not compiled into the kernel and costs
/// nothing.
#[derive(Clone, Copy, Debug)]
pub struct Within<const MOST: u16> {
    effects: Effects,
    light_cutoff: f64,
}

/// The effects of a kernel that can simulate all effects.
pub type AllEffects = Within<{ Effects::ALL.bits() }>;

/// The effects that cast no ray and change the path of none.
const LOCAL: Effects = Effects::NONE
    .with(Effect::SmoothNormals)
    .with(Effect::Transforms)
    .with(Effect::Attenuation)
    .with(Effect::AdaptiveDepth);

/// The effects of a kernel that casts only eye rays.
pub type EyeAlone = Within<{ LOCAL.bits() }>;

/// The effects of a kernel that casts eye rays and untinted shadow rays.
pub type WithShadows = Within<{ LOCAL.with(Effect::Shadows).bits() }>;

impl<const MOST: u16> Within<MOST> {
    /// Returns a source of `effects` in which light below `light_cutoff` is skipped. The result is
    /// `None` if a kernel of this type cannot simulate that.
    pub fn new(effects: Effects, light_cutoff: f64) -> Option<Self> {
        let can_cut = MOST == Effects::ALL.bits();
        let is_within = effects.intersection(Effects::from_bits(MOST)) == effects;
        (is_within && (can_cut || light_cutoff == 0.0)).then_some(Self { effects, light_cutoff })
    }
}

impl AllEffects {
    /// Returns a source of `effects` in which light below `light_cutoff` is skipped.
    pub fn of(effects: Effects, light_cutoff: f64) -> Self {
        Self { effects, light_cutoff }
    }
}

impl<const MOST: u16> EffectSource for Within<MOST> {
    #[inline(always)]
    fn has(self, effect: Effect) -> bool {
        const { Effects::from_bits(MOST) }.has(effect) && self.effects.has(effect)
    }

    #[inline(always)]
    fn light_cutoff(self) -> f64 {
        if const { MOST == Effects::ALL.bits() } { self.light_cutoff } else { 0.0 }
    }
}
