//! Converts linear light to integers. No other module does.
//!
//! A channel is clamped to 0..1 and mapped to one of 256 (or 65,536) levels. There is no gamma, as
//! in the courses, so that a level is the same amount of light everywhere. NaN becomes 0.

/// The rule for light between two levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantiser {
    /// The nearest level.
    #[default]
    Rounding,
    /// The level below.
    Truncating,
}

impl Quantiser {
    /// Converts linear light to one of 256 levels.
    #[inline]
    pub fn byte(self, light: f64) -> u8 {
        self.whole(clamped(light) * 255.0) as u8
    }

    /// Converts linear light to one of 65,536 levels.
    pub fn word(self, light: f64) -> u16 {
        self.whole(clamped(light) * 65535.0) as u16
    }

    /// Converts `level`, which is at least 0 and below 2³², to a whole number.
    fn whole(self, level: f64) -> u32 {
        let below = level as u32;
        match self {
            // The difference is exact, so that this equals `level.round()`. On most machines
            // `round` is a function call, which this avoids.
            Self::Rounding => below + u32::from(level - f64::from(below) >= 0.5),
            Self::Truncating => below,
        }
    }
}

/// Converts linear light to the nearest of 256 levels.
#[inline]
pub fn byte(light: f64) -> u8 {
    Quantiser::Rounding.byte(light)
}

/// Converts linear light to 8-bit levels, 0..255, without rounding. Images are compared on this
/// scale. NaN stays NaN.
#[inline]
pub fn level(light: f64) -> f64 {
    light.clamp(0.0, 1.0) * 255.0
}

/// Number of 16-bit levels in one 8-bit level. It is exact, because 65,535 = 255 · 257.
pub const WORDS_IN_BYTE: f64 = 257.0;

/// Converts light to 16-bit levels, without rounding or clamping. The result is exact for every
/// f32.
///
/// The levels of every PNG are whole on this scale. Pictures are compared on it, so that rounding
/// never decides whether they agree.
pub(super) fn words(light: f64) -> f64 {
    light * 65535.0
}

/// Converts 16-bit levels to light. This is the inverse of [`words`] for every f32, and n · 257
/// levels give the f64 nearest to n/255.
pub(super) fn of_words(levels: f64) -> f64 {
    levels / 65535.0
}

fn clamped(light: f64) -> f64 {
    if light.is_nan() { 0.0 } else { light.clamp(0.0, 1.0) }
}
