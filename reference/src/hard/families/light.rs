//! Hard reflections, refractions, transformed normals and transformed spheres.

use cases::maths;

use super::super::draws::{Draws, along, cross, unit};
use super::super::question::{Form, Line, Question};

/// Returns a unit direction towards the surface with normal `n`, whose angle of incidence has the
/// cosine `cosine`.
fn with_cosine(draws: &mut Draws, n: [f64; 3], cosine: f64) -> [f64; 3] {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    unit(along(draws.across(n).map(|x| x * sine), n, -cosine))
}

pub(super) fn reflect(draws: &mut Draws) -> Question {
    let (normal, cosine) = (draws.direction(), draws.between(0.0, 1.0));
    Question::Reflect { direction: with_cosine(draws, normal, cosine), normal }
}

/// Draws an angle of incidence with a cosine of 10⁻⁸ to a tenth.
pub(super) fn reflect_grazing(draws: &mut Draws) -> Question {
    let (normal, cosine) = (draws.direction(), draws.power(-8.0, -1.0));
    Question::Reflect { direction: with_cosine(draws, normal, cosine), normal }
}

fn refracted(draws: &mut Draws, cosine: f64, eta_i: f64, eta_t: f64) -> Question {
    let normal = draws.direction();
    Question::Refract { direction: with_cosine(draws, normal, cosine), normal, eta_i, eta_t }
}

pub(super) fn refract(draws: &mut Draws) -> Question {
    let (cosine, eta_i, eta_t) =
        (draws.between(0.02, 1.0), draws.between(1.0, 2.5), draws.between(1.0, 2.5));
    refracted(draws, cosine, eta_i, eta_t)
}

/// Draws a sin θ that differs from the critical one by 10⁻¹⁵ to a tenth of it, in either direction.
pub(super) fn near_critical(draws: &mut Draws) -> Question {
    let eta_t = draws.between(1.0, 1.5);
    let eta_i = eta_t * draws.between(1.05, 2.0);
    let sine = (eta_t / eta_i * (1.0 + draws.sign() * draws.power(-15.0, -1.0))).min(1.0);
    refracted(draws, ((1.0 - sine) * (1.0 + sine)).sqrt(), eta_i, eta_t)
}

/// Draws an angle of incidence with a cosine of 10⁻⁸ to a tenth.
pub(super) fn refract_grazing(draws: &mut Draws) -> Question {
    let (cosine, eta_t) = (draws.power(-8.0, -1.0), draws.between(1.0, 2.5));
    refracted(draws, cosine, 1.0, eta_t)
}

/// Draws indices that are equal or nearly equal.
pub(super) fn equal_index(draws: &mut Draws) -> Question {
    let (cosine, eta_i) = (draws.power(-3.0, 0.0), draws.between(1.0, 2.5));
    let eta_t = if draws.sign() > 0.0 {
        eta_i
    } else {
        eta_i * (1.0 + draws.sign() * draws.power(-15.0, -3.0))
    };
    refracted(draws, cosine, eta_i, eta_t)
}

/// Returns the rows of a random rotation.
fn rotation(draws: &mut Draws) -> [[f64; 3]; 3] {
    let x = draws.direction();
    let y = draws.across(x);
    [x, y, cross(x, y)]
}

/// Returns the rows of R diag(scales) S, where R and S are random rotations.
pub(super) fn matrix(draws: &mut Draws, scales: [f64; 3]) -> [[f64; 3]; 3] {
    let (left, right) = (rotation(draws), rotation(draws));
    let at = |i: usize, j: usize| (0..3).map(|n| left[n][i] * scales[n] * right[n][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))
}

fn scales(draws: &mut Draws, decades: f64) -> [f64; 3] {
    let mut scales = [1.0, draws.power(0.0, decades), maths::pow(10.0, decades)];
    scales.swap(0, draws.index(3));
    scales.map(|s| s * 1e-3)
}

pub(super) fn normal(draws: &mut Draws) -> Question {
    let scales = std::array::from_fn(|_| draws.power(-0.5, 0.5));
    Question::Normal { rows: matrix(draws, scales), normal: draws.direction() }
}

/// Draws a matrix that scales its axes as 1 : 10⁶.
pub(super) fn normal_stretched(draws: &mut Draws) -> Question {
    let scales = scales(draws, 6.0);
    Question::Normal { rows: matrix(draws, scales), normal: draws.direction() }
}

pub(super) fn normal_mirrored(draws: &mut Draws) -> Question {
    let mut scales = std::array::from_fn(|_| draws.power(-1.0, 1.0));
    scales[draws.index(3)] *= -1.0;
    Question::Normal { rows: matrix(draws, scales), normal: draws.direction() }
}

/// Draws a matrix that scales one axis by 10⁻¹² to 10⁻⁶.
pub(super) fn normal_near_singular(draws: &mut Draws) -> Question {
    let scales = [1.0, draws.power(-0.5, 0.5), draws.power(-12.0, -6.0)];
    Question::Normal { rows: matrix(draws, scales), normal: draws.direction() }
}

/// Draws a line towards the image of a point at distance `reach` from the centre of the sphere,
/// which `scales` transforms.
fn moved_sphere(draws: &mut Draws, scales: [f64; 3], reach: f64) -> Question {
    let (rows, translation) = (matrix(draws, scales), draws.point(5.0));
    let moved = |p: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|n| (0..3).map(|m| rows[n][m] * p[m]).sum::<f64>() + translation[n])
    };
    let (inside, outside) =
        (draws.direction().map(|x| x * reach), draws.direction().map(|x| x * 3.0));
    let (origin, target) = (moved(outside), moved(inside));
    let direction = unit(std::array::from_fn(|n| target[n] - origin[n]));
    let (line, form) = (Line { origin, direction }, Form::SPHERE);
    Question::Transformed { line, form, rows, translation }
}

pub(super) fn sphere_uniform(draws: &mut Draws) -> Question {
    let (size, reach) = (draws.power(-3.0, 3.0), draws.between(0.0, 0.7));
    moved_sphere(draws, [size; 3], reach)
}

/// Draws a transformed sphere whose axes are scaled as 1 : 10³.
pub(super) fn sphere_stretched(draws: &mut Draws) -> Question {
    let (scales, reach) = (scales(draws, 3.0), draws.between(0.0, 0.7));
    moved_sphere(draws, scales, reach)
}

/// Draws a transformed sphere whose axes are scaled as 1 : 10⁶.
pub(super) fn sphere_flattened(draws: &mut Draws) -> Question {
    let (scales, reach) = (scales(draws, 6.0), draws.between(0.0, 0.7));
    moved_sphere(draws, scales, reach)
}
