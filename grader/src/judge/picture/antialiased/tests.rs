//! An analytic scene, sampled by one ray per pixel, by many, and with errors.

use std::sync::LazyLock;

use cases::glam::DVec3;

use super::*;
use crate::judge::picture;
use crate::record::FindingKind;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 72;

/// Returns the light at a point of the plane, in pixels. The scene has two discs, one shaded and
/// one small, a tilted edge and a slope.
fn scene(x: f64, y: f64) -> DVec3 {
    let disc =
        |cx: f64, cy: f64, r: f64| 1.0 - ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (r * r);
    let lit = disc(30.3, 28.1, 19.7);
    if lit > 0.0 {
        return DVec3::new(0.9, 0.5, 0.2) * lit.sqrt() + DVec3::splat(0.05);
    }
    if disc(72.6, 20.2, 4.4) > 0.0 {
        return DVec3::new(0.1, 0.8, 0.9);
    }
    if y > 52.0 + 0.13 * x {
        return DVec3::new(0.2, 0.25 + 0.004 * x, 0.3);
    }
    DVec3::new(0.1, 0.1, 0.15 + 0.002 * y)
}

/// A sample: its offset from the centre of the pixel, and its weight.
type Sample = (f64, f64, f64);

/// Renders `light` as the weighted mean over the samples of each pixel.
fn seen(light: impl Fn(f64, f64) -> DVec3, samples: impl Fn(u32, u32) -> Vec<Sample>) -> Image {
    Image::from_fn(WIDTH, HEIGHT, |i, j| {
        let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
        let all = samples(i, j);
        let sum: DVec3 = all.iter().map(|(dx, dy, weight)| light(x + dx, y + dy) * *weight).sum();
        sum / all.iter().map(|(.., weight)| weight).sum::<f64>()
    })
}

/// Returns a grid of n × n samples over a square of `width` pixels. `weight` takes the offsets in
/// pixels.
fn grid(n: u32, width: f64, weight: fn(f64, f64) -> f64) -> Vec<Sample> {
    let at = |k: u32| ((f64::from(k) + 0.5) / f64::from(n) - 0.5) * width;
    (0..n).flat_map(|j| (0..n).map(move |i| (at(i), at(j), weight(at(i), at(j))))).collect()
}

fn even(_: f64, _: f64) -> f64 {
    1.0
}

/// Returns a number from 0 to 1 that looks random and depends only on the arguments.
fn random(i: u32, j: u32, k: u32) -> f64 {
    let mut state = (u64::from(i) << 40 | u64::from(j) << 20 | u64::from(k))
        .wrapping_add(0x9e37_79b9_7f4a_7c15);
    for _ in 0..3 {
        state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state ^= state >> 27;
    }
    (state >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns `n` random samples in each pixel.
fn jitter(n: u32) -> impl Fn(u32, u32) -> Vec<Sample> {
    move |i, j| {
        (0..n).map(|k| (random(i, j, 2 * k) - 0.5, random(i, j, 2 * k + 1) - 0.5, 1.0)).collect()
    }
}

fn shifted(by: f64) -> Vec<Sample> {
    vec![(by, by, 1.0)]
}

/// The answer to the scene with one ray per pixel. A cluster of 3 pixels may be out, and 7 pixels
/// in all.
static ANSWER: LazyLock<ImageAnswer> = LazyLock::new(|| {
    let mut answer = ImageAnswer::exact(seen(scene, |_, _| shifted(0.0)), 1.0, 7);
    (answer.limits.cluster, answer.limits.unearned) = (3, 0.5);
    answer
});

/// Filters a finished picture by the mean over 3 × 3 pixels.
fn blurred(picture: &Image) -> Image {
    let clamp = |at: u32, by: u32, size: u32| (at + by).saturating_sub(1).min(size - 1);
    Image::from_fn(WIDTH, HEIGHT, |i, j| {
        let nine = (0..9).map(|k| picture.pixel(clamp(i, k % 3, WIDTH), clamp(j, k / 3, HEIGHT)));
        nine.sum::<DVec3>() / 9.0
    })
}

fn check(name: &str, actual: &Image, is_smoothed: bool) {
    let judgement = picture(actual, &ANSWER);
    let finding = judgement.finding.expect("neither is right");
    assert_eq!(
        finding.kind == FindingKind::Antialiased,
        is_smoothed,
        "{name}: {}",
        finding.message
    );
    assert!(!is_smoothed || judgement.share == 900, "{name} earns {}", judgement.share);
}

#[test]
fn a_mean_over_the_pixel_is_anti_aliased() {
    for n in 2..=5 {
        check(&format!("{n} × {n} rays"), &seen(scene, |_, _| grid(n, 1.0, even)), true);
    }
    for n in [2, 3, 4, 9, 16] {
        check(&format!("{n} random rays"), &seen(scene, jitter(n)), true);
    }
    let corner = [(-0.5, -0.5, 1.0), (0.0, -0.5, 1.0), (-0.5, 0.0, 1.0), (0.0, 0.0, 1.0)];
    check("2 × 2 rays from the corner", &seen(scene, |_, _| corner.to_vec()), true);
    let tent = |x: f64, y: f64| (1.0 - x.abs()) * (1.0 - y.abs());
    check("tent", &seen(scene, |_, _| grid(6, 2.0, tent)), true);
    let bell = |x: f64, y: f64| (4.5 - x * x - y * y).max(0.0);
    check("bell of three pixels", &seen(scene, |_, _| grid(9, 3.0, bell)), true);
    check("a filter", &blurred(&ANSWER.expected), true);
    check("a filter over anti-aliasing", &blurred(&seen(scene, |_, _| grid(2, 1.0, even))), true);
}

#[test]
fn what_is_wrong_is_not_anti_aliased() {
    for by in [-0.5, 0.5, 0.25, 0.1, 1.0] {
        check(&format!("shifted by {by}"), &seen(scene, |_, _| shifted(by)), false);
    }
    for by in [1.01, 1.002] {
        let zoomed = |x: f64, y: f64| scene(48.0 + (x - 48.0) * by, 36.0 + (y - 36.0) * by);
        check(&format!("zoomed by {by}"), &seen(zoomed, |_, _| shifted(0.0)), false);
    }
    check("1 random ray", &seen(scene, jitter(1)), false);
    let without = |x: f64, y: f64| {
        if (x - 72.0).abs() < 6.0 && y < 30.0 { scene(60.0, 10.0) } else { scene(x, y) }
    };
    check("a disc is missing", &seen(without, |_, _| shifted(0.0)), false);
    check("a disc is missing, anti-aliased", &seen(without, |_, _| grid(3, 1.0, even)), false);
    check("a disc is missing, filtered", &blurred(&seen(without, |_, _| shifted(0.0))), false);
    let brighter = |x: f64, y: f64| scene(x, y) * 1.1;
    check("brighter", &seen(brighter, |_, _| shifted(0.0)), false);
    check("brighter, anti-aliased", &seen(brighter, |_, _| grid(2, 1.0, even)), false);
    let dimmer = |x: f64, y: f64| scene(x, y) * 0.97;
    check("a little dimmer", &seen(dimmer, |_, _| shifted(0.0)), false);
    let noisy = Image::from_fn(WIDTH, HEIGHT, |i, j| {
        ANSWER.expected.pixel(i, j) + DVec3::splat(random(i, j, 0) * 0.05)
    });
    check("noise", &noisy, false);
}

#[test]
fn other_mistakes_count_beside_anti_aliasing() {
    let speck = |x: f64, y: f64| if x < 3.0 && y < 3.0 { DVec3::ONE } else { scene(x, y) };
    let judgement = picture(&seen(speck, |_, _| grid(4, 1.0, even)), &ANSWER);
    let message = judgement.finding.expect("a finding").message;
    assert!(message.contains("it is anti-aliased: 258 pixels"), "{message}");
    assert!(message.ends_with("most at (0, 0): yours 255 255 255, expected 26 26 39"), "{message}");
    assert!(
        message.contains("besides, 9 pixels of 6,912 differ, 9 of them side by side"),
        "{message}"
    );
}

#[test]
fn a_step_of_one_colour_needs_neighbours_on_both_sides() {
    let flat = ImageAnswer::exact(Image::from_fn(9, 9, |_, _| DVec3::splat(0.5)), 1.0, 0);
    let off = Image::from_fn(9, 9, |i, j| DVec3::splat(if (i, j) == (4, 4) { 0.6 } else { 0.5 }));
    assert_eq!(classify(&off, &flat, 40), Relation::Apart);
    let step = ImageAnswer::exact(
        Image::from_fn(9, 9, |i, _| DVec3::splat(if i < 4 { 0.0 } else { 1.0 })),
        1.0,
        0,
    );
    let table = [
        (0.9, Relation::Near),
        (0.5, Relation::Between),
        (0.1, Relation::Flipped),
        (f64::NAN, Relation::Apart),
    ];
    for (light, expected) in table {
        let actual = Image::from_fn(9, 9, |_, _| DVec3::splat(light));
        assert_eq!(classify(&actual, &step, 40), expected, "{light}");
    }
}
