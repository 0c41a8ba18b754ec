//! Clusters: correct tracers leave single pixels that are out, mistakes leave blobs.

/// The size of the largest 8-connected cluster of pixels that are `out`, in rows of `width`; 0 where none is.
pub fn largest_cluster(out: &[bool], width: u32) -> u32 {
    let mut clusters = Clusters::default();
    out.chunks(width.max(1) as usize).for_each(|row| clusters.row(row));
    clusters.largest()
}

/// The clusters of a picture that comes row by row: memory goes with the runs of pixels that are out, not with the picture.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    /// Of each run, the run it was joined to; a root is joined to itself.
    joined: Vec<u32>,
    /// Of each root, the pixels of its cluster.
    sizes: Vec<u32>,
    /// The runs of the row before: first and last column, number.
    before: Vec<(usize, usize, u32)>,
}

impl Clusters {
    /// Takes the next row from the top.
    pub fn row(&mut self, out: &[bool]) {
        let mut runs = Vec::new();
        let mut at = 0;
        while let Some(first) = out[at..].iter().position(|is_out| *is_out).map(|n| at + n) {
            let end = out[first..].iter().position(|is_out| !is_out).map_or(out.len(), |n| first + n);
            runs.push((first, end - 1, self.run((end - first) as u32)));
            at = end;
        }
        let mut above = 0;
        for (first, last, run) in &runs {
            while above < self.before.len() && self.before[above].1 + 1 < *first {
                above += 1;
            }
            let touching = self.before[above..].iter().take_while(|one| one.0 <= last + 1).map(|one| one.2);
            for other in touching.collect::<Vec<_>>() {
                self.join(*run, other);
            }
        }
        self.before = runs;
    }

    /// The pixels of the largest cluster so far.
    pub fn largest(&self) -> u32 {
        self.sizes.iter().copied().max().unwrap_or(0)
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
        check(&["#.#.#", "#.#.#", ".#.#."], 8); // joined from below
        check(&["##.##", "...#.", "#####"], 8);
    }

    #[test]
    fn a_pixel_in_a_corner_has_three_neighbours() {
        assert_eq!(neighbours(0, 4, 12).collect::<Vec<_>>(), [1, 4, 5]);
        assert_eq!(neighbours(11, 4, 12).collect::<Vec<_>>(), [6, 7, 10]);
        assert_eq!(neighbours(5, 4, 12).count(), 8);
        assert_eq!(neighbours(0, 1, 1).count(), 0);
    }
}
