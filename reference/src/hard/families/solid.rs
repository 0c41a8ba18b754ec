//! Hard boxes, cylinders and cones.

use super::super::draws::{Draws, along, minus, unit};
use super::super::question::{Line, Question};

fn corners(draws: &mut Draws) -> ([f64; 3], [f64; 3]) {
    let min = draws.point(3.0);
    (min, std::array::from_fn(|n| min[n] + draws.power(-2.0, 0.5)))
}

/// Draws a line towards a point of the box or around it.
pub(super) fn cuboid(draws: &mut Draws) -> Question {
    let (min, max) = corners(draws);
    let target = std::array::from_fn(|n| min[n] + draws.between(-0.2, 1.2) * (max[n] - min[n]));
    let origin = draws.point(8.0);
    Question::Cuboid { line: Line { origin, direction: unit(minus(target, origin)) }, min, max }
}

/// Draws a line in the plane of a face, or one rounding beside it. The direction has one or two
/// zeros of either sign.
pub(super) fn in_slab(draws: &mut Draws) -> Question {
    let (min, max) = corners(draws);
    let (axis, is_max) = (draws.index(3), draws.sign() > 0.0);
    let mut origin = draws.point(8.0);
    origin[axis] = beside(draws, if is_max { max[axis] } else { min[axis] });
    let target: [f64; 3] =
        std::array::from_fn(|n| min[n] + draws.between(-0.2, 1.2) * (max[n] - min[n]));
    let mut direction = minus(target, origin);
    direction[axis] = 0.0 * draws.sign();
    if draws.sign() > 0.0 {
        let other = (axis + 1) % 3;
        direction[other] = 0.0 * draws.sign();
        origin[other] = target[other];
    }
    Question::Cuboid { line: Line { origin, direction: unit(direction) }, min, max }
}

/// Draws a line towards a point of an edge.
pub(super) fn at_edge(draws: &mut Draws) -> Question {
    let (min, max) = corners(draws);
    let mut target: [f64; 3] =
        std::array::from_fn(|n| if draws.sign() > 0.0 { max[n] } else { min[n] });
    let free = draws.index(3);
    target[free] = draws.between(min[free], max[free]);
    let origin = draws.point(8.0);
    Question::Cuboid { line: Line { origin, direction: unit(minus(target, origin)) }, min, max }
}

/// Draws a box and a line, a million units from the origin.
pub(super) fn cuboid_offset(draws: &mut Draws) -> Question {
    let Question::Cuboid { line, min, max } = cuboid(draws) else {
        unreachable!("a box was drawn")
    };
    let by = draws.direction().map(|x| x * 1e6);
    let line = Line { origin: along(line.origin, by, 1.0), ..line };
    Question::Cuboid { line, min: along(min, by, 1.0), max: along(max, by, 1.0) }
}

fn line_to(draws: &mut Draws, target: [f64; 3]) -> Line {
    let origin = draws.point(5.0);
    Line { origin, direction: unit(minus(target, origin)) }
}

/// Draws a point on the axis or around it, for a surface of radius 1 and height 1.
fn around(draws: &mut Draws) -> [f64; 3] {
    [draws.between(-1.2, 1.2), draws.between(-1.2, 1.2), draws.between(-0.1, 1.1)]
}

pub(super) fn cylinder(draws: &mut Draws) -> Question {
    let target = around(draws);
    let is_capped = draws.sign() > 0.0;
    Question::Round { line: line_to(draws, target), radii: [1.0; 2], ends: [0.0, 1.0], is_capped }
}

/// Draws a line whose direction is off the axis by 10⁻⁸ to a tenth.
pub(super) fn along_axis(draws: &mut Draws) -> Question {
    let (height, tilt) = (draws.power(0.0, 3.0), draws.power(-8.0, -1.0));
    let direction = along([0.0, 0.0, draws.sign()], draws.across([0.0, 0.0, 1.0]), tilt);
    let origin =
        [draws.between(-1.1, 1.1), draws.between(-1.1, 1.1), draws.between(-2.0, 2.0) * height];
    let is_capped = draws.sign() > 0.0;
    Question::Round {
        line: Line { origin, direction },
        radii: [1.0; 2],
        ends: [-height, height],
        is_capped,
    }
}

/// Draws a line towards the rim, which hits the side or the disc or neither.
pub(super) fn rim(draws: &mut Draws) -> Question {
    let around = draws.across([0.0, 0.0, 1.0]);
    let radii = [draws.power(-1.0, 0.5), draws.power(-1.0, 0.5)];
    let end = draws.index(2);
    let target = [around[0] * radii[end], around[1] * radii[end], end as f64];
    let is_capped = draws.sign() > 0.0;
    Question::Round { line: line_to(draws, target), radii, ends: [0.0, 1.0], is_capped }
}

/// Draws a line that is tangent to the side up to 10⁻¹⁶ to a tenth of the radius, on either side of
/// it.
pub(super) fn touching(draws: &mut Draws) -> Question {
    let radius = draws.power(-1.0, 1.0);
    let across = draws.across([0.0, 0.0, 1.0]);
    let gap = draws.sign() * draws.power(-16.0, -1.0);
    let target = [
        across[0] * radius * (1.0 + gap),
        across[1] * radius * (1.0 + gap),
        draws.between(0.0, 1.0),
    ];
    let direction = draws.across(across);
    let origin = along(target, direction, -draws.between(1.0, 10.0));
    Question::Round {
        line: Line { origin, direction },
        radii: [radius; 2],
        ends: [0.0, 1.0],
        is_capped: false,
    }
}

pub(super) fn cone(draws: &mut Draws) -> Question {
    let target = around(draws);
    let radii = if draws.sign() > 0.0 { [0.0, 1.0] } else { [1.0, draws.between(0.0, 0.9)] };
    let is_capped = draws.sign() > 0.0;
    Question::Round { line: line_to(draws, target), radii, ends: [0.0, 1.0], is_capped }
}

/// Draws a line whose direction is off a straight line of the side by 10⁻¹² to a tenth.
pub(super) fn along_side(draws: &mut Draws) -> Question {
    let side = draws.across([0.0, 0.0, 1.0]);
    let tilt = draws.sign() * draws.power(-12.0, -1.0);
    let direction = along([side[0], side[1], 1.0], draws.direction(), tilt);
    let target = [draws.between(-1.0, 1.0), draws.between(-1.0, 1.0), draws.between(0.1, 0.9)];
    let origin = along(target, direction, -draws.between(0.0, 5.0));
    Question::Round {
        line: Line { origin, direction },
        radii: [0.0, 1.0],
        ends: [0.0, 1.0],
        is_capped: false,
    }
}

/// Draws a line along a straight line of the side, or with components one rounding beside it.
pub(super) fn on_side(draws: &mut Draws) -> Question {
    let around = draws.across([0.0, 0.0, 1.0]);
    let side = [around[0], around[1], 1.0];
    let origin = side.map(|x| x * if draws.sign() > 0.0 { -1.0 } else { 0.25 });
    let origin = origin.map(|x| beside(draws, x));
    let direction = side.map(|x| beside(draws, x));
    Question::Round {
        line: Line { origin, direction },
        radii: [0.0, 1.0],
        ends: [0.0, 1.0],
        is_capped: false,
    }
}

/// Returns `x` or one of its neighbours.
fn beside(draws: &mut Draws, x: f64) -> f64 {
    [x, x.next_up(), x.next_down()][draws.index(3)]
}

/// Draws a cylinder that is a hundred to 10⁸ of its radii away.
pub(super) fn cylinder_far(draws: &mut Draws) -> Question {
    far(draws, |_| [1.0; 2])
}

/// Draws a cone that is a hundred to 10⁸ of its radii away.
pub(super) fn cone_far(draws: &mut Draws) -> Question {
    far(draws, |draws| [draws.between(0.2, 0.8), 1.0])
}

fn far(draws: &mut Draws, radii: fn(&mut Draws) -> [f64; 2]) -> Question {
    let (size, distance, direction) =
        (draws.power(-1.0, 1.0), draws.power(2.0, 8.0), draws.direction());
    let origin = along(around(draws), direction, -distance).map(|x| x * size);
    Question::Round {
        line: Line { origin, direction },
        radii: radii(draws).map(|r| r * size),
        ends: [0.0, size],
        is_capped: draws.sign() > 0.0,
    }
}

/// Draws a line towards the tip, off by up to a thousandth of its height.
pub(super) fn tip(draws: &mut Draws) -> Question {
    let off = draws.power(-16.0, -3.0);
    let target = draws.point(1.0).map(|x| x * off);
    Question::Round {
        line: line_to(draws, target),
        radii: [0.0, 1.0],
        ends: [0.0, 1.0],
        is_capped: true,
    }
}
