//! The triangle in two words. [rule 16] [rule 17]

use super::line::{Line, coordinates, double, times};
use crate::numbers::real::{Real, exponent};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;

/// The exponent that the greatest coordinate is scaled to. Products of three stay within what
/// Dekker's product can take, and so do corners 2^1000 times nearer to the ray.
const ROOM: i32 = 300;

/// A corner as seen along the ray, moved and sheared, times d_z; with the magnitudes of the terms
/// of x and y.
#[derive(Clone, Copy)]
struct Corner {
    x: Two,
    y: Two,
    /// The coordinate from the origin along the axis of the shear, exactly.
    z: Two,
    terms: [f64; 2],
}

/// Returns t, and the weights (α, β, γ), where the ray's line intersects the triangle. `tests_bc`
/// says whether the edge BC is tested.
///
/// `axes` are those of the shear. A triangle seen edge on is a miss.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn triangle<T: Real>(
    corners: &[Vec3<T>; 3],
    ray: &impl ExactRay,
    axes: [usize; 3],
    tests_bc: bool,
) -> Option<(T, Vec3<T>)> {
    let line = Line::new(ray, coordinates(*corners), ROOM)?;
    let [x, y, z] = axes.map(|axis| line.direction.along(axis));
    let [a, b, c] = corners.map(|corner| {
        let from = Two3::of(line.point(corner)) - line.origin;
        let [fx, fy, fz] = axes.map(|axis| from.along(axis));
        let (to_x, to_y) = ((fx * z, fz * x), (fy * z, fz * y));
        let terms = [to_x, to_y].map(|(p, q)| p.abs().f64() + q.abs().f64());
        Corner { x: to_x.0 - to_x.1, y: to_y.0 - to_y.1, z: fz, terms }
    });
    let (u, v, w) = (area(b, c), area(c, a), area(a, b));
    let tested = if tests_bc { [u, v, w] } else { [v, v, w] };
    let is_outside =
        tested.iter().any(|e| e.0 < Two::ZERO) && tested.iter().any(|e| e.0 > Two::ZERO);
    let sum = u.0 + v.0 + w.0;
    if is_outside || sum == Two::ZERO || !sum.f64().is_finite() {
        return None;
    }
    let along = u.0 * a.z + v.0 * b.z + w.0 * c.z;
    let terms =
        [(u, a), (v, b), (w, c)].map(|(e, corner)| (e.0.f64().abs() + e.1) * corner.z.f64().abs());
    let t = along.certain(terms[0] + terms[1] + terms[2]) / (sum * z);
    let weight = |e: (Two, f64)| T::of((e.0 / sum).f64());
    Some((line.t(t), Vec3::new(weight(u), weight(v), weight(w))))
}

/// Returns p × q, 0 where its sign is in doubt, and the greatest error of it in units of
/// [`DOUBT`](crate::numbers::two::DOUBT).
fn area(p: Corner, q: Corner) -> (Two, f64) {
    let of = |x: Two, y: Two, in_x: f64, in_y: f64| x.f64().abs() * in_y + in_x * y.f64().abs();
    let terms = of(p.x, q.y, p.terms[0], q.terms[1]) + of(q.x, p.y, q.terms[0], p.terms[1]);
    ((p.x * q.y - p.y * q.x).certain(terms), terms)
}

/// Returns (B − A) × (C − A), with 0 for components in doubt.
fn normal([a, b, c]: [Vec3<f64>; 3]) -> Two3 {
    let (p, q) = (Two3::difference(b, a), Two3::difference(c, a));
    let (n, p1, q1) = (p.cross(q), p.f64().abs(), q.f64().abs());
    Two3 {
        x: n.x.certain(p1.y * q1.z + p1.z * q1.y),
        y: n.y.certain(p1.z * q1.x + p1.x * q1.z),
        z: n.z.certain(p1.x * q1.y + p1.y * q1.x),
    }
}

/// Returns the outward direction of a triangle, its greatest component some 1; `None` where it has
/// no area.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn outwards<T: Real>(corners: &[Vec3<T>; 3]) -> Option<Vec3<T>> {
    let unit = ROOM - exponent(coordinates(*corners));
    let n = normal(corners.map(|corner| times(double(corner), unit))).f64();
    let greatest = coordinates([n]);
    let unit = times(n, -exponent(greatest));
    (greatest > 0.0).then(|| Vec3::new(T::of(unit.x), T::of(unit.y), T::of(unit.z)))
}

/// Returns (α, β, γ) of a point Q in the plane of ABC; NaN where ABC has no area.
#[cold]
#[inline(never)]
pub(in crate::shapes) fn barycentric<T: Real>(corners: [Vec3<T>; 3], q: Vec3<T>) -> Vec3<T> {
    let [a, b, c] = corners;
    let unit = ROOM / 2 - exponent(coordinates([a, b, c, q]));
    let [a, b, c, q] = [a, b, c, q].map(|corner| times(double(corner), unit));
    let n = normal([a, b, c]);
    let weight = |of: [Vec3<f64>; 3]| T::of((normal(of).dot(n) / n.dot(n)).f64());
    Vec3::new(weight([q, b, c]), weight([a, q, c]), weight([a, b, q]))
}
