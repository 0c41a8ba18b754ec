//! Clusters: correct tracers leave single pixels that are out, mistakes leave blobs.

/// The size of the largest 8-connected cluster of pixels that are `out`, in rows of `width`; 0 where none is.
///
/// Takes time in proportion to the picture, and a stack on the heap: a picture that is out as a whole is one cluster.
pub fn largest_cluster(out: &[bool], width: u32) -> u32 {
    let width = width as usize;
    let mut left = out.to_vec();
    let mut stack = Vec::new();
    let mut largest = 0;
    for start in 0..left.len() {
        if !std::mem::take(&mut left[start]) {
            continue;
        }
        stack.push(start);
        let mut size = 0;
        while let Some(at) = stack.pop() {
            size += 1;
            stack.extend(neighbours(at, width, left.len()).filter(|n| std::mem::take(&mut left[*n])));
        }
        largest = largest.max(size);
    }
    largest
}

/// The pixels around the one with index `at`, corners included, that lie in a picture of `n` pixels.
pub fn neighbours(at: usize, width: usize, n: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (at % width, at / width);
    let (columns, rows) = (x.saturating_sub(1)..=(x + 1).min(width - 1), y.saturating_sub(1)..=y + 1);
    let around = rows.flat_map(move |row| columns.clone().map(move |column| row * width + column));
    around.filter(move |one| *one < n && *one != at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(picture: &[&str], expected: u32) {
        let out: Vec<bool> = picture.iter().flat_map(|row| row.chars().map(|mark| mark == '#')).collect();
        assert_eq!(largest_cluster(&out, picture[0].len() as u32), expected, "{picture:?}");
    }

    #[test]
    fn corners_connect_and_borders_do_not_wrap() {
        check(&["....", "...."], 0);
        check(&["#..#", "#..#"], 2);
        check(&["#.#.", ".#.#"], 4);
        check(&["###", "#.#", "###"], 8);
        check(&["..#", "#.."], 1);
        check(&["#.##", "...."], 2);
        check(&["#"], 1);
        check(&["####", "####", "####"], 12);
    }

    #[test]
    fn a_pixel_in_a_corner_has_three_neighbours() {
        assert_eq!(neighbours(0, 4, 12).collect::<Vec<_>>(), [1, 4, 5]);
        assert_eq!(neighbours(11, 4, 12).collect::<Vec<_>>(), [6, 7, 10]);
        assert_eq!(neighbours(5, 4, 12).count(), 8);
        assert_eq!(neighbours(0, 1, 1).count(), 0);
    }
}
