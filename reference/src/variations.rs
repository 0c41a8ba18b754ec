//! The legal variations: other ways of computing the picture that the rules describe, as students may choose them.
//!
//! A picture by one of them is as right as the reference's own. What they disagree about is what rounding decides: the envelope of
//! all of them is what a right program may give.

use cases::film::Image;
use cases::{Effects, Scene};

use crate::real::Real;
use crate::render::{self, Options};
use crate::rules::{
    CameraFormula, Epsilon, LightOrder, PlaneFormula, Power, Quadratic, Rules, Snell, Start, Style, ToLight,
    TriangleFormula,
};
use crate::world::World;

/// The scalars of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Single.
    F32,
    /// Double.
    F64,
}

impl Precision {
    fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    /// The epsilons of the members, the least and the greatest that are legal among them.
    fn epsilons(self) -> [f64; 4] {
        match self {
            Self::F32 => [1e-4, 2e-4, 5e-4, 1e-3],
            Self::F64 => [1e-6, 1e-5, 1e-4, 1e-3],
        }
    }
}

/// A legal way of computing the same picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Such as `f32, textbook quadratic, Möller–Trumbore, t > 1e-3`; unique.
    pub name: String,
    /// Its scalars.
    pub precision: Precision,
    /// The base rules with another epsilon and style.
    pub rules: Rules,
}

impl Variation {
    fn new(base: &Rules, precision: Precision, epsilon: f64, style: Style) -> Self {
        let rules = Rules { epsilon: Epsilon::Fixed(epsilon), style, ..*base };
        Self { name: name(precision, epsilon, &style), precision, rules }
    }

    /// The picture of a scene by this way, with these effects; one ray a pixel, linear light.
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

/// A row for each member of a precision, a column for each freedom: which of its ways. Any two ways of two freedoms meet in some
/// row, and each way of one freedom stands in as many rows as any other.
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

/// Directions of the nudges, taken in turn.
const NUDGES: [[f64; 2]; 8] =
    [[1.0, 0.3], [-0.3, 1.0], [-1.0, -0.3], [0.3, -1.0], [0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7], [0.7, -0.7]];
/// Their sizes in pixels, taken in turn.
const NUDGE_SIZES: [f64; 3] = [1e-3, 3e-3, 1e-2];

/// The ways of computing pictures by the rules `base`, which are a student's to choose: 24 in f64, 24 in f32, and plain f32, the
/// reference's own formulas rounded. The reference in f64 is not among them.
pub fn variations(base: &Rules) -> Vec<Variation> {
    let plain = Variation::new(base, Precision::F32, 1e-4, Style { nudge: [0.0; 2], ..base.style });
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
    let style = Style {
        quadratic: Quadratic::ALL[quadratic],
        plane: PlaneFormula::ALL[plane],
        triangle: TriangleFormula::ALL[triangle],
        start: Start::ALL[start],
        to_light: ToLight::ALL[to_light],
        camera: CameraFormula::ALL[camera],
        snell: Snell::ALL[snell],
        power: Power::ALL[power],
        lights: LightOrder::ALL[lights],
        nudge: NUDGES[n % NUDGES.len()].map(|way| way * size),
    };
    (precision.epsilons()[epsilon], style)
}

/// Precision, the formulas for shapes, the epsilon; then what else differs from the reference.
fn name(precision: Precision, epsilon: f64, style: &Style) -> String {
    let mut words = vec![
        precision.name().to_owned(),
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
