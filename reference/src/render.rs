//! Pictures: tiles over threads, the same bytes with any number of them.

use std::ops::Range;

use cases::{Effects, film::Image};
use rayon::prelude::*;
use serde::Serialize;

use crate::packet;
use crate::real::Real;
use crate::rules::{Lecture, RuleSource, Rules};
use crate::simulated::{Any, EffectSource, EyeAlone, WithShadows};
use crate::trace::Kernel;
use crate::vec3::Vec3;
use crate::watch::{Book, Counts, Ledger, Notes};
use crate::work::Amounts;
use crate::world::World;

/// Side of a tile in pixels.
const TILE: u32 = 16;
/// Side of the part of a tile in pixels whose rays are searched for together, at one ray a pixel as
/// many as a packet holds.
const BLOCK: u32 = 4;
const _: () = assert!((BLOCK * BLOCK) as usize == packet::MOST && TILE.is_multiple_of(BLOCK));

/// What to simulate, and how finely.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The effects to simulate.
    pub effects: Effects,
    /// N for a regular grid of N × N rays a pixel, at least 1; their mean is the pixel.
    pub samples: u32,
    /// Light of a lamp that comes to less than this at a point is not followed there; 0 for none.
    pub light_cutoff: f64,
}

impl Options {
    /// The effects the scene asks for, one ray a pixel.
    pub fn of<T>(world: &World<T>) -> Self {
        Self { effects: world.effects, samples: 1, light_cutoff: 0.0 }
    }

    fn any(&self) -> Any {
        Any::of(self.effects, self.light_cutoff)
    }
}

/// What a picture cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// Rays by kind.
    pub rays: Counts,
    /// Greatest weight of the rays that some pixel left out for depth or threshold, channel by
    /// channel; [`crate::cutoff`] says what that bounds. [rule 13]
    pub left_out: [f64; 3],
    /// Greatest light of lamps that some pixel did not follow for its weakness, channel by channel.
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

/// [`render`] by rules and effects known only now, by the kernel that is made for them: the same
/// picture, bit for bit.
///
/// Kernels are made for the rules of the lecture alone, and among those for the few sets of effects
/// where it pays: a kernel that spawns no rays is a loop, not a recursion. Where rays are spawned,
/// they cost so much that the branches which others would need are not to be measured
/// (docs/decisions/006).
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

/// [`render_by`], counting also the work that rays make: the same picture, a little slower.
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

/// The picture, and what it cost, by the kernel that can do everything. Runs in the current `rayon`
/// pool; `progress` is told the pixels of each tile that is done.
///
/// Tiles and the order of every sum are fixed, so that the number of threads changes nothing.
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

/// The picture by a kernel that simulates what `effects` says, under a watch of that kind.
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

/// The pixels of tile `n` along a side of `size` pixels.
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
    if kernel.gains_together() {
        return (render_in_blocks(kernel, samples, columns, rows, &mut book), book);
    }
    let pixels = rows
        .flat_map(|j| columns.clone().map(move |i| (i, j)))
        .map(|pixel| render_pixel(kernel, samples, pixel, &mut book))
        .collect();
    (pixels, book)
}

/// The pixels of a tile, row by row, where the rays of neighbours are searched for together.
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

/// The pixels of a block, told to `tell`: the rays of one pixel after those of another, as many
/// together as a packet holds.
fn render_block<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    (columns, rows): (Range<u32>, Range<u32>),
    book: &mut impl Book,
    mut tell: impl FnMut((u32, u32), Vec3<T>),
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
                tell(pixel, end_pixel(samples, sum, book));
                (sum, n_rays) = (Vec3::ZERO, 0);
            }
        });
    }
}

/// The mean over a regular grid of `samples` × `samples` points; the centre alone for 1.
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

/// The points of a pixel that are asked, row by row.
fn grid<T: Real>(samples: u32) -> impl Iterator<Item = (T, T)> {
    let at = move |n: u32| T::of((f64::from(n) + 0.5) / f64::from(samples));
    (0..samples).flat_map(move |y| (0..samples).map(move |x| (at(x), at(y))))
}

/// The mean of a pixel's rays, whose light comes to `sum`.
fn end_pixel<T: Real>(samples: u32, sum: Vec3<T>, book: &mut impl Book) -> Vec3<T> {
    book.notes().end_pixel(f64::from(samples) * f64::from(samples));
    if samples == 1 { sum } else { sum * T::of(1.0 / (f64::from(samples) * f64::from(samples))) }
}
