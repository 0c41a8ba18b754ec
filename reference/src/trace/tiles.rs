//! Tiles of a picture, rendered in parallel, and the grid of rays through each pixel.

use std::ops::Range;

use cases::film::Image;
use rayon::prelude::*;

use super::kernel::Kernel;
use super::options::Options;
use super::simulated::EffectSource;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::RuleSource;
use crate::watch::Book;
use crate::world::packet;

/// Side of a tile in pixels.
const TILE: u32 = 16;
/// Side in pixels of a block of a tile whose rays are searched for together. At one ray per pixel,
/// a packet holds exactly the rays of a block.
const BLOCK: u32 = 4;
const _: () = assert!((BLOCK * BLOCK) as usize == packet::MOST && TILE.is_multiple_of(BLOCK));

/// Returns the picture with a grid of rays through every pixel, and the book of its rays. Each tile
/// has its own copy of `fresh`, an empty book. Once the book allows no more rays, the colours are
/// of no use.
pub(super) fn render_grid<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    kernel: &Kernel<'_, T, R, E>,
    options: &Options,
    fresh: B,
    progress: impl Fn(u64) + Sync,
) -> (Image, B) {
    let (width, height) = (kernel.world.render.width, kernel.world.render.height);
    let n_columns = width.div_ceil(TILE);
    let tiles: Vec<(Vec<Vec3<T>>, B)> = (0..n_columns * height.div_ceil(TILE))
        .into_par_iter()
        .map(|n| {
            let (columns, rows) = (span(n % n_columns, width), span(n / n_columns, height));
            let tile = render_tile(kernel, options, columns, rows, fresh);
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
    (image, tiles.into_iter().fold(fresh, |all, (_, book)| all.plus(book)))
}

/// Returns the pixels of tile `n` along a side of `size` pixels.
fn span(n: u32, size: u32) -> Range<u32> {
    n * TILE..((n + 1) * TILE).min(size)
}

fn render_tile<T: Real, R: RuleSource, E: EffectSource, B: Book>(
    kernel: &Kernel<'_, T, R, E>,
    options: &Options,
    columns: Range<u32>,
    rows: Range<u32>,
    mut book: B,
) -> (Vec<Vec3<T>>, B) {
    if options.packets && kernel.gains_by_packets() {
        return (render_in_blocks(kernel, options.samples, columns, rows, &mut book), book);
    }
    let pixels = rows
        .flat_map(|j| columns.clone().map(move |i| (i, j)))
        .map(|pixel| render_grid_of_pixel(kernel, options.samples, pixel, &mut book))
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
    while points.peek().is_some() && book.allows(0) {
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

/// Returns the colour of a pixel, whose rays are searched for together where that is faster.
pub(super) fn render_pixel<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    options: &Options,
    (i, j): (u32, u32),
    book: &mut impl Book,
) -> Vec3<T> {
    if !(options.packets && kernel.gains_by_packets()) {
        return render_grid_of_pixel(kernel, options.samples, (i, j), book);
    }
    let mut pixel = Vec3::ZERO;
    let block = (i..i + 1, j..j + 1);
    render_block(kernel, options.samples, block, book, |_, colour| pixel = colour);
    pixel
}

/// Returns the mean over a regular grid of `samples` × `samples` points, which is the centre alone
/// for 1.
fn render_grid_of_pixel<T: Real, R: RuleSource, E: EffectSource>(
    kernel: &Kernel<'_, T, R, E>,
    samples: u32,
    pixel: (u32, u32),
    book: &mut impl Book,
) -> Vec3<T> {
    let mut sum = Vec3::ZERO;
    for at in grid(samples) {
        if !book.allows(0) {
            break;
        }
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
