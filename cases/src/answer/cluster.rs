//! Finds clusters of out pixels. Correct tracers leave single pixels that are out, mistakes leave
//! blobs.

/// Returns the size of the largest 8-connected cluster of `out` pixels in rows of `width`, or 0 if
/// no pixel is out.
pub fn largest_cluster(out: &[bool], width: u32) -> u32 {
    let mut clusters = Clusters::default();
    out.chunks(width.max(1) as usize).for_each(|row| clusters.row(row));
    clusters.largest()
}

/// The clusters of out pixels in a picture that arrives row by row, as a union-find forest of runs.
/// Its memory is that of two rows.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    /// Parent of each run; a root is its own parent.
    joined: Vec<u32>,
    /// Number of pixels in the cluster of each root.
    sizes: Vec<u32>,
    /// Runs of the previous row: first column, last column, number of the run.
    before: Vec<(usize, usize, u32)>,
    /// Number of pixels in the largest cluster so far.
    largest: u32,
}

impl Clusters {
    /// Adds the next row, from top to bottom.
    pub fn row(&mut self, out: &[bool]) {
        let mut runs = Vec::new();
        let mut at = 0;
        while let Some(first) = out[at..].iter().position(|is_out| *is_out).map(|n| at + n) {
            let end =
                out[first..].iter().position(|is_out| !is_out).map_or(out.len(), |n| first + n);
            runs.push((first, end - 1, self.run((end - first) as u32)));
            at = end;
        }
        let mut above = 0;
        for (first, last, run) in &runs {
            while above < self.before.len() && self.before[above].1 + 1 < *first {
                above += 1;
            }
            let touching =
                self.before[above..].iter().take_while(|one| one.0 <= last + 1).map(|one| one.2);
            for other in touching.collect::<Vec<_>>() {
                self.join(*run, other);
            }
        }
        self.forget(&mut runs);
        self.before = runs;
    }

    /// Returns the number of pixels of the largest cluster so far.
    pub fn largest(&self) -> u32 {
        self.largest
    }

    /// Drops all clusters without a run in the last row, which cannot grow any more, and renumbers
    /// the runs.
    fn forget(&mut self, runs: &mut [(usize, usize, u32)]) {
        self.largest = self.sizes.iter().copied().fold(self.largest, u32::max);
        let mut kept = vec![None; self.joined.len()];
        let mut sizes = Vec::new();
        for (_, _, run) in runs {
            let root = self.root(*run) as usize;
            *run = *kept[root].get_or_insert_with(|| {
                sizes.push(self.sizes[root]);
                sizes.len() as u32 - 1
            });
        }
        self.joined = (0..sizes.len() as u32).collect();
        self.sizes = sizes;
    }

    fn run(&mut self, size: u32) -> u32 {
        let run = self.joined.len() as u32;
        self.joined.push(run);
        self.sizes.push(size);
        run
    }

    fn root(&mut self, mut run: u32) -> u32 {
        while self.joined[run as usize] != run {
            let next = self.joined[run as usize];
            self.joined[run as usize] = self.joined[next as usize];
            run = next;
        }
        run
    }

    fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.root(one), self.root(other));
        if one != other {
            let (low, high) = (one.min(other), one.max(other));
            self.joined[high as usize] = low;
            self.sizes[low as usize] += std::mem::take(&mut self.sizes[high as usize]);
        }
    }
}

/// Returns the indices of the pixels that touch pixel `at` by a side or a corner. The picture has
/// `n` pixels in rows of `width`.
pub fn neighbours(at: usize, width: usize, n: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (at % width, at / width);
    let (columns, rows) =
        (x.saturating_sub(1)..=(x + 1).min(width - 1), y.saturating_sub(1)..=y + 1);
    let around = rows.flat_map(move |row| columns.clone().map(move |column| row * width + column));
    around.filter(move |one| *one < n && *one != at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(picture: &[&str], expected: u32) {
        let out: Vec<bool> =
            picture.iter().flat_map(|row| row.chars().map(|mark| mark == '#')).collect();
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
        check(&["#.#.#", "#.#.#", ".#.#."], 8); // joined from below
        check(&["##.##", "...#.", "#####"], 8);
    }

    /// Counts the pixels that are connected with the one at `at`, and clears them.
    fn flood(out: &mut [bool], width: usize, at: usize) -> u32 {
        let mut reached = vec![at];
        let mut n = 0;
        while let Some(at) = reached.pop() {
            if std::mem::take(&mut out[at]) {
                n += 1;
                reached.extend(neighbours(at, width, out.len()));
            }
        }
        n
    }

    #[test]
    fn rows_give_the_clusters_that_a_flood_gives() {
        let mut state = 1_u64;
        let mut below = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % n
        };
        for _ in 0..2000 {
            let (width, height, share) =
                (1 + below(12) as usize, 1 + below(12) as usize, below(10));
            let out: Vec<bool> = (0..width * height).map(|_| below(10) < share).collect();
            let mut left = out.clone();
            let expected = (0..out.len()).map(|at| flood(&mut left, width, at)).max().unwrap_or(0);
            assert_eq!(largest_cluster(&out, width as u32), expected, "{width}: {out:?}");
        }
    }

    #[test]
    fn memory_does_not_grow_with_the_picture() {
        let mut clusters = Clusters::default();
        for row in 0..1000 {
            clusters.row(&[row % 2 == 0, false, row % 2 == 0, false]);
            assert!(clusters.joined.len() <= 4, "{} runs are kept", clusters.joined.len());
        }
        assert_eq!(clusters.largest(), 1);
    }

    #[test]
    fn a_pixel_in_a_corner_has_three_neighbours() {
        assert_eq!(neighbours(0, 4, 12).collect::<Vec<_>>(), [1, 4, 5]);
        assert_eq!(neighbours(11, 4, 12).collect::<Vec<_>>(), [6, 7, 10]);
        assert_eq!(neighbours(5, 4, 12).count(), 8);
        assert_eq!(neighbours(0, 1, 1).count(), 0);
    }
}
