//! The exact intersection of a line with a cylinder or a cone. The ends are compared with roots
//! that are never computed.

use super::evaluate::Found;
use super::exact::{Exact, Exact3, ExactLine, sign_with_root, unit};

/// A ray parameter (p + q √d) / r, with r > 0.
struct Surd {
    p: Exact,
    q: Exact,
    d: Exact,
    r: Exact,
}

impl Surd {
    /// Returns (p + q √d) / r, for an r of either sign, but not 0.
    fn of(p: Exact, q: Exact, d: Exact, r: Exact) -> Self {
        if r.sign() < 0 { Self { p: -&p, q: -&q, d, r: -&r } } else { Self { p, q, d, r } }
    }

    /// Returns the sign of x + y t, where t is this number.
    fn sign_of(&self, x: &Exact, y: &Exact) -> i32 {
        sign_with_root(&(&(x * &self.r) + &(y * &self.p)), &(y * &self.q), &self.d)
    }

    fn value(&self) -> Exact {
        let root = self.d.sqrt();
        let (p, q) = (&self.p, &(&self.q * &root));
        if p.sign() * q.sign() >= 0 {
            return (p + q).over(&self.r);
        }
        // The sum cancels. It equals (p² − q² d) / (p − q √d), whose numerator is exact.
        let product = &p.squared() - &(&self.q.squared() * &self.d);
        if product.sign() == 0 { Exact::ZERO } else { product.over(&(&(p - q) * &self.r)) }
    }
}

/// Returns the first hit on the surface with `radii` at the values `ends` of z. A hit on a rim
/// belongs to the side.
pub(super) fn round(
    line: &ExactLine,
    radii: &[Exact; 2],
    ends: &[Exact; 2],
    is_capped: bool,
) -> Option<Found<Exact>> {
    let side = side(line, radii, ends);
    let caps =
        (0..2).filter(|_| is_capped).filter_map(|n| Some((n, cap(line, &radii[n], &ends[n])?)));
    let cap = caps.reduce(
        |one, other| if &other.1.0 * &one.1.1 < &one.1.0 * &other.1.1 { other } else { one },
    );
    let cap_first = match (&side, &cap) {
        // The sign of t − rest/along. The divisor is positive.
        (Some(side), Some((_, (rest, along)))) => side.sign_of(&-rest, along) > 0,
        (None, Some(_)) => true,
        _ => false,
    };
    if let (true, Some((n, (rest, along)))) = (cap_first, cap) {
        let up = Exact::of(if n == 1 { 1.0 } else { -1.0 });
        return Some(Found::hit(rest.over(&along), [Exact::ZERO, Exact::ZERO, up]));
    }
    let root = side?;
    let is_tip = (0..2).any(|n| {
        radii[n].sign() == 0 && root.sign_of(&(&line.origin[2] - &ends[n]), &line.direction[2]) == 0
    });
    let t = root.value();
    let normal = if is_tip { tip(radii) } else { normal(&line.at(&t), radii, ends) };
    Some(Found::hit(t, normal))
}

/// Returns the t of a hit on the disc across the axis at `z`, as a quotient with a positive
/// divisor.
fn cap(line: &ExactLine, radius: &Exact, z: &Exact) -> Option<(Exact, Exact)> {
    let (o, d) = (&line.origin, &line.direction);
    let rest = z - &o[2];
    if rest.sign() * d[2].sign() <= 0 {
        return None;
    }
    let at = |n: usize| (&(&o[n] * &d[2]) + &(&rest * &d[n])).squared();
    let is_within = &at(0) + &at(1) <= (radius * &d[2]).squared();
    is_within.then(|| if d[2].sign() < 0 { (-&rest, -&d[2]) } else { (rest, d[2].clone()) })
}

/// Returns the height of the surface, and its radius at `z` multiplied by that height.
fn radius_at(z: &Exact, radii: &[Exact; 2], ends: &[Exact; 2]) -> (Exact, Exact) {
    let height = &ends[1] - &ends[0];
    (height, &(&radii[0] * &(&ends[1] - z)) + &(&radii[1] * &(z - &ends[0])))
}

/// Returns the first root of h²(x² + y²) = (h r(z))² with t > 0 between the ends. A line within the
/// side has none.
fn side(line: &ExactLine, radii: &[Exact; 2], ends: &[Exact; 2]) -> Option<Surd> {
    let (o, d) = (&line.origin, &line.direction);
    let (height, from) = radius_at(&o[2], radii, ends);
    let growth = &(&radii[1] - &radii[0]) * &d[2];
    let h2 = height.squared();
    let a = &(&h2 * &(&d[0].squared() + &d[1].squared())) - &growth.squared();
    let b = &(&from * &growth) - &(&h2 * &(&(&o[0] * &d[0]) + &(&o[1] * &d[1])));
    let c = &(&h2 * &(&o[0].squared() + &o[1].squared())) - &from.squared();
    let disc = &b.squared() - &(&a * &c);
    let one = Exact::of(1.0);
    let surd = |sign: f64| Surd::of(b.clone(), Exact::of(sign), disc.clone(), a.clone());
    let roots = match (a.sign(), b.sign(), disc.sign()) {
        (0, 0, _) | (_, _, -1) => vec![],
        // A line parallel to the side intersects it once.
        (0, ..) => vec![Surd::of(c, Exact::ZERO, Exact::ZERO, b.scaled(1))],
        (1, ..) => vec![surd(-1.0), surd(1.0)],
        _ => vec![surd(1.0), surd(-1.0)],
    };
    let is_on = |t: &Surd| {
        let is_ahead = t.sign_of(&Exact::ZERO, &one) > 0;
        is_ahead
            && t.sign_of(&(&o[2] - &ends[0]), &d[2]) >= 0
            && t.sign_of(&(&o[2] - &ends[1]), &d[2]) <= 0
    };
    roots.into_iter().find(is_on)
}

/// Returns the unit normal of the side at `point`.
fn normal(point: &Exact3, radii: &[Exact; 2], ends: &[Exact; 2]) -> Exact3 {
    let (height, radius) = radius_at(&point[2], radii, ends);
    let h2 = height.squared();
    unit(&[&point[0] * &h2, &point[1] * &h2, -&(&(&radii[1] - &radii[0]) * &radius)])
}

/// Returns the normal at the tip: along the axis, away from the cone.
fn tip(radii: &[Exact; 2]) -> Exact3 {
    let up = if radii[1] > radii[0] { -1.0 } else { 1.0 };
    [Exact::ZERO, Exact::ZERO, Exact::of(up)]
}

#[cfg(test)]
mod tests {
    use super::super::oracle::right;
    use super::super::question::{Line, Question};

    fn check(
        radii: [f64; 2],
        is_capped: bool,
        [origin, direction]: [[f64; 3]; 2],
        expected: Option<(f64, [f64; 3])>,
    ) {
        let question = Question::Round {
            line: Line { origin, direction },
            radii,
            ends: [0.0, 1.0],
            is_capped,
        };
        let found = right(&question).map(|found| {
            let normal = found.vector.expect("a normal");
            (found.t.expect("a parameter").f64(), normal.map(|x| x.f64()))
        });
        assert_eq!(found, expected, "{question:?}");
    }

    #[test]
    fn sides_rims_and_tips() {
        let along_x = [[-5.0, 0.0, 0.5], [1.0, 0.0, 0.0]];
        check([1.0, 1.0], false, along_x, Some((4.0, [-1.0, 0.0, 0.0])));
        check([1.0, 1.0], false, [[-5.0, 1.0, 0.5], [1.0, 0.0, 0.0]], Some((5.0, [0.0, 1.0, 0.0])));
        check([1.0, 1.0], false, [[-5.0, 1.0f64.next_up(), 0.5], [1.0, 0.0, 0.0]], None);
        check(
            [1.0, 1.0],
            false,
            [[-5.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
            Some((4.0, [-1.0, 0.0, 0.0])),
        );
        check([1.0, 1.0], false, [[-5.0, 0.0, 1.0f64.next_up()], [1.0, 0.0, 0.0]], None);
        check([1.0, 1.0], true, [[0.5, 0.0, 3.0], [0.0, 0.0, -1.0]], Some((2.0, [0.0, 0.0, 1.0])));
        check([1.0, 1.0], true, [[1.0, 0.0, -1.0], [0.0, 0.0, 1.0]], Some((1.0, [0.0, 0.0, -1.0])));
        // A hit on the rim belongs to the side.
        check([1.0, 1.0], true, [[2.0, 0.0, 2.0], [-1.0, 0.0, -1.0]], Some((1.0, [1.0, 0.0, 0.0])));
        // A cone whose tip points down to the origin.
        check([0.0, 1.0], false, [[0.5, 0.0, 0.0], [1.0, 0.0, 1.0]], None);
        check(
            [0.0, 1.0],
            false,
            [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
            Some((1.0, [0.0, 0.0, -1.0])),
        );
        check([0.0, 1.0], false, [[1.0, 0.0, 0.0], [-1.0, 0.0, 1.0]], {
            let half = std::f64::consts::FRAC_1_SQRT_2;
            Some((0.5, [half, 0.0, -half]))
        });
    }
}
