//! Hard planes, squares and triangles.

use super::super::draws::{Draws, along, cross, minus, unit};
use super::super::question::{Line, Question};

pub(super) fn plane(draws: &mut Draws) -> Question {
    let line = Line { origin: draws.point(10.0), direction: draws.direction() };
    Question::Plane { line, normal: draws.direction(), k: draws.between(-5.0, 5.0) }
}

/// Draws a line that is nearly parallel to the plane: |N·d| from 10⁻¹⁴ to a tenth.
pub(super) fn plane_near_parallel(draws: &mut Draws) -> Question {
    let normal = draws.direction();
    let slope = draws.sign() * draws.power(-14.0, -1.0);
    let direction = along(draws.across(normal), normal, slope);
    Question::Plane {
        line: Line { origin: draws.point(10.0), direction },
        normal,
        k: draws.between(-5.0, 5.0),
    }
}

/// Draws a plane a million units from the origin, and a line that starts a few units from the
/// plane.
pub(super) fn plane_offset(draws: &mut Draws) -> Question {
    let normal = draws.direction();
    let foot =
        along(draws.direction().map(|x| x * 1e6), normal, draws.sign() * draws.power(-3.0, 1.0));
    let k = foot.iter().zip(normal).map(|(x, n)| x * n).sum::<f64>() + draws.between(-5.0, 5.0);
    Question::Plane { line: Line { origin: foot, direction: draws.direction() }, normal, k }
}

pub(super) fn plane_scale(draws: &mut Draws) -> Question {
    let Question::Plane { line, normal, k } = plane(draws) else {
        unreachable!("a plane was drawn")
    };
    let size = draws.power(-draws.decades, draws.decades);
    Question::Plane {
        line: Line { origin: line.origin.map(|x| x * size), ..line },
        normal,
        k: k * size,
    }
}

/// Draws a line whose N·d is one product of two components, near the least number of the
/// precision.
pub(super) fn plane_subnormal(draws: &mut Draws) -> Question {
    let mut least = || {
        let decades = draws.decades;
        draws.sign() * draws.power(-decades - 12.0, -decades)
    };
    let (normal, direction) = ([1.0, least(), 0.0], [0.0, least(), 1.0]);
    let origin = [draws.sign() * draws.power(-30.0, -5.0), draws.between(-5.0, 5.0), 0.0];
    Question::Plane { line: Line { origin, direction }, normal, k: 0.0 }
}

/// Returns a line towards `target` from a random origin.
fn towards(draws: &mut Draws, target: [f64; 3]) -> Line {
    let origin = draws.point(5.0);
    Line { origin, direction: unit(minus(target, origin)) }
}

pub(super) fn square(draws: &mut Draws) -> Question {
    let target = [draws.between(-0.75, 0.75), draws.between(-0.75, 0.75), 0.0];
    Question::Square { line: towards(draws, target) }
}

/// Draws a line towards the border.
pub(super) fn square_border(draws: &mut Draws) -> Question {
    let mut target = [0.5 * draws.sign(), draws.between(-0.5, 0.5), 0.0];
    if draws.sign() > 0.0 {
        target.swap(0, 1);
    }
    Question::Square { line: towards(draws, target) }
}

/// Returns the point of a triangle with the weights `beta` of B and `gamma` of C.
fn inside([a, b, c]: [[f64; 3]; 3], beta: f64, gamma: f64) -> [f64; 3] {
    along(along(a, minus(b, a), beta), minus(c, a), gamma)
}

fn triangle_at(
    draws: &mut Draws,
    corners: [[f64; 3]; 3],
    target: [f64; 3],
    distance: f64,
) -> Question {
    let origin = along(target, draws.direction(), distance);
    Question::Triangle { line: Line { origin, direction: unit(minus(target, origin)) }, corners }
}

/// Draws a line from `distance` away towards a point in the triangle or a little beside it.
fn aimed(draws: &mut Draws, corners: [[f64; 3]; 3], distance: f64) -> Question {
    let (beta, gamma) = (draws.between(-0.25, 1.0), draws.between(-0.25, 1.0));
    triangle_at(draws, corners, inside(corners, beta, gamma), distance)
}

fn corners(draws: &mut Draws, size: f64) -> [[f64; 3]; 3] {
    let a = draws.point(3.0);
    [
        a,
        along(a, draws.direction(), size),
        along(a, draws.direction(), size * draws.between(0.3, 1.0)),
    ]
}

pub(super) fn triangle(draws: &mut Draws) -> Question {
    let corners = corners(draws, 2.0);
    let distance = draws.between(1.0, 10.0);
    aimed(draws, corners, distance)
}

/// Draws a triangle that is ten to 10⁷ times as long as wide.
pub(super) fn sliver(draws: &mut Draws) -> Question {
    let (a, long) = (draws.point(3.0), draws.direction());
    let wide = draws.across(long);
    let share = draws.between(0.0, 1.0);
    let b = along(a, long, 3.0);
    let c = along(along(a, long, 3.0 * share), wide, 3.0 * draws.power(-7.0, -1.0));
    let distance = draws.between(1.0, 10.0);
    aimed(draws, [a, b, c], distance)
}

/// Draws a triangle with edges of 10⁻⁶ to 10⁻².
pub(super) fn small(draws: &mut Draws) -> Question {
    let size = draws.power(-6.0, -2.0);
    let corners = corners(draws, size);
    let distance = draws.between(1.0, 10.0);
    aimed(draws, corners, distance)
}

/// Draws a triangle a million units from the origin.
pub(super) fn triangle_offset(draws: &mut Draws) -> Question {
    let by = draws.direction().map(|x| x * 1e6);
    let corners = corners(draws, 2.0).map(|corner| along(corner, by, 1.0));
    let distance = draws.between(1.0, 10.0);
    aimed(draws, corners, distance)
}

/// Draws a triangle with one corner a million times nearer to the origin than the others.
pub(super) fn mixed_scale(draws: &mut Draws) -> Question {
    let corners =
        [draws.point(1.0), draws.direction().map(|x| x * 1e6), draws.direction().map(|x| x * 1e6)];
    let (beta, gamma) = (draws.power(-7.0, 0.0), draws.power(-7.0, 0.0));
    let target = inside(corners, beta, gamma);
    let distance = draws.power(0.0, 6.0);
    triangle_at(draws, corners, target, distance)
}

pub(super) fn at_corner(draws: &mut Draws) -> Question {
    let corners = corners(draws, 2.0);
    let (corner, distance) = (corners[draws.index(3)], draws.between(1.0, 10.0));
    triangle_at(draws, corners, corner, distance)
}

pub(super) fn at_edge(draws: &mut Draws) -> Question {
    let corners = corners(draws, 2.0);
    let (from, share, distance) =
        (draws.index(3), draws.between(0.0, 1.0), draws.between(1.0, 10.0));
    let target = along(corners[from], minus(corners[(from + 1) % 3], corners[from]), share);
    triangle_at(draws, corners, target, distance)
}

/// Draws a triangle that is nearly edge on: |N·d| from 10⁻¹² to a tenth.
pub(super) fn edge_on(draws: &mut Draws) -> Question {
    let corners = corners(draws, 2.0);
    let normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])));
    let (beta, gamma) = (draws.between(-0.2, 0.8), draws.between(-0.2, 0.8));
    let target = inside(corners, beta, gamma);
    let slope = draws.sign() * draws.power(-12.0, -1.0);
    let direction = along(draws.across(normal), normal, slope);
    let origin = along(target, direction, -draws.between(1.0, 10.0));
    Question::Triangle { line: Line { origin, direction }, corners }
}

pub(super) fn triangle_scale(draws: &mut Draws) -> Question {
    let Question::Triangle { line, corners } = triangle(draws) else {
        unreachable!("a triangle was drawn")
    };
    let (size, length) = (draws.power(-draws.decades, draws.decades), draws.power(-4.0, 4.0));
    let line = Line {
        origin: line.origin.map(|x| x * size),
        direction: line.direction.map(|x| x * length),
    };
    Question::Triangle { line, corners: corners.map(|corner| corner.map(|x| x * size)) }
}
