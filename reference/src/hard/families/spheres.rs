//! Hard spheres.

use super::super::draws::{Draws, along, dot, minus};
use super::super::question::{Line, Question};

/// Returns a line that starts `distance` away and passes the centre at the distance `offset`. Its
/// direction has any length.
fn passing(draws: &mut Draws, center: [f64; 3], distance: f64, offset: f64) -> Line {
    let towards = draws.direction();
    let across = draws.across(towards);
    let origin = along(along(center, towards, -distance), across, offset);
    let length = draws.power(-2.0, 2.0);
    Line { origin, direction: towards.map(|x| x * length) }
}

fn sphere(line: Line, center: [f64; 3], radius: f64) -> Question {
    Question::Sphere { line, center, radius }
}

/// Draws a sphere and a line as in ordinary scenes.
pub(super) fn generic(draws: &mut Draws) -> Question {
    let (center, radius) = (draws.point(5.0), draws.power(-1.0, 0.5));
    let (distance, offset) = (draws.between(0.0, 20.0), draws.between(0.0, 1.5) * radius);
    sphere(passing(draws, center, distance, offset), center, radius)
}

/// Draws a sphere that is a hundred to 10⁸ radii away.
pub(super) fn far(draws: &mut Draws) -> Question {
    let (center, radius) = (draws.point(5.0), draws.power(-1.0, 1.0));
    let (distance, offset) = (radius * draws.power(2.0, 8.0), draws.between(0.0, 1.2) * radius);
    sphere(passing(draws, center, distance, offset), center, radius)
}

/// Draws a line that is tangent up to 10⁻¹⁶ to a tenth of the radius, on either side of the
/// surface.
pub(super) fn tangent(draws: &mut Draws) -> Question {
    let (center, radius) = (draws.point(5.0), draws.power(-2.0, 2.0));
    let gap = draws.sign() * draws.power(-16.0, -1.0);
    let distance = radius * draws.between(0.0, 10.0);
    sphere(passing(draws, center, distance, radius * (1.0 + gap)), center, radius)
}

/// Draws a line that starts 10⁻¹⁵ to a tenth of the radius above the surface.
pub(super) fn near_surface(draws: &mut Draws) -> Question {
    let (center, radius) = (draws.point(5.0), draws.power(-2.0, 2.0));
    let height = radius * draws.power(-15.0, -1.0);
    let up = draws.direction();
    let line = Line { origin: along(center, up, radius + height), direction: draws.direction() };
    sphere(line, center, radius)
}

/// Draws a sphere that serves as the ground: its radius is 10³ to 10⁸, and the line starts a few
/// units above it.
pub(super) fn ground(draws: &mut Draws) -> Question {
    let radius = draws.power(3.0, 8.0);
    let center = [draws.between(-5.0, 5.0), -radius, draws.between(-5.0, 5.0)];
    let origin = [draws.between(-5.0, 5.0), draws.between(0.5, 10.0), draws.between(-5.0, 5.0)];
    let mut direction = draws.direction();
    direction[1] = -direction[1].abs() * draws.power(-4.0, 0.0);
    sphere(Line { origin, direction }, center, radius)
}

/// Draws a sphere and a line whose coordinates all have different magnitudes.
pub(super) fn coordinates(draws: &mut Draws) -> Question {
    let mut point = || std::array::from_fn(|_| draws.sign() * draws.power(-8.0, 8.0));
    let (origin, center): ([f64; 3], [f64; 3]) = (point(), point());
    let radius = draws.power(-4.0, 4.0);
    let way = minus(center, origin);
    let across = draws.across(way);
    let target = along(center, across, radius * draws.between(0.0, 1.2));
    let way = minus(target, origin);
    let length = dot(way, way).sqrt();
    sphere(Line { origin, direction: way.map(|x| x / length) }, center, radius)
}

/// Draws a generic sphere and line, a million units from the origin.
pub(super) fn offset(draws: &mut Draws) -> Question {
    let Question::Sphere { line, center, radius } = generic(draws) else {
        unreachable!("a sphere was drawn")
    };
    let by = draws.direction().map(|x| x * 1e6);
    let line = Line { origin: along(line.origin, by, 1.0), ..line };
    sphere(line, along(center, by, 1.0), radius)
}

/// Draws a generic sphere and line at any scale that the precision can hold. The direction is
/// scaled by another factor.
pub(super) fn scale(draws: &mut Draws) -> Question {
    let Question::Sphere { line, center, radius } = generic(draws) else {
        unreachable!("a sphere was drawn")
    };
    let (size, length) = (draws.power(-draws.decades, draws.decades), draws.power(-4.0, 4.0));
    let line = Line {
        origin: line.origin.map(|x| x * size),
        direction: line.direction.map(|x| x * length),
    };
    sphere(line, center.map(|x| x * size), radius * size)
}
