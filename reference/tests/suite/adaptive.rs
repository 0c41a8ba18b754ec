//! Tests of adaptive sampling: its pixels are those of two other pictures, and it costs less than
//! half of the finer one.

use std::path::Path;

use cases::film::{Image, level};
use cases::{Scene, stage};
use reference::cost::document::SCENES;
use reference::rules::Rules;
use reference::trace::render::{Options, Stats, render_by};
use reference::world::World;

const N: u32 = 4;

/// The scenes of docs/accuracy.md.
fn scenes() -> Vec<(String, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages");
    let stages = stage::load_all(&folder, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let cases = stages.into_iter().flat_map(|stage| stage.cases);
    let chosen = cases.filter(|case| SCENES.contains(&case.id.as_str()));
    chosen.map(|case| (case.id, case.scene)).collect()
}

fn rendered(scene: &Scene, samples: u32, adaptive: bool) -> (Image, Stats) {
    let world = World::<f64>::new(scene);
    let options = Options { samples, adaptive, ..Options::of(&world) };
    render_by(&world, &Rules::LECTURE, &options, |_| {})
}

/// Returns the root of the mean squared difference in 8-bit levels.
fn rms(one: &Image, other: &Image) -> f64 {
    let channels = |image: &Image| -> Vec<f64> {
        image.pixels().iter().flat_map(|light| light.to_array().map(level)).collect()
    };
    let (one, other) = (channels(one), channels(other));
    let squares = one.iter().zip(&other).map(|(a, b)| (a - b) * (a - b));
    (squares.sum::<f64>() / one.len() as f64).sqrt()
}

#[test]
fn every_pixel_is_that_of_one_ray_or_of_the_whole_grid() {
    let scenes = scenes();
    assert_eq!(scenes.len(), SCENES.len());
    for (id, scene) in scenes {
        let (one, _) = rendered(&scene, 1, false);
        let (grid, _) = rendered(&scene, N, false);
        let (adaptive, stats) = rendered(&scene, N, true);
        let n_eye = adaptive.pixels().len() as u64;
        let n_grids = (stats.rays.eye - n_eye) / u64::from(N * N);
        assert_eq!(stats.rays.eye, n_eye + n_grids * u64::from(N * N), "{id}");
        let with_grid = |n: &usize| adaptive.pixels()[*n] == grid.pixels()[*n];
        let all: Vec<usize> = (0..adaptive.pixels().len()).collect();
        let without: Vec<&usize> = all.iter().filter(|n| !with_grid(n)).collect();
        assert!(without.iter().all(|n| adaptive.pixels()[**n] == one.pixels()[**n]), "{id}");
        assert!(without.len() as u64 <= n_eye - n_grids, "{id}");
        // The neighbours of a pixel that has only one ray do not differ from it.
        let (width, pixels) = (adaptive.width() as usize, adaptive.pixels());
        for n in without.into_iter().filter(|n| **n % width > 0) {
            let differences = (pixels[*n] - pixels[n - 1]).to_array();
            let most = differences.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
            let is_dark = pixels[*n].max_element().max(pixels[n - 1].max_element()) <= 1.0;
            assert!(!is_dark || 255.0 * most <= 9.0 + 1e-9, "{id}, pixel {n}: {differences:?}");
        }
    }
}

#[test]
fn the_error_of_the_grid_takes_two_fifths_of_its_rays() {
    for (id, scene) in scenes() {
        let (grid, whole) = rendered(&scene, N, false);
        let (adaptive, part) = rendered(&scene, N, true);
        let share = part.rays.total() as f64 / whole.rays.total() as f64;
        let (one, error) = (rms(&rendered(&scene, 1, false).0, &grid), rms(&adaptive, &grid));
        println!("{id}: {share:.3} of the rays, {error:.3} levels from the grid, one ray {one:.3}");
        assert!(share < 0.4, "{id} takes {share} of the rays");
        assert!(error < 0.06 * one, "{id} is {error} levels off, one ray is {one}");
    }
}

#[test]
fn a_flat_picture_gets_one_ray_a_pixel() {
    let text = "render = { size = [9, 7], max_depth = 0 }
        [scene]
        background = [0.25, 0.5, 0.75]
        camera = { eye = [0, 0, 2], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }";
    let scene = cases::scene::parse("flat.toml", text, "".as_ref(), &Default::default()).unwrap();
    let (picture, stats) = rendered(&scene, 8, true);
    assert_eq!(stats.rays.total(), 63);
    assert!(picture.pixels().iter().all(|light| light.to_array() == [0.25, 0.5, 0.75]));
}
