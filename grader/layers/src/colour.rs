//! Colours in whole levels, with signs, so that they can be subtracted.

use cases::answer::Levels;
use cases::film::{Image, byte};
use cases::glam::DVec3;

/// Red, green and blue in levels, 0 to 255; `NONE` for a pixel that is no colour.
pub type Colour = [i16; 3];

/// A pixel that is not finite. No colour is near it.
pub(crate) const NONE: Colour = [-1000; 3];

/// Returns light in levels, or `NONE` if a channel is not finite.
pub(crate) fn of_light(light: DVec3) -> Colour {
    if light.is_finite() { signed(light.to_array().map(byte)) } else { NONE }
}

/// Returns the colours of a picture, row by row from the top.
pub fn colours(image: &Image) -> Vec<Colour> {
    image.pixels().iter().map(|light| of_light(*light)).collect()
}

/// Returns levels as a colour.
pub(crate) fn signed(levels: Levels) -> Colour {
    levels.map(i16::from)
}

/// Returns the greatest difference over the channels, in levels.
pub fn apart(one: Colour, other: Colour) -> i16 {
    let channel = |at: usize| (one[at] - other[at]).abs();
    channel(0).max(channel(1)).max(channel(2))
}

/// Returns the sum of two colours, channel by channel.
pub(crate) fn sum(one: Colour, other: Colour) -> Colour {
    [0, 1, 2].map(|at| one[at] + other[at])
}

/// Returns the difference of two colours, channel by channel.
pub(crate) fn difference(one: Colour, other: Colour) -> Colour {
    [0, 1, 2].map(|at| one[at] - other[at])
}

/// Returns the colour cut at 0 and 255.
pub(crate) fn clamped(colour: Colour) -> Colour {
    colour.map(|level| level.clamp(0, 255))
}

/// Returns a channel times a factor, cut at 0 and 255.
pub(crate) fn scaled(channel: i16, factor: f32) -> i16 {
    (f32::from(channel) * factor).clamp(0.0, 255.0) as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_the_greatest_over_the_channels() {
        assert_eq!(apart([0, 10, 255], [3, 2, 255]), 8);
        assert_eq!(of_light(DVec3::new(0.0, 1.0, 7.0)), [0, 255, 255]);
        assert_eq!(of_light(DVec3::new(0.0, f64::NAN, 0.0)), NONE);
        assert!(apart(NONE, [0; 3]) > 255);
    }

    #[test]
    fn colours_are_cut_only_where_that_is_said() {
        assert_eq!(sum([250, 0, 7], [10, -5, 0]), [260, -5, 7]);
        assert_eq!(difference([1, 2, 3], [2, 2, 2]), [-1, 0, 1]);
        assert_eq!(clamped([260, -5, 7]), [255, 0, 7]);
        let all = [(100, 0.5), (100, 3.0), (0, 9.0)].map(|(one, factor)| scaled(one, factor));
        assert_eq!(all, [50, 255, 0]);
    }
}
