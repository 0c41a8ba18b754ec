//! The legal variations: other ways to compute the picture that the rules describe, as students may
//! choose them.
//!
//! A picture by a variation is as correct as the reference's own. The pictures differ only where
//! rounding decides. The envelope of all of them is what a correct program may give.
//! `docs/grading.md` lists all freedoms; [`published`] returns its table.

use cases::film::Image;
use cases::{Effects, Scene};
use serde::Serialize;

use crate::numbers::real::Real;
use crate::rules::{
    CameraFormula, Epsilon, LightOrder, PlaneFormula, Power, Quadratic, Robustness, Rules, Snell,
    Start, Style, ToLight, TriangleFormula,
};
use crate::trace::render::{self, Options};
use crate::world::World;

/// The floating-point type of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl Precision {
    /// Returns the name of the type.
    pub fn says(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    /// Returns the values of RAY_EPSILON in the variations, in ascending order. The first and the
    /// last bound the legal range.
    fn epsilons(self) -> [f64; 4] {
        match self {
            Self::F32 => [1e-4, 2e-4, 5e-4, 1e-3],
            Self::F64 => [1e-6, 1e-5, 1e-4, 1e-3],
        }
    }
}

/// One legal way to compute the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// A unique name, such as `f32, textbook quadratic, Möller–Trumbore, t > 1e-3`.
    pub name: String,
    /// The floating-point type.
    pub precision: Precision,
    /// The base rules with another epsilon and style.
    pub rules: Rules,
}

impl Variation {
    fn new(base: &Rules, precision: Precision, epsilon: f64, style: Style) -> Self {
        let rules = Rules { epsilon: Epsilon::Fixed(epsilon), style, ..*base };
        Self { name: name(precision, epsilon, &style), precision, rules }
    }

    /// Renders a scene with these effects: one ray per pixel, linear light.
    pub fn picture(&self, scene: &Scene, effects: Effects) -> Image {
        match self.precision {
            Precision::F32 => picture::<f32>(&self.rules, scene, effects),
            Precision::F64 => picture::<f64>(&self.rules, scene, effects),
        }
    }
}

fn picture<T: Real>(rules: &Rules, scene: &Scene, effects: Effects) -> Image {
    let world = World::<T>::new(scene);
    render::render(&world, rules, &Options { effects, ..Options::of(&world) }, |_| {}).0
}

/// The choices of the variations of each precision: a row for each variation, a column for each
/// freedom. Any two choices of two freedoms occur together in some row. The choices of a freedom
/// occur equally often.
///
/// Columns: quadratic, triangle, start, epsilon, camera, to_light, plane, snell, power, lights.
const PLAN: [[usize; 10]; 24] = [
    [0, 0, 0, 2, 2, 1, 0, 1, 0, 0],
    [0, 0, 1, 0, 0, 1, 1, 1, 0, 1],
    [0, 1, 2, 0, 1, 0, 0, 0, 0, 0],
    [0, 2, 1, 1, 2, 1, 1, 0, 1, 1],
    [0, 3, 1, 3, 1, 0, 0, 0, 0, 1],
    [0, 3, 2, 1, 1, 0, 1, 1, 1, 1],
    [1, 0, 2, 1, 1, 1, 1, 1, 0, 1],
    [1, 1, 0, 2, 1, 1, 1, 1, 1, 1],
    [1, 2, 0, 0, 1, 1, 0, 1, 1, 1],
    [1, 2, 1, 2, 0, 0, 1, 0, 0, 0],
    [1, 2, 2, 3, 2, 1, 1, 1, 1, 0],
    [1, 3, 2, 2, 2, 0, 1, 0, 1, 0],
    [2, 0, 1, 3, 2, 0, 0, 1, 1, 0],
    [2, 0, 2, 3, 0, 0, 0, 0, 0, 0],
    [2, 1, 0, 2, 0, 1, 1, 0, 0, 1],
    [2, 1, 0, 3, 0, 1, 0, 1, 1, 1],
    [2, 2, 0, 0, 1, 0, 1, 0, 0, 0],
    [2, 3, 2, 1, 0, 1, 0, 0, 1, 0],
    [3, 0, 2, 2, 0, 0, 1, 1, 1, 0],
    [3, 1, 1, 0, 2, 1, 1, 0, 1, 1],
    [3, 1, 1, 1, 0, 0, 0, 1, 1, 1],
    [3, 2, 1, 3, 2, 0, 0, 0, 0, 1],
    [3, 3, 0, 0, 1, 0, 0, 0, 0, 0],
    [3, 3, 0, 1, 2, 1, 0, 1, 0, 0],
];

/// The ways in which students start rays at surfaces. Unlike the reference's, all use RAY_EPSILON.
const STARTS: [Start; 3] = [Start::Interval, Start::AlongNormal, Start::AlongRay];
/// The directions of the nudges, taken in turn. f32 begins with the second half, which is the first
/// one reversed.
const NUDGES: [[f64; 2]; 8] = [
    [1.0, 0.3],
    [-0.3, 1.0],
    [0.7, 0.7],
    [-0.7, 0.7],
    [-1.0, -0.3],
    [0.3, -1.0],
    [-0.7, -0.7],
    [0.7, -0.7],
];
/// The sizes of the nudges in pixels, taken in turn.
const NUDGE_SIZES: [f64; 3] = [1e-3, 3e-3, 1e-2];

/// Returns the ways to compute pictures by the rules `base` that a student may choose.
///
/// They are plain f32, which is the reference's own formulas rounded, then 24 in f64 and 24 in f32.
/// The reference in f64 is not among them.
pub fn variations(base: &Rules) -> Vec<Variation> {
    let plain = Variation::new(
        base,
        Precision::F32,
        1e-4,
        Style {
            robustness: Robustness::Plain,
            start: Start::Interval,
            nudge: [0.0; 2],
            ..base.style
        },
    );
    let planned = [Precision::F64, Precision::F32].into_iter().flat_map(|precision| {
        PLAN.iter().enumerate().map(move |(n, row)| {
            let (epsilon, style) = planned(precision, n, row);
            Variation::new(base, precision, epsilon, style)
        })
    });
    std::iter::once(plain).chain(planned).collect()
}

fn planned(precision: Precision, n: usize, row: &[usize; 10]) -> (f64, Style) {
    let [quadratic, triangle, start, epsilon, camera, to_light, plane, snell, power, lights] = *row;
    let size = NUDGE_SIZES[n % NUDGE_SIZES.len()];
    let turn = if precision == Precision::F32 { n + NUDGES.len() / 2 } else { n };
    let style = Style {
        robustness: Robustness::Plain,
        quadratic: Quadratic::ALL[quadratic],
        plane: PlaneFormula::ALL[plane],
        triangle: TriangleFormula::ALL[triangle],
        start: STARTS[start],
        to_light: ToLight::ALL[to_light],
        camera: CameraFormula::ALL[camera],
        snell: Snell::ALL[snell],
        power: Power::ALL[power],
        lights: LightOrder::ALL[lights],
        nudge: NUDGES[turn % NUDGES.len()].map(|way| way * size),
    };
    (precision.epsilons()[epsilon], style)
}

/// Returns the name of a variation: precision, formulas of shapes, epsilon, then the other
/// differences from the reference.
fn name(precision: Precision, epsilon: f64, style: &Style) -> String {
    let mut words = vec![
        precision.says().to_owned(),
        style.quadratic.says().to_owned(),
        style.triangle.says().to_owned(),
        format!("{} {epsilon:e}", style.start.says()),
    ];
    let own = Style::REFERENCE;
    let others = [
        (style.to_light != own.to_light, style.to_light.says()),
        (style.plane != own.plane, style.plane.says()),
        (style.camera != own.camera, style.camera.says()),
        (style.snell != own.snell, style.snell.says()),
        (style.power != own.power, style.power.says()),
        (style.lights != own.lights, style.lights.says()),
    ];
    words.extend(others.iter().filter(|(differs, _)| *differs).map(|(_, says)| (*says).to_owned()));
    if style.nudge != own.nudge {
        words.push(format!("nudged by {:.4}, {:.4} px", style.nudge[0], style.nudge[1]));
    }
    words.join(", ")
}

/// Returns the table of `docs/grading.md` that lists the freedoms of students.
pub fn published() -> String {
    let range = |precision: Precision| {
        let [least, .., greatest] = precision.epsilons();
        format!("{least:e} to {greatest:e} in {}", precision.says())
    };
    let [normal, ray] = [Start::AlongNormal, Start::AlongRay].map(Start::says);
    let rows = [
        ("precision", all(&[Precision::F64, Precision::F32], Precision::says)),
        ("sphere, cylinder, cone", all(Quadratic::ALL, Quadratic::says)),
        ("plane", all(PlaneFormula::ALL, PlaneFormula::says)),
        ("triangle", all(TriangleFormula::ALL, TriangleFormula::says)),
        (
            "RAY_EPSILON",
            format!("{}, {}, in world space", range(Precision::F64), range(Precision::F32)),
        ),
        (
            "how a ray leaves a surface",
            format!(
                "only hits at t > RAY_EPSILON count; or any at t > 0, from an origin {normal} \
                    (the geometric one, to the side where the ray goes) or {ray}, by RAY_EPSILON"
            ),
        ),
        (
            "direction and length of a shadow ray from such an origin",
            all(ToLight::ALL, ToLight::says),
        ),
        (
            "eye ray",
            format!(
                "{}; off by up to {} pixels",
                all(CameraFormula::ALL, CameraFormula::says),
                NUDGE_SIZES[2]
            ),
        ),
        ("refraction", all(Snell::ALL, Snell::says)),
        ("highlight", all(Power::ALL, Power::says)),
        ("order of additions", format!("{}; any other", all(LightOrder::ALL, LightOrder::says))),
    ];
    let lines = rows.map(|(freedom, ways)| format!("| {freedom} | {ways} |\n"));
    format!("| freedom | range |\n|---|---|\n{}", lines.concat())
}

fn all<W: Copy>(ways: &[W], says: impl Fn(W) -> &'static str) -> String {
    ways.iter().map(|way| says(*way)).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_two_ways_of_two_freedoms_occur_in_some_member() {
        let n_ways = [
            Quadratic::ALL.len(),
            TriangleFormula::ALL.len(),
            STARTS.len(),
            Precision::F64.epsilons().len(),
            CameraFormula::ALL.len(),
            ToLight::ALL.len(),
            PlaneFormula::ALL.len(),
            Snell::ALL.len(),
            Power::ALL.len(),
            LightOrder::ALL.len(),
        ];
        for (i, one) in n_ways.iter().enumerate() {
            for (j, other) in n_ways.iter().enumerate().skip(i + 1) {
                for (a, b) in (0..*one).flat_map(|a| (0..*other).map(move |b| (a, b))) {
                    assert!(
                        PLAN.iter().any(|row| row[i] == a && row[j] == b),
                        "way {a} of {i} never occurs with {b} of {j}"
                    );
                }
            }
        }
    }
}
