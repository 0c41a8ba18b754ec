//! Forecasts of the number of rays, before a tree of rays explodes.
//!
//! A surface that reflects and transmits spawns two rays. In a scene of such surfaces each level of
//! depth may have 1.7 times as many rays as the level before, which are 40,000 per eye ray at depth
//! 20. The forecast counts the rays of at most 512 pixels, to the full depth where that is cheap.
//! Elsewhere it counts them to the greatest depth that is cheap, and lets the last levels grow on
//! as they did.

use super::kernel::Kernel;
use super::options::Options;
use super::simulated::EffectSource;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{Depth, Formula, Lecture, RuleSource, Rules};
use crate::watch::Ledger;
use crate::watch::metered::{Metered, RayBudget};
use crate::world::World;
use cases::Effect;

/// The least depth for which rays are forecast.
pub const LEAST_DEPTH: u32 = 8;
/// The least distance between the sampled pixels in both directions.
const LEAST_STEP: u32 = 16;
/// The greatest number of sampled pixels, about. With more, even a few levels would be too many
/// rays.
const MOST_PIXELS: f64 = 512.0;
/// The greatest number of rays that a forecast traces, give or take a batch.
const MOST_RAYS: u64 = 200_000;
/// The number of levels over which growth is measured.
const GROWTH_LEVELS: usize = 3;

/// The expected number of rays of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Rays of all kinds, in the whole picture.
    pub rays: f64,
    /// Rays of all kinds for each eye ray, the eye ray included.
    pub per_eye_ray: f64,
}

/// Returns the expected number of rays of a picture. The result is deterministic.
///
/// The result is `None` where a tree of rays cannot explode: where no object both reflects and
/// transmits, or where the depth is less than [`LEAST_DEPTH`].
pub fn forecast<T: Real>(world: &World<T>, rules: &Rules, options: &Options) -> Option<Forecast> {
    if !branches(world, options) || world.render.max_depth < LEAST_DEPTH {
        return None;
    }
    Some(if rules.lecture_by() == Some(Formula::Robust) {
        sampled(&Kernel::by(world, Lecture, options.any()), options)
    } else {
        sampled(&Kernel::by(world, rules, options.any()), options)
    })
}

/// Returns whether some object spawns both a reflected and a refracted ray.
fn branches<T: Real>(world: &World<T>, options: &Options) -> bool {
    let material = |object: usize| &world.materials[world.objects[object].material];
    let both = |object| material(object).kr != Vec3::ZERO && material(object).kt != Vec3::ZERO;
    [Effect::Reflection, Effect::Refraction].iter().all(|effect| options.effects.has(*effect))
        && (0..world.objects.len()).any(both)
}

fn sampled<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    options: &Options,
) -> Forecast {
    let (render, budget) = (kernel.world.render, MOST_RAYS / 2);
    let step = step(render.width, render.height);
    let columns = places(render.width, step);
    let pixels = places(render.height, step).flat_map(|j| columns.clone().map(move |i| (i, j)));
    let n_sampled = pixels.clone().count() as f64;
    let count = |deepest, most| count(kernel, pixels.clone(), deepest, most);
    let is_deeper = kernel.rules.get().depth == Depth::OneMore;
    let deepest = render.max_depth.saturating_add(u32::from(is_deeper));
    let n_rays = match count(deepest, budget) {
        Some(n_rays) => n_rays as f64,
        None => {
            let (mut totals, mut left) = (Vec::new(), budget);
            while let Some(n_rays) = count(totals.len() as u32, left) {
                totals.push(n_rays);
                left = left.saturating_sub(n_rays);
            }
            grown(&totals, deepest).max(budget as f64)
        }
    };
    let per_eye_ray = n_rays / n_sampled;
    let n_eye_rays = f64::from(render.width) * f64::from(render.height);
    let per_pixel = f64::from(options.samples) * f64::from(options.samples); // at most
    Forecast { rays: per_eye_ray * n_eye_rays * per_pixel, per_eye_ray }
}

/// Returns the distance between the sampled pixels of a picture of this size.
fn step(width: u32, height: u32) -> u32 {
    let share = f64::from(width) * f64::from(height) / MOST_PIXELS;
    LEAST_STEP.max(share.sqrt().ceil() as u32)
}

/// Returns the sampled columns or rows of `size`: the middles of all parts of `step`, at least one.
fn places(size: u32, step: u32) -> impl Iterator<Item = u32> + Clone {
    let first = if size < step { size / 2 } else { step / 2 };
    (0..(size / step).max(1)).map(move |n| n * step + first)
}

/// Returns the number of rays behind `pixels` to the depth `deepest`, or `None` if there are more
/// than `most`.
fn count<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    pixels: impl Iterator<Item = (u32, u32)>,
    deepest: u32,
    most: u64,
) -> Option<u64> {
    let budget = RayBudget::new(most);
    let mut book = Metered::new(Ledger::default(), Some(&budget)).to_depth(deepest);
    for pixel in pixels {
        kernel.eye(pixel, (T::HALF, T::HALF), &mut book);
        if budget.is_exceeded() {
            return None;
        }
    }
    let n_rays = book.settled().notes.rays.total();
    (!budget.is_exceeded()).then_some(n_rays)
}

/// Returns the number of rays to the depth `deepest`, where `totals` are those to depth 0, 1, 2 and
/// so on. Each level that is missing has as many times more rays than the level before as the last
/// levels had in the mean.
fn grown(totals: &[u64], deepest: u32) -> f64 {
    let levels: Vec<f64> = totals.windows(2).map(|pair| (pair[1] - pair[0]) as f64).collect();
    let (Some(total), Some(last)) = (totals.last(), levels.last()) else { return 0.0 };
    let n_steps = GROWTH_LEVELS.min(levels.len() - 1);
    let growth = match levels.get(levels.len() - 1 - n_steps) {
        Some(first) if n_steps > 0 && *first > 0.0 => {
            cases::maths::pow(last / first, 1.0 / n_steps as f64)
        }
        _ => 1.0,
    };
    let n_missing = (f64::from(deepest) + 1.0 - totals.len() as f64).max(0.0);
    let steps = if growth == 1.0 {
        n_missing
    } else {
        growth * (cases::maths::pow(growth, n_missing) - 1.0) / (growth - 1.0)
    };
    *total as f64 + last * steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_that_double_go_on_doubling() {
        // 1, 2, 4, 8, 16 rays a level; to depth 7 they add up to 2^8 - 1.
        assert_eq!(grown(&[1, 3, 7, 15, 31], 7), 255.0);
        // A level has 3 rays at any depth.
        assert_eq!(grown(&[3, 6, 9, 12], 9), 30.0);
        // Where rays die out, nothing is added.
        assert_eq!(grown(&[5, 9, 9], 50), 9.0);
        assert_eq!(grown(&[1, 3, 7], u32::MAX), f64::INFINITY);
        assert_eq!(grown(&[1, 2, 3], u32::MAX), 4_294_967_296.0);
    }

    #[test]
    fn less_than_one_pixel_in_a_hundred_is_sampled_of_a_picture_that_has_so_many() {
        for size in [1, 7, 16, 17, 160, 641, 8192] {
            let step = step(size, size);
            let places: Vec<u32> = places(size, step).collect();
            assert!(!places.is_empty() && places.iter().all(|place| *place < size), "{places:?}");
            assert!(places.windows(2).all(|pair| pair[1] == pair[0] + step), "{places:?}");
            assert!(places.len() * places.len() <= 512, "{size}: {} places", places.len());
            let share = (places.len() * places.len()) as f64 / f64::from(size * size);
            assert!(size < 16 || share < 0.01, "{size}: {share}");
        }
    }
}
