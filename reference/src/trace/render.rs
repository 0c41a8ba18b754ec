//! Pictures, rendered as tiles in parallel. The number of threads does not change a byte.

use std::ops::Range;

use cases::{Effects, film::Image};
use rayon::prelude::*;
use serde::Serialize;

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{Lecture, RuleSource, Rules};
use crate::trace::kernel::Kernel;
use crate::trace::simulated::{AllEffects, EffectSource, EyeAlone, WithShadows};
use crate::watch::work::Amounts;
use crate::watch::{Book, Counts, Ledger, Notes};
use crate::world::World;
use crate::world::packet;

/// Side of a tile in pixels.
const TILE: u32 = 16;
/// Side in pixels of a block of a tile whose rays are searched for together. At one ray per pixel,
/// a packet holds exactly the rays of a block.
const BLOCK: u32 = 4;
const _: () = assert!((BLOCK * BLOCK) as usize == packet::MOST && TILE.is_multiple_of(BLOCK));

/// The effects to simulate, and the accuracy.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The effects to simulate.
    pub effects: Effects,
    /// N for a regular grid of N × N rays per pixel, at least 1. The colour of the pixel is their
    /// mean.
    pub samples: u32,
    /// The light below which a light source is skipped at a point; 0 skips none.
    pub light_cutoff: f64,
}

impl Options {
    /// Returns the effects of the scene with one ray per pixel and no light cutoff.
    pub fn of<T>(world: &World<T>) -> Self {
        Self { effects: world.effects, samples: 1, light_cutoff: 0.0 }
    }

    fn any(&self) -> AllEffects {
        AllEffects::of(self.effects, self.light_cutoff)
    }
}

/// The rays that a picture took, and the light that it left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// Numbers of rays by kind.
    pub rays: Counts,
    /// Greatest weight of rays that a pixel left out for depth or threshold, channel by channel.
    /// [`crate::trace::cutoff`] bounds their light. [rule 13]
    pub left_out: [f64; 3],
    /// Greatest light that a pixel skipped as too weak, channel by channel.
    pub faint_light: [f64; 3],
}

impl Stats {
    fn of(notes: &Notes) -> Self {
        Self {
            rays: notes.rays,
            left_out: notes.left_out.to_array(),
            faint_light: notes.faint_light.to_array(),
        }
    }
}

/// Renders like [`render`] by rules and effects known only at run time, with a kernel compiled for
/// them. The picture is the same, bit for bit.
///
/// Only the rules of the lecture have such kernels, and only the few sets of effects for which it
/// pays: a kernel that spawns no rays is a loop, not a recursion. Spawned rays cost so much that
/// the branches for other effects are too cheap to measure (docs/decisions/006).
pub fn render_by<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats) {
    let Options { effects, light_cutoff, .. } = *options;
    if *rules != Rules::LECTURE {
        return render(world, rules, options, progress);
    }
    let (image, notes) = if let Some(effects) = EyeAlone::new(effects, light_cutoff) {
        render_under::<T, _, _, Notes>(world, Lecture, effects, options, progress)
    } else if let Some(effects) = WithShadows::new(effects, light_cutoff) {
        render_under::<T, _, _, Notes>(world, Lecture, effects, options, progress)
    } else {
        return render(world, Lecture, options, progress);
    };
    (image, Stats::of(&notes))
}

/// Renders like [`render_by`] and also counts the work that rays cause. The picture is the same,
/// but takes a little longer.
pub fn count_by<T: Real>(
    world: &World<T>,
    rules: &Rules,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats, Amounts) {
    let (image, Ledger { notes, work }) = if *rules == Rules::LECTURE {
        render_under(world, Lecture, options.any(), options, progress)
    } else {
        render_under(world, rules, options.any(), options, progress)
    };
    (image, Stats::of(&notes), work)
}

/// Returns the picture and its figures, rendered by the kernel that can simulate all effects.
///
/// It runs in the current `rayon` pool, and calls `progress` with the number of pixels of each
/// finished tile. The tiles and the order of every sum are fixed, so that the number of threads
/// changes nothing.
///
/// ```
/// use reference::{rules::Lecture, trace::render, world::World};
///
/// let text = "render = { size = [2, 1], max_depth = 0 }
///     scene.camera = { eye = [0, 0, 2], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 20 }
///     scene.materials = { glow = { ke = [0.25, 0.5, 1] } }
///     scene.objects = [{ sphere = {}, material = \"glow\" }]";
/// let scene = cases::scene::parse("glow.toml", text, "".as_ref(), &Default::default()).unwrap();
/// let world = World::<f64>::new(&scene);
/// let (image, stats) = render::render(&world, Lecture, &render::Options::of(&world), |_| {});
/// assert_eq!(image.pixel(0, 0).to_array(), [0.25, 0.5, 1.0]); // the ball emits ke
/// assert_eq!(stats.rays.total(), 2);
/// ```
pub fn render<T: Real, R: RuleSource>(
    world: &World<T>,
    rules: R,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, Stats) {
    let (image, notes) =
        render_under::<T, R, _, Notes>(world, rules, options.any(), options, progress);
    (image, Stats::of(&notes))
}

/// Returns the picture by a kernel that simulates `effects`, and the book of its rays.
pub fn render_under<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    world: &World<T>,
    rules: R,
    effects: E,
    options: &Options,
    progress: impl Fn(u64) + Sync,
) -> (Image, B) {
    let kernel = Kernel::by(world, rules, effects);
    let (width, height) = (world.render.width, world.render.height);
    let n_columns = width.div_ceil(TILE);
    let tiles: Vec<(Vec<Vec3<T>>, B)> = (0..n_columns * height.div_ceil(TILE))
        .into_par_iter()
        .map(|n| {
            let (columns, rows) = (span(n % n_columns, width), span(n / n_columns, height));
            let tile = render_tile(&kernel, options.samples, columns, rows);
            progress(tile.0.len() as u64);
            tile
        })
        .collect();
    let image = Image::from_fn(width, height, |i, j| {
        let (column, row) = (i / TILE, j / TILE);
        let tile_width = span(column, width).len();
        tiles[(row * n_columns + column) as usize].0
            [(j % TILE) as usize * tile_width + (i % TILE) as usize]
            .f64()
    });
    (image, tiles.into_iter().fold(B::default(), |all, (_, book)| all.plus(book)))
}

/// Returns the pixels of tile `n` along a side of `size` pixels.
fn span(n: u32, size: u32) -> Range<u32> {
    n * TILE..((n + 1) * TILE).min(size)
}

fn render_tile<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    columns: Range<u32>,
    rows: Range<u32>,
) -> (Vec<Vec3<T>>, B) {
    let mut book = B::default();
    if kernel.gains_by_packets() {
        return (render_in_blocks(kernel, samples, columns, rows, &mut book), book);
    }
    let pixels = rows
        .flat_map(|j| columns.clone().map(move |i| (i, j)))
        .map(|pixel| render_pixel(kernel, samples, pixel, &mut book))
        .collect();
    (pixels, book)
}

/// Renders a tile whose neighbouring rays are searched for together. Returns its pixels row by row.
fn render_in_blocks<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    columns: Range<u32>,
    rows: Range<u32>,
    book: &mut impl Book,
) -> Vec<Vec3<T>> {
    let mut pixels = vec![Vec3::ZERO; columns.len() * rows.len()];
    for j in rows.clone().step_by(BLOCK as usize) {
        for i in columns.clone().step_by(BLOCK as usize) {
            let block = (i..(i + BLOCK).min(columns.end), j..(j + BLOCK).min(rows.end));
            render_block(kernel, samples, block, book, |(i, j), colour| {
                pixels[(j - rows.start) as usize * columns.len() + (i - columns.start) as usize] =
                    colour;
            });
        }
    }
    pixels
}

/// Calls `write_pixel` with each pixel of a block and its colour. Rays are grouped into full
/// packets, pixel after pixel.
fn render_block<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    (columns, rows): (Range<u32>, Range<u32>),
    book: &mut impl Book,
    mut write_pixel: impl FnMut((u32, u32), Vec3<T>),
) {
    let pixels = rows.flat_map(|j| columns.clone().map(move |i| (i, j)));
    let mut points =
        pixels.clone().flat_map(|pixel| grid(samples).map(move |at| (pixel, at))).peekable();
    let (mut done, mut sum, mut n_rays) = (pixels, Vec3::ZERO, 0);
    while points.peek().is_some() {
        kernel.eyes(points.by_ref().take(packet::MOST), book, |book, colour| {
            sum += colour;
            n_rays += 1;
            if n_rays == samples * samples
                && let Some(pixel) = done.next()
            {
                write_pixel(pixel, end_pixel(samples, sum, book));
                (sum, n_rays) = (Vec3::ZERO, 0);
            }
        });
    }
}

/// Returns the mean over a regular grid of `samples` × `samples` points, which is the centre alone
/// for 1.
fn render_pixel<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    pixel: (u32, u32),
    book: &mut impl Book,
) -> Vec3<T> {
    let mut sum = Vec3::ZERO;
    for at in grid(samples) {
        sum += kernel.eye(pixel, at, book);
    }
    end_pixel(samples, sum, book)
}

/// Returns the sampled positions in a pixel, row by row.
fn grid<T: Real>(samples: u32) -> impl Iterator<Item = (T, T)> {
    let at = move |n: u32| T::of((f64::from(n) + 0.5) / f64::from(samples));
    (0..samples).flat_map(move |y| (0..samples).map(move |x| (at(x), at(y))))
}

/// Returns the mean of a pixel's rays, whose light adds up to `sum`.
fn end_pixel<T: Real>(samples: u32, sum: Vec3<T>, book: &mut impl Book) -> Vec3<T> {
    book.notes().end_pixel(f64::from(samples) * f64::from(samples));
    if samples == 1 { sum } else { sum * T::of(1.0 / (f64::from(samples) * f64::from(samples))) }
}
