//! Plane, square and box in two words: quotients are compared with the denominators multiplied out.
//! [rule 15]

use super::line::{Line, coordinates, double, times};
use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;

/// The exponent that the greatest coordinate is scaled to. A product of two stays within what
/// Dekker's product can take.
const ROOM: i32 = 300;

/// Returns t = (k − N·P) / N·d of the plane with these N and k; `None` for a parallel ray.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn plane<T: Real>(normal: &Vec3<T>, k: T, ray: &impl ExactRay) -> Option<T> {
    let of_normal = -exponent(coordinates([*normal])); // scales N to some 1
    let line = Line::new(ray, scaled(k.f64(), of_normal), ROOM)?.stretched(2 * ROOM);
    // N and d are scaled up, so that products of two small components keep their digits.
    let n = times(double(*normal), of_normal + ROOM);
    let k = scaled(k.f64(), of_normal + ROOM + line.lengths);
    let dot = |v: Two3| (Two3::of(n).dot(v), n.abs().dot(v.f64().abs()));
    let (slope, slopes) = dot(line.direction);
    let (along, terms) = dot(line.origin);
    let slope = slope.certain(slopes);
    (slope != Two::ZERO).then(|| line.t((Two::of(k) - along).certain(k.abs() + terms) / slope))
}

/// Returns whether the ray's line passes the plane of the square within `half` of both axes; false
/// for a ray along it.
pub(in crate::shapes) fn square<T: Real>(half: T, ray: &impl ExactRay) -> bool {
    square_at(half, ray).is_some()
}

/// Returns t where the ray's line passes the plane of the square within `half` of both axes; `None`
/// for a ray along it.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn square_at<T: Real>(half: T, ray: &impl ExactRay) -> Option<T> {
    let line = Line::new(ray, half.f64(), ROOM)?;
    let (o, d, half) = (line.origin, line.direction, Two::of(line.length(half)));
    let is_within = |o_x: Two, d_x: Two| {
        let (one, other) = (o_x * d.z, o.z * d_x);
        let reach = half * d.z.abs();
        let beyond = (one - other).abs() - reach;
        beyond.certain((one.abs() + other.abs() + reach).f64()) <= Two::ZERO
    };
    let is_hit = d.z != Two::ZERO && is_within(o.x, d.x) && is_within(o.y, d.y);
    is_hit.then(|| line.t(-o.z / d.z))
}

/// The point where a line passes the plane of a face: t = `way` / `along`, the latter above 0.
#[derive(Clone, Copy)]
struct Passing {
    way: Two,
    along: Two,
    part: u32,
}

impl Passing {
    /// Returns whether this point comes later on the line; false where the order is in doubt.
    fn is_after(&self, other: &Self) -> bool {
        let (here, there) = (self.way * other.along, other.way * self.along);
        (here - there).certain((here.abs() + there.abs()).f64()) > Two::ZERO
    }
}

/// Returns where the ray's line enters the box between these corners, and where it leaves: t and
/// the face. `None` for a miss.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn cuboid<T: Real>(
    least: &Vec3<T>,
    most: &Vec3<T>,
    ray: &impl ExactRay,
) -> Option<[(T, u32); 2]> {
    let line = Line::new(ray, coordinates([*least, *most]), ROOM)?;
    let (min, max) = (line.point(*least), line.point(*most));
    let (mut enter, mut leave): (Option<Passing>, Option<Passing>) = (None, None);
    for axis in 0..3 {
        let (from, along) = (line.origin.along(axis), line.direction.along(axis));
        let way = |face: Vec3<f64>| {
            let way = Two::of(face[axis]) - from;
            way.certain(face[axis].abs() + from.f64().abs())
        };
        if along == Two::ZERO {
            if way(min) > Two::ZERO || way(max) < Two::ZERO {
                return None;
            }
            continue;
        }
        let passing = |face: Vec3<f64>, is_max: bool| Passing {
            way: if along > Two::ZERO { way(face) } else { -way(face) },
            along: along.abs(),
            part: 2 * axis as u32 + u32::from(is_max),
        };
        let (lower, upper) = (passing(min, false), passing(max, true));
        let (first, last) = if along > Two::ZERO { (lower, upper) } else { (upper, lower) };
        enter = if enter.is_none_or(|enter| first.is_after(&enter)) { Some(first) } else { enter };
        leave = if leave.is_none_or(|leave| leave.is_after(&last)) { Some(last) } else { leave };
    }
    let (enter, leave) = (enter?, leave?);
    let at = |passing: Passing| (line.t(passing.way / passing.along), passing.part);
    (!enter.is_after(&leave)).then(|| [at(enter), at(leave)])
}
