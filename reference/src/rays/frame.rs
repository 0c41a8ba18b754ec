//! Transforms between world space and the space of an object. [rule 20]
//!
//! Rays are transformed into object space; points and normals are transformed back, each point with
//! a bound of its error.

use glam::DAffine3;

use crate::numbers::bounds::Bounds;
use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::{Affine, Vec3};
use crate::rays::moved::{MovedRay, WayToObject};
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{ObjectRay, Robustness, RuleSource, WorldNormal};

/// The error of a sum of four terms in units of `ULP`: four roundings, taken twice. This is γ(4) =
/// 4 u / (1 − 4 u) with room to spare.
const SUM_OF_FOUR: f64 = 4.0;
/// A transformed normal that keeps less than this share of its terms is computed again in two
/// words.
const CANCELS: f64 = 1.0 / 16.0;

/// The transforms between world space and object space, with a bound of their error.
#[derive(Clone, Copy, Debug)]
pub struct Frame<T> {
    /// M⁻¹ = (W, w), rounded. Rays are transformed by this matrix, so the mesh that they intersect
    /// is the one that it maps to the triangles. Hits on other shapes are decided for the exact
    /// inverse of M.
    pub object_from_world: Affine<T>,
    /// M = (A, t).
    pub world_from_object: Affine<T>,
    /// A⁻ᵀ, up to a positive factor.
    normals: Normals<T>,
    error: ErrorMap<T>,
    /// The exact inverse of A, with a bound of what W makes of a ray.
    way: WayToObject<T>,
}

/// The matrix for normals, row by row: sign(det A) times the cofactors of A, of which A⁻ᵀ is a
/// positive multiple.
///
/// Cofactors need no inverse, and so lose nothing where A is nearly singular.
#[derive(Clone, Copy, Debug)]
struct Normals<T> {
    rows: [Vec3<T>; 3],
    exact: [Two3; 3],
}

/// The error bound of a transformed point: |A| (e + B |q| + b) + c.
///
/// The point q of object space is known to within e. `size` is |A|, `factor` is B, `object` is b
/// and `world` is c.
#[derive(Clone, Copy, Debug)]
struct ErrorMap<T> {
    size: [Vec3<T>; 3],
    factor: [Vec3<T>; 3],
    object: Vec3<T>,
    world: Vec3<T>,
}

impl<T: Real> Frame<T> {
    /// Returns the frame of an object with this matrix and its inverse.
    pub fn of(world_from_object: &DAffine3, object_from_world: &DAffine3) -> Self {
        let rows = world_from_object.matrix3.transpose();
        let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(Vec3::of);
        Self::with(world_from_object, object_from_world, Normals::of(cofactors(rows)))
    }

    /// Returns the frame of an object of which only the inverse is known. W counts as exact: M is
    /// computed from it, and normals are transformed by its transpose.
    pub fn of_inverse(object_from_world: &DAffine3) -> Self {
        let columns = object_from_world.matrix3;
        let columns = [columns.x_axis, columns.y_axis, columns.z_axis]
            .map(|column| Two3::of(Vec3::of(column)));
        Self::with(&object_from_world.inverse(), object_from_world, Normals::of(columns))
    }

    fn with(
        world_from_object: &DAffine3,
        object_from_world: &DAffine3,
        normals: Normals<T>,
    ) -> Self {
        let (forth, back) = (Affine::of(world_from_object), Affine::of(object_from_world));
        let rest = rest(&forth, &back);
        Self {
            object_from_world: back,
            world_from_object: forth,
            normals,
            error: ErrorMap::of(&forth, &back, &rest),
            way: WayToObject::of(&forth, &back, &rest.rows),
        }
    }

    /// Returns the ray in object space. [rule 20]
    ///
    /// The direction keeps the length that the matrix gives it, so that t stays the same.
    #[inline(always)]
    pub fn ray_to_object<R: RuleSource>(
        rules: R,
        object_from_world: &Affine<T>,
        ray: &Ray<T>,
    ) -> Ray<T> {
        let direction = object_from_world.vector(ray.direction);
        let moved = Ray { origin: object_from_world.point(ray.origin), direction, ..*ray };
        match rules.get().object_ray {
            ObjectRay::AsIs => moved,
            ObjectRay::Renormalised => Ray { direction: direction.normalised(), ..moved },
            ObjectRay::Translated => {
                Ray { direction: object_from_world.point(ray.direction), ..moved }
            }
            ObjectRay::OriginNotMoved => Ray { origin: ray.origin, ..moved },
            ObjectRay::DirectionNotMoved => Ray { direction: ray.direction, ..moved },
            ObjectRay::OriginAsVector => {
                Ray { origin: object_from_world.vector(ray.origin), ..moved }
            }
            ObjectRay::EndLost => Ray { t_max: T::INFINITY, ..moved },
        }
    }

    /// Returns the ray in object space, with what its exact numbers follow from. [rule 20]
    ///
    /// The origin is W (O − t): where the object is small and far from the world's origin, W O + w
    /// would cancel.
    #[inline(always)]
    pub fn moved_ray<'a>(&'a self, ray: &'a Ray<T>) -> MovedRay<'a, T> {
        let back = &self.object_from_world;
        let origin = back.vector(ray.origin - self.world_from_object.translation);
        let direction = back.vector(ray.direction);
        MovedRay { ray: Ray { origin, direction, ..*ray }, in_world: ray, way: &self.way }
    }

    /// Returns A⁻ᵀ N′, normalised: the normal in world space. [rule 20]
    #[inline(always)]
    pub fn normal_to_world<R: RuleSource>(&self, rules: R, normal: Vec3<T>) -> Vec3<T> {
        match rules.get().world_normal {
            WorldNormal::InverseTranspose
                if rules.get().style.robustness == Robustness::Certified =>
            {
                self.normals.map(normal)
            }
            WorldNormal::InverseTranspose => self.object_from_world.transposed(normal).normalised(),
            WorldNormal::ByMatrix => self.world_from_object.vector(normal).normalised(),
            WorldNormal::ByInverse => self.object_from_world.vector(normal).normalised(),
            WorldNormal::NotUnit => self.object_from_world.transposed(normal),
            WorldNormal::Untransformed => normal,
            WorldNormal::ByTranspose => self.world_from_object.transposed(normal).normalised(),
            WorldNormal::AsPoint => self.world_from_object.point(normal).normalised(),
            WorldNormal::TurnedByMirror => {
                let [a, b, c] = self.object_from_world.rows;
                let mapped = self.object_from_world.transposed(normal).normalised();
                if a.dot(b.cross(c)) < T::ZERO { -mapped } else { mapped }
            }
        }
    }

    /// Returns a hit point of object space in world space: the point, its error bound and its
    /// normal.
    #[inline(always)]
    pub fn hit_point_to_world<R: RuleSource>(
        &self,
        rules: R,
        hit_point: &HitPoint<T>,
    ) -> HitPoint<T> {
        HitPoint {
            point: self.world_from_object.point(hit_point.point),
            error: self.error.of_point(hit_point.point, hit_point.error),
            n_geom: self.normal_to_world(rules, hit_point.n_geom),
        }
    }

    /// Returns a box in world space around all hits on what lies within `bounds` of object space.
    /// The box is padded by the error bound of the transforms.
    pub fn bounds_to_world(&self, bounds: Bounds<T>) -> Bounds<T> {
        let moved = bounds.moved(&self.world_from_object);
        let pad = self.error.of_point(bounds.min.abs().greatest(bounds.max.abs()), Vec3::ZERO);
        Bounds { min: moved.min - pad, max: moved.max + pad }
    }

    /// Returns the factor by which rounding errors grow on the way to object space and back. The
    /// factor is the greatest row sum of |A| |W|, at least 1.
    pub fn loss(&self) -> T {
        let back = sizes(&self.object_from_world);
        let through = apply(&self.error.size, apply(&back, Vec3::ONE));
        through.max_element().greatest(T::ONE)
    }
}

impl<T: Real> Normals<T> {
    fn of(exact: [Two3; 3]) -> Self {
        Self { rows: exact.map(|row| Vec3::of(row.f64().f64())), exact }
    }

    #[inline(always)]
    fn map(&self, normal: Vec3<T>) -> Vec3<T> {
        let mapped =
            Vec3::new(self.rows[0].dot(normal), self.rows[1].dot(normal), self.rows[2].dot(normal));
        let terms = apply(&self.rows.map(Vec3::abs), normal.abs());
        let is_sure = mapped.abs().max_element() > terms.max_element() * T::of(CANCELS);
        if is_sure { mapped.normalised() } else { self.map_exactly(normal) }
    }

    #[cold]
    #[inline(never)]
    fn map_exactly(&self, normal: Vec3<T>) -> Vec3<T> {
        let normal = normal.f64();
        let normal = Two3::of(Vec3::of(normal));
        let [x, y, z] = self.exact.map(|row| row.dot(normal).f64());
        let most = exponent(x.abs().max(y.abs()).max(z.abs()));
        let [x, y, z] = [x, y, z].map(|x| T::of(scaled(x, -most)));
        Vec3::new(x, y, z).normalised()
    }
}

/// Returns sign(det A) times the cofactors of A, all of them scaled by one power of two.
fn cofactors(rows: [Vec3<f64>; 3]) -> [Two3; 3] {
    let most = rows.iter().map(|row| row.abs().max_element()).fold(0.0, f64::max);
    let [a, b, c] = rows.map(|row| Two3::of(row.map(|x| scaled(x, -exponent(most)))));
    let of_a = b.cross(c);
    let det = a.dot(of_a);
    let all = [of_a, c.cross(a), a.cross(b)];
    // Cofactors have as wide a range as the matrix squared, so the greatest is scaled to some 1.
    let most = all.iter().map(|row| row.f64().abs().max_element()).fold(0.0, f64::max);
    let sign = Two::of(scaled(if det < Two::ZERO { -1.0 } else { 1.0 }, -exponent(most)));
    all.map(|row| row * sign)
}

impl<T: Real> ErrorMap<T> {
    /// Returns the error bound of a map, given the inverse that rays are transformed by. The bound
    /// has three parts:
    ///
    /// - q is transformed to world space by a sum of four: γ(4) (|A| |q| + |t|).
    /// - Rays are transformed by W, which is not quite the inverse: W A = I + R and W t + w = r, so
    ///   that the surface lies R q + r beside q.
    /// - A ray from p, the image of q, is transformed back by a sum of four: γ(4) (|W| |p| + |w|),
    ///   where |p| ≤ |A| |q| + |t|.
    fn of(forth: &Affine<T>, back: &Affine<T>, rest: &Affine<T>) -> Self {
        let unit = T::of(SUM_OF_FOUR) * T::ULP;
        let (size, back_size) = (sizes(forth), sizes(back));
        let column = |axis: usize| Vec3::new(size[0][axis], size[1][axis], size[2][axis]);
        let row = |i: usize| {
            let through = Vec3::new(
                back_size[i].dot(column(0)),
                back_size[i].dot(column(1)),
                back_size[i].dot(column(2)),
            );
            rest.rows[i].abs() + (through + Vec3::axis(i)) * unit
        };
        let way_back = apply(&back_size, forth.translation.abs()) + back.translation.abs();
        Self {
            size,
            factor: [row(0), row(1), row(2)],
            object: rest.translation.abs() + way_back * unit,
            world: forth.translation.abs() * unit,
        }
    }

    #[inline(always)]
    fn of_point(&self, q: Vec3<T>, error: Vec3<T>) -> Vec3<T> {
        apply(&self.size, error + apply(&self.factor, q.abs()) + self.object) + self.world
    }
}

/// Returns the magnitudes of W A − I and W t + w, rounded up.
fn rest<T: Real>(forth: &Affine<T>, back: &Affine<T>) -> Affine<T> {
    let two = |v: Vec3<T>| Two3::of(Vec3::of(v.f64()));
    let column =
        |axis: usize| Vec3::new(forth.rows[0][axis], forth.rows[1][axis], forth.rows[2][axis]);
    let up = |x: Two| T::of(x.abs().f64()) * (T::ONE + T::TWO * T::ULP);
    let row = |i: usize| {
        let entry = |j: usize| {
            let of_unit = if i == j { Two::of(1.0) } else { Two::ZERO };
            up(two(back.rows[i]).dot(two(column(j))) - of_unit)
        };
        Vec3::new(entry(0), entry(1), entry(2))
    };
    let moved = |i: usize| {
        up(two(back.rows[i]).dot(two(forth.translation)) + Two::of(back.translation[i].f64()))
    };
    Affine { rows: [row(0), row(1), row(2)], translation: Vec3::new(moved(0), moved(1), moved(2)) }
}

fn sizes<T: Real>(map: &Affine<T>) -> [Vec3<T>; 3] {
    map.rows.map(Vec3::abs)
}

/// Returns the product of a matrix, given row by row, and a vector.
#[inline(always)]
fn apply<T: Real>(rows: &[Vec3<T>; 3], v: Vec3<T>) -> Vec3<T> {
    Vec3::new(rows[0].dot(v), rows[1].dot(v), rows[2].dot(v))
}
