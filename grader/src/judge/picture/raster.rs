//! Two pictures of 8-bit levels, one against the other: no envelope, no points, little memory.

use cases::answer::Clusters;
use cases::film::Raster;

use super::{Difference, extent};

/// The pixels of two pictures of one size that differ by more than `slack` levels in some channel.
///
/// # Panics
/// Where the sizes differ.
pub fn compare_rasters(one: &Raster, other: &Raster, slack: f64) -> Difference {
    assert_eq!((one.width, one.height), (other.width, other.height), "pictures of one size");
    let mut difference = Difference { n_out: 0, cluster: 0, n_contested: 0, worst: None, bounds: None };
    let (mut clusters, mut most) = (Clusters::default(), 0);
    let mut out = vec![false; one.width as usize];
    for y in 0..one.height {
        let (a, b) = (one.row(y), other.row(y));
        out.fill(false);
        if a != b {
            for (x, by) in a.chunks_exact(3).zip(b.chunks_exact(3)).map(|(a, b)| apart(a, b)).enumerate() {
                out[x] = f64::from(by) > slack;
                if out[x] {
                    note(&mut difference, [x as u32, y], by > most);
                    most = most.max(by);
                }
            }
        }
        clusters.row(&out);
    }
    difference.cluster = clusters.largest();
    difference
}

/// How many pixels differ, where, and what the worst of them shows on both sides.
pub fn describe_rasters(one: &Raster, other: &Raster, difference: &Difference) -> String {
    let text = extent(difference, u64::from(one.width) * u64::from(one.height));
    let Some([x, y]) = difference.worst else { return text };
    let shown =
        |raster: &Raster| raster.row(y)[x as usize * 3..][..3].iter().map(u8::to_string).collect::<Vec<_>>().join(" ");
    format!("{text}, most at ({x}, {y}): yours {}, expected {}", shown(one), shown(other))
}

/// The greatest difference of two pixels' channels.
fn apart(a: &[u8], b: &[u8]) -> u8 {
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
