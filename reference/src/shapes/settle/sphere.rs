//! The sphere in two words. [rule 14]

use super::line::{Line, coordinates, double, greatest};
use crate::numbers::real::Real;
use crate::numbers::roots;
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::Vec3;
use crate::rays::moved::ExactRay;

/// The exponent that the greatest coordinate is scaled to. Squares of lengths stay well within what
/// Dekker's product can take, and so do those 2^500 times smaller.
const ROOM: i32 = 200;

/// Returns the power of a point with respect to a sphere, ‖point − center‖² − radius².
///
/// It is off by less than [`DOUBT`](crate::numbers::two::DOUBT) of the sum of both squares, which
/// must be in the range of `Real::SAFE`: nothing is scaled.
#[inline(never)]
pub(in crate::shapes) fn power<T: Real>(center: &Vec3<T>, radius: &T, point: &Vec3<T>) -> T {
    let from_center = Two3::difference(double(*point), double(*center));
    let radius = radius.f64();
    T::of((from_center.dot(from_center) - Two::product(radius, radius)).f64())
}

/// A sphere, and a ray's line.
pub(in crate::shapes) struct Ball {
    line: Line,
    from_center: Two3,
    direction: Two3,
    radius: f64,
}

impl Ball {
    /// Returns the sphere and the line of `ray`, in units of their own; `None` where the ray has no
    /// direction, or something is not finite.
    #[cold]
    #[inline(never)]
    pub(in crate::shapes) fn new<T: Real>(
        center: &Vec3<T>,
        radius: &T,
        ray: &impl ExactRay,
    ) -> Option<Self> {
        let size = greatest(&[coordinates([*center]), radius.f64()]);
        let line = Line::new(ray, size, ROOM)?;
        Some(Self {
            from_center: line.origin - Two3::of(line.point(*center)),
            direction: line.direction,
            radius: line.length(*radius),
            line,
        })
    }

    /// Returns both roots in ascending order, in units of this line; `None` where there are none.
    ///
    /// The discriminant is (d·d) r² − ‖f × d‖²: with the products of the cross product nearly
    /// exact, it keeps its digits however far the sphere is.
    fn roots(&self) -> Option<[Two; 2]> {
        let (f, d) = (self.from_center, self.direction);
        let (a, ff, rr) = (d.dot(d), f.dot(f), Two::product(self.radius, self.radius));
        let moment = f.cross(d);
        let (f1, d1, m) = (f.f64().abs(), d.f64().abs(), moment.f64().abs());
        let terms = Vec3::new(
            f1.y * d1.z + f1.z * d1.y,
            f1.z * d1.x + f1.x * d1.z,
            f1.x * d1.y + f1.y * d1.x,
        );
        let disc = (a * rr - moment.dot(moment)).certain((a * rr).f64() + 2.0 * m.dot(terms));
        roots::ascending(a, -f.dot(d), (ff - rr).certain((ff + rr).f64()), disc)
    }

    /// Returns both roots in ascending order, along the ray as given; `None` where the ray's line
    /// misses the sphere.
    #[cold]
    #[inline(never)]
    pub(in crate::shapes) fn ts<T: Real>(&self) -> Option<[T; 2]> {
        self.roots().map(|roots| roots.map(|t| self.line.t(t)))
    }

    /// Returns the outward direction at the root nearest to `t`, not normalised; `None` where there
    /// is no root, 0 where the sphere has no radius.
    #[cold]
    #[inline(never)]
    pub(in crate::shapes) fn outwards<T: Real>(&self, t: T) -> Option<Vec3<f64>> {
        let [first, last] = self.roots()?;
        let distance = |root: Two| (self.line.t::<T>(root) - t).abs();
        let root = if distance(last) < distance(first) { last } else { first };
        let out = self.from_center + self.direction * root;
        Some(if self.radius == 0.0 { Vec3::ZERO } else { out.f64() })
    }
}
