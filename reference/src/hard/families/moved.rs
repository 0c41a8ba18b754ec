//! Hard shapes under a matrix: silhouettes, edges, rims and tips, as seen from world space.

use super::super::draws::{Draws, along};
use super::super::question::{Form, Line, Question};
use super::light::matrix;
use super::{flat, solid, spheres};

/// Draws the matrix of an object: its axes are scaled by a tenth to ten, and it is up to 10⁴ units
/// from the origin.
fn placed(draws: &mut Draws) -> ([[f64; 3]; 3], [f64; 3]) {
    let scales = std::array::from_fn(|_| draws.sign() * draws.power(-1.0, 1.0));
    let distance = draws.power(-1.0, 4.0);
    (matrix(draws, scales), draws.direction().map(|x| x * distance))
}

/// Returns the question in object space, moved to world space.
fn moved(draws: &mut Draws, question: Question) -> Question {
    let (rows, translation) = placed(draws);
    let (line, form) = Form::of(question);
    let by = |v: [f64; 3]| rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
    let from = by(line.origin);
    let origin = std::array::from_fn(|n| from[n] + translation[n]);
    let line = Line { origin, direction: by(line.direction) };
    Question::Transformed { line, form, rows, translation }
}

pub(super) fn sphere_tangent(draws: &mut Draws) -> Question {
    let question = spheres::tangent(draws);
    moved(draws, question)
}

pub(super) fn sphere_near_surface(draws: &mut Draws) -> Question {
    let question = spheres::near_surface(draws);
    moved(draws, question)
}

/// Draws the sphere of radius ½ about the origin, and a line that is tangent up to 10⁻¹⁶ to a tenth
/// of the radius, from up to a thousand units away.
pub(super) fn sphere_silhouette(draws: &mut Draws) -> Question {
    let direction = draws.direction();
    let (across, gap) = (draws.across(direction), draws.sign() * draws.power(-16.0, -1.0));
    let nearest = across.map(|x| 0.5 * x * (1.0 + gap));
    let origin = along(nearest, direction, -draws.power(-1.0, 3.0));
    let line = Line { origin, direction };
    moved(draws, Question::Sphere { line, center: [0.0; 3], radius: 0.5 })
}

pub(super) fn plane_near_parallel(draws: &mut Draws) -> Question {
    let question = flat::plane_near_parallel(draws);
    moved(draws, question)
}

pub(super) fn square_border(draws: &mut Draws) -> Question {
    let question = flat::square_border(draws);
    moved(draws, question)
}

pub(super) fn cuboid_edge(draws: &mut Draws) -> Question {
    let question = solid::at_edge(draws);
    moved(draws, question)
}

pub(super) fn cuboid_slab(draws: &mut Draws) -> Question {
    let question = solid::in_slab(draws);
    moved(draws, question)
}

pub(super) fn cylinder_touching(draws: &mut Draws) -> Question {
    let question = solid::touching(draws);
    moved(draws, question)
}

pub(super) fn cylinder_rim(draws: &mut Draws) -> Question {
    let question = solid::rim(draws);
    moved(draws, question)
}

pub(super) fn cone_along_side(draws: &mut Draws) -> Question {
    let question = solid::along_side(draws);
    moved(draws, question)
}

pub(super) fn cone_tip(draws: &mut Draws) -> Question {
    let question = solid::tip(draws);
    moved(draws, question)
}
