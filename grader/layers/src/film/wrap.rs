//! Light above full that becomes dark, because a level above 255 loses its highest bit.

use super::super::colour::Colour;
use super::frame::Frame;

/// The share of the out pixels that must be too bright for the film.
const BRIGHT: f64 = 0.9;
/// The share of the pixels that are too bright for the film which must be out.
const OUT: f64 = 0.5;
/// The number of such pixels that are needed.
const FEW: usize = 100;
/// The level below which at least half of them must lie.
const DARK: i16 = 128;
/// The greatest level.
const FULL: i16 = 255;

/// Returns whether light above full becomes dark in all pictures, and little else is wrong.
pub(crate) fn is_wrapped(frames: &[Frame]) -> bool {
    let (mut n_out, mut n_full, mut n_wrapped, mut n_dark) = (0, 0, 0, 0);
    for frame in frames {
        n_out += frame.n_out();
        n_full += (0..frame.end).filter(|n| frame.sheet.lo[*n].contains(&FULL)).count();
        for n in wrapped(frame) {
            n_wrapped += 1;
            n_dark += usize::from(darkest(frame, n) < DARK);
        }
    }
    n_wrapped >= FEW
        && n_wrapped as f64 >= BRIGHT * n_out as f64
        && n_wrapped as f64 >= OUT * n_full as f64
        && 2 * n_dark >= n_wrapped
}

/// Returns the out pixels that are out in channels of full light only.
pub(crate) fn wrapped<'a>(frame: &'a Frame) -> impl Iterator<Item = usize> + 'a {
    frame.out().filter(|n| {
        let right: Colour = frame.sheet.expected[*n];
        let rest = [0, 1, 2].map(|at| if right[at] == FULL { FULL } else { frame.seen[*n][at] });
        right.contains(&FULL) && !frame.sheet.is_out(*n, rest)
    })
}

/// Returns the least level among the channels of full light.
fn darkest(frame: &Frame, n: usize) -> i16 {
    let channels = frame.sheet.expected[n].into_iter().zip(frame.seen[n]);
    channels.filter(|(right, _)| *right == FULL).map(|(_, seen)| seen).min().unwrap_or(FULL)
}

#[cfg(test)]
mod tests {
    use super::super::super::sheet::Sheet;
    use super::super::super::sheet::tests::sheet;
    use super::*;

    #[test]
    fn dark_pixels_in_the_brightest_light_are_found() {
        let right: Vec<u8> = (0..256).map(|n| if n % 2 == 0 { 255 } else { 90 }).collect();
        let sheet: Sheet = sheet("a", 16, &right, &[]);
        let check = |bright: i16, other: i16| {
            let seen = (0..256).map(|n| [if n % 2 == 0 { bright } else { other }; 3]).collect();
            is_wrapped(&[Frame { sheet: &sheet, seen, end: 256 }])
        };
        assert!(check(40, 90));
        assert!(!check(255, 90), "nothing is out");
        assert!(!check(40, 140), "all light is wrong");
        assert!(!check(200, 90), "full light is only a little too dark");
    }
}
