//! Connected regions of pixels.

use cases::answer::neighbours;

/// Returns the indices of the pixels in the largest 8-connected region of `mask`, in rows of
/// `width`, ascending. Of equally large regions the first one is returned; empty if no pixel is
/// set.
pub fn largest(mask: &[bool], width: usize) -> Vec<u32> {
    let mut left = mask.to_vec();
    let mut largest = vec![];
    for start in 0..left.len() {
        if !left[start] {
            continue;
        }
        let region = flood(&mut left, width, start);
        if region.len() > largest.len() {
            largest = region;
        }
    }
    largest.sort_unstable();
    largest
}

/// Returns the pixels that are connected with `start`, and clears them.
fn flood(left: &mut [bool], width: usize, start: usize) -> Vec<u32> {
    let mut region = vec![];
    let mut reached = vec![start];
    left[start] = false;
    while let Some(at) = reached.pop() {
        region.push(at as u32);
        for next in neighbours(at, width, left.len()) {
            if std::mem::take(&mut left[next]) {
                reached.push(next);
            }
        }
    }
    region
}

/// Returns the smallest rectangle around pixels: left, top, right and bottom, all included. `None`
/// for no pixel.
pub fn bounds(pixels: &[u32], width: usize) -> Option<[u32; 4]> {
    let width = width as u32;
    let (columns, rows) = (pixels.iter().map(|n| n % width), pixels.iter().map(|n| n / width));
    Some([columns.clone().min()?, rows.clone().min()?, columns.max()?, rows.max()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_region_has_corners_and_does_not_wrap() {
        let mask = |text: &str| text.chars().map(|mark| mark == '#').collect::<Vec<_>>();
        assert_eq!(largest(&mask("#..##...#.##"), 4), [0, 4, 8]);
        assert_eq!(largest(&mask("#.#..#.#...."), 4), [0, 2, 5, 7]);
        assert_eq!(largest(&mask("#...#..."), 2), [0]);
        assert_eq!(largest(&mask("...."), 2), [0u32; 0]);
    }

    #[test]
    fn bounds_include_all_pixels() {
        assert_eq!(bounds(&[5, 6, 11], 4), Some([1, 1, 3, 2]));
        assert_eq!(bounds(&[], 4), None);
    }
}
