//! Which effects a kernel simulates, and which it could.

use cases::{Effect, Effects};

/// Where the kernel finds out what to simulate: no ray of a kind that is off is ever cast.
pub trait EffectSource: Copy + Send + Sync {
    /// Whether that effect is simulated.
    fn has(self, effect: Effect) -> bool;

    /// Light of a lamp that comes to less than this at a point is not followed there; 0 for none.
    fn light_cutoff(self) -> f64;
}

/// Effects to be simulated, all of them among `MOST`, the [bits](Effects::bits) of those that the
/// kernel can do. What is not among `MOST` is not in the program: it costs nothing.
#[derive(Clone, Copy, Debug)]
pub struct Within<const MOST: u16> {
    effects: Effects,
    light_cutoff: f64,
}

/// A kernel that can do everything.
pub type Any = Within<{ Effects::ALL.bits() }>;

/// What changes no ray's way and casts none.
const LOCAL: Effects = Effects::NONE
    .with(Effect::SmoothNormals)
    .with(Effect::Transforms)
    .with(Effect::Attenuation)
    .with(Effect::AdaptiveDepth);

/// A kernel that casts eye rays alone.
pub type EyeAlone = Within<{ LOCAL.bits() }>;

/// A kernel that casts eye rays and rays to lights, which something hides or does not.
pub type WithShadows = Within<{ LOCAL.with(Effect::Shadows).bits() }>;

impl<const MOST: u16> Within<MOST> {
    /// Those effects, light followed down to `light_cutoff`; none where a kernel of this kind
    /// cannot do that.
    pub fn new(effects: Effects, light_cutoff: f64) -> Option<Self> {
        let can_cut = MOST == Effects::ALL.bits();
        let is_within = effects.intersection(Effects::from_bits(MOST)) == effects;
        (is_within && (can_cut || light_cutoff == 0.0)).then_some(Self { effects, light_cutoff })
    }
}

impl Any {
    /// Those effects, light followed down to `light_cutoff`.
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
