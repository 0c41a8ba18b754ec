//! The cost of an effect in a scene that does not call for it.
//!
//! Two kernels are compared with a third one, from which the effect is deleted: the kernel that is
//! chosen for the scene, and the general kernel, which simulates every effect.

use std::path::Path;

use cases::{Course, Effect, Effects, Mesh, Scene, Shape, scene};
use glam::DVec3;
use serde::Serialize;

use super::measure::Outside;
use super::times::Times;
use crate::rules::{Lecture, Rules};
use crate::trace::render::{Options, render, render_by, render_under};
use crate::trace::simulated::Within;
use crate::watch::Notes;
use crate::world::World;

/// The cost of effects in a scene that does not call for them. Times are those of rendering alone,
/// in seconds; ratios are those of medians.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UncalledRow {
    /// The effects that the scene does not call for, and that are deleted from the kernel of
    /// `deleted_s`.
    pub deleted: Vec<Effect>,
    /// A description of the scene.
    pub scene: &'static str,
    /// The effects that the scene calls for.
    pub simulated: Effects,
    /// The times of a kernel that is compiled for exactly the effects that the scene calls for.
    pub deleted_s: Times,
    /// The times of the kernel that `render_by` chooses.
    pub chosen_s: Times,
    /// The times of the general kernel, which simulates every effect.
    pub able_s: Times,
    /// The median of `chosen_s` over the median of `deleted_s`.
    pub chosen_ratio: f64,
    /// The median of `able_s` over the median of `deleted_s`.
    pub able_ratio: f64,
}

/// A function that renders a world with one kernel.
type Render = fn(&World<f64>);

/// A scene, and the effects that it does not call for.
struct Subject {
    shows: &'static str,
    scene: Scene,
    deleted: &'static [Effect],
}

/// Measures the cost of each effect in a scene that does not call for it, in `n_rounds` rounds that
/// run each kernel once.
///
/// Returns `None` if it is stopped before the first round is complete. Runs in the current `rayon`
/// pool.
///
/// A caller of this function compiles kernels that no other picture uses.
pub fn price<O: Outside>(n_rounds: usize, outside: &mut O) -> Option<Vec<UncalledRow>> {
    let subjects = subjects();
    // For each subject, the kernel that is compiled for exactly the effects that it calls for.
    let exactly: [Render; SCENES] = [
        exactly::<{ Effects::NONE.bits() }>,
        exactly::<{ SHADOWS.bits() }>,
        exactly::<{ MIRRORS.bits() }>,
        exactly::<{ GLASS.bits() }>,
        exactly::<{ SHADOWS.bits() }>,
    ];
    let worlds: Vec<World<f64>> =
        subjects.iter().map(|subject| World::new(&subject.scene)).collect();
    let mut times = vec![[const { Vec::new() }; 3]; subjects.len()];
    'rounds: for round in 0..n_rounds {
        for ((exactly, world), times) in exactly.iter().zip(&worlds).zip(&mut times) {
            let kernels: [Render; 3] = [*exactly, chosen, able];
            for n in 0..kernels.len() {
                let at = (n + round) % kernels.len();
                if !outside.goes_on() {
                    break 'rounds;
                }
                let start = outside.now_s();
                kernels[at](world);
                times[at].push(outside.now_s() - start);
                outside.done(1);
            }
        }
    }
    rows(&subjects, &worlds, &times)
}

/// Returns the number of pictures that [`price`] renders, for a progress bar.
pub fn work(n_rounds: usize) -> u64 {
    3 * SCENES as u64 * n_rounds as u64
}

fn rows(
    subjects: &[Subject],
    worlds: &[World<f64>],
    times: &[[Vec<f64>; 3]],
) -> Option<Vec<UncalledRow>> {
    let row = |((subject, world), times): ((&Subject, &World<f64>), &[Vec<f64>; 3])| {
        let [deleted_s, chosen_s, able_s] = [0, 1, 2].map(|n: usize| Times::of(&times[n]));
        UncalledRow {
            deleted: subject.deleted.to_vec(),
            scene: subject.shows,
            simulated: world.effects,
            deleted_s,
            chosen_s,
            able_s,
            chosen_ratio: chosen_s.median / deleted_s.median,
            able_ratio: able_s.median / deleted_s.median,
        }
    };
    let is_whole = times.iter().all(|kernels| kernels.iter().all(|times| !times.is_empty()));
    is_whole.then(|| subjects.iter().zip(worlds).zip(times).map(row).collect())
}

fn chosen(world: &World<f64>) {
    std::hint::black_box(render_by(world, &Rules::LECTURE, &Options::of(world), |_| {}));
}

fn able(world: &World<f64>) {
    std::hint::black_box(render(world, Lecture, &Options::of(world), |_| {}));
}

/// Renders with the kernel from which all effects except `MOST` are deleted.
fn exactly<const MOST: u16>(world: &World<f64>) {
    let effects = Within::<MOST>::new(world.effects, 0.0)
        .expect("the subjects name the effects of their scenes");
    let options = Options::of(world);
    std::hint::black_box(render_under::<_, _, _, Notes>(world, Lecture, effects, &options, |_| {}));
}

const SHADOWS: Effects = Effects::NONE.with(Effect::Shadows);
const MIRRORS: Effects = SHADOWS.with(Effect::Reflection);
const GLASS: Effects = SHADOWS.with(Effect::TintedShadows).with(Effect::Refraction);

const SCENES: usize = 5;

fn subjects() -> [Subject; SCENES] {
    use Effect::{Reflection, Refraction, Shadows, SmoothNormals, TintedShadows};
    [
        Subject {
            shows: "balls on a floor, without shadows",
            scene: without_shadows(balls("chalk")),
            deleted: &[Shadows, Reflection, Refraction],
        },
        Subject {
            shows: "balls on a floor",
            scene: balls("chalk"),
            deleted: &[TintedShadows, Reflection, Refraction],
        },
        Subject {
            shows: "mirroring balls on a floor",
            scene: balls("mirror"),
            deleted: &[TintedShadows, Refraction],
        },
        Subject {
            shows: "balls of glass on a floor",
            scene: balls("glass"),
            deleted: &[Reflection],
        },
        Subject { shows: "hills, each triangle flat", scene: hills(), deleted: &[SmoothNormals] },
    ]
}

const HEAD: &str = "[render]\nsize = [160, 120]\nmax_depth = 4\n[scene]\n\
    background = [0.1, 0.2, 0.4]\n\
    camera = { eye = [0, 1.5, 5], look_at = [0, 0.2, 0], up = [0, 1, 0], fov_y_deg = 40 }\n\
    lights = [{ point = { position = [3, 4, 3], colour = [0.7, 0.7, 0.7] } }, { directional = { \
    direction = [1, -2, -1], colour = [0.3, 0.3, 0.3] } }]\n\
    [scene.materials]\nchalk = { kd = [0.6, 0.5, 0.4], ks = [0.3, 0.3, 0.3], kr = [0, 0, 0], ns = \
    20 }\n\
    mirror = { kd = [0.1, 0.1, 0.1], kr = [0.7, 0.7, 0.7] }\n\
    glass = { kd = [0.1, 0.1, 0.1], kt = [0.8, 0.9, 0.8], kr = [0, 0, 0], index = 1.5 }\n";

/// Returns a scene of five balls of `material` on a floor of chalk.
fn balls(material: &str) -> Scene {
    let mut text = String::from(HEAD);
    for (x, z) in [(-1.6, 0.0), (-0.8, 0.6), (0.0, -0.6), (0.8, 0.6), (1.6, 0.0)] {
        text += &format!(
            "[[scene.objects]]\nsphere = {{ center = [{x}, 0, {z}], radius = 0.5 }}\n\
                material = \"{material}\"\n"
        );
    }
    parsed(
        &(text
            + "[[scene.objects]]\nplane = { normal = [0, 1, 0], k = -0.5 }\n\
                material = \"chalk\"\n"),
    )
}

fn parsed(text: &str) -> Scene {
    scene::parse("price", text, Path::new(""), &Course::default())
        .expect("the scenes are valid: a test parses all of them")
}

fn without_shadows(mut scene: Scene) -> Scene {
    scene.effects = Effects::NONE;
    scene
}

/// Returns a scene of a mesh of 4,608 triangles over a square of the ground.
fn hills() -> Scene {
    const SIDE: u32 = 48;
    let mut scene = balls("chalk");
    scene.objects.truncate(1);
    let at = |n: u32| 4.0 * f64::from(n) / f64::from(SIDE) - 2.0;
    let height = |x: f64, z: f64| 0.3 * cases::maths::sin(5.0 * x) * cases::maths::cos(4.0 * z);
    let places = (0..=SIDE).flat_map(|j| (0..=SIDE).map(move |i| (i, j)));
    let vertices = places.map(|(i, j)| DVec3::new(at(i), height(at(i), at(j)), at(j))).collect();
    let cells = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| j * (SIDE + 1) + i));
    let halves =
        cells.flat_map(|n| [[n, n + SIDE + 1, n + 1], [n + 1, n + SIDE + 1, n + SIDE + 2]]);
    scene.meshes.push(Mesh { vertices, triangles: halves.collect(), normals: None });
    scene.objects[0].shape = Shape::Mesh { mesh: 0 };
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A clock that advances by a second with every reading.
    struct Ticking(f64);

    impl Outside for Ticking {
        fn now_s(&mut self) -> f64 {
            self.0 += 1.0;
            self.0
        }

        fn goes_on(&mut self) -> bool {
            true
        }

        fn done(&mut self, _work: u64) {}
    }

    #[test]
    fn no_row_simulates_what_it_says_is_deleted() {
        let mut clock = Ticking(0.0);
        let rows = price(1, &mut clock).expect("no one stops it");
        assert_eq!(clock.0, 2.0 * work(1) as f64);
        for UncalledRow { deleted, simulated, chosen_ratio, able_ratio, scene, .. } in &rows {
            assert!(deleted.iter().all(|effect| !simulated.has(*effect)), "{scene}");
            assert_eq!(
                (*chosen_ratio, *able_ratio),
                (1.0, 1.0),
                "each takes a second by that clock"
            );
        }
        let is_priced = |effect: &Effect| rows.iter().any(|row| row.deleted.contains(effect));
        use Effect::{Reflection, Refraction, Shadows, SmoothNormals, TintedShadows};
        assert!(
            [Shadows, TintedShadows, Reflection, Refraction, SmoothNormals].iter().all(is_priced)
        );
    }
}
