//! Two pictures of 8-bit levels, one against the other, row by row: no envelope, no points, little memory.

use cases::answer::Clusters;

use super::{Difference, extent};

/// The pixels of two pictures of one width, as far as their rows have been taken, that differ by more than `slack` levels in some channel.
#[derive(Clone, Debug)]
pub struct RowsCompared {
    slack: f64,
    width: usize,
    n_rows: u32,
    difference: Difference,
    clusters: Clusters,
    out: Vec<bool>,
    /// The worst pixel on both sides, and by how many levels.
    worst: ([u8; 3], [u8; 3], u8),
}

impl RowsCompared {
    /// Of pictures of that many pixels in a row, at least 1; no row is taken yet.
    pub fn new(width: u32, slack: f64) -> Self {
        let difference = Difference { n_out: 0, cluster: 0, n_contested: 0, worst: None, bounds: None };
        let (width, clusters) = (width as usize, Clusters::default());
        Self { slack, width, n_rows: 0, difference, clusters, out: vec![false; width], worst: ([0; 3], [0; 3], 0) }
    }

    /// Takes the next rows from the top, as many of both: red, green, blue of each pixel.
    ///
    /// # Panics
    /// Where those are not whole rows.
    pub fn take(&mut self, yours: &[u8], expected: &[u8]) {
        let n = self.width * 3;
        assert!(yours.len() == expected.len() && yours.len().is_multiple_of(n), "whole rows");
        yours.chunks_exact(n).zip(expected.chunks_exact(n)).for_each(|(yours, expected)| self.row(yours, expected));
    }

    /// How the rows taken so far differ, and that in words: how many pixels, where, and what the worst of them shows on both sides.
    pub fn finish(self) -> (Difference, String) {
        let difference = Difference { cluster: self.clusters.largest(), ..self.difference };
        let text = extent(&difference, self.width as u64 * u64::from(self.n_rows));
        let Some([x, y]) = difference.worst else { return (difference, text) };
        let [yours, expected] =
            [self.worst.0, self.worst.1].map(|pixel| pixel.map(|level| level.to_string()).join(" "));
        (difference, format!("{text}, most at ({x}, {y}): yours {yours}, expected {expected}"))
    }

    fn row(&mut self, yours: &[u8], expected: &[u8]) {
        self.out.fill(false);
        if yours != expected {
            let pairs = yours.as_chunks::<3>().0.iter().zip(expected.as_chunks::<3>().0);
            for (x, (a, b)) in pairs.enumerate().filter(|(_, (a, b))| a != b) {
                let by = apart(*a, *b);
                if f64::from(by) > self.slack {
                    self.out[x] = true;
                    note(&mut self.difference, [x as u32, self.n_rows], by > self.worst.2);
                    if by > self.worst.2 {
                        self.worst = (*a, *b, by);
                    }
                }
            }
        }
        self.clusters.row(&self.out);
        self.n_rows += 1;
    }
}

/// The greatest difference of two pixels' channels.
fn apart(a: [u8; 3], b: [u8; 3]) -> u8 {
    a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1])).max(a[2].abs_diff(b[2]))
}

fn note(difference: &mut Difference, [x, y]: [u32; 2], is_worst: bool) {
    difference.n_out += 1;
    if is_worst {
        difference.worst = Some([x, y]);
    }
    let [x0, y0, x1, y1] = difference.bounds.unwrap_or([x, y, x, y]);
    difference.bounds = Some([x0.min(x), y0.min(y), x1.max(x), y1.max(y)]);
}
