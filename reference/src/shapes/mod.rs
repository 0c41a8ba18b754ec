//! Shapes in object space: where a ray intersects them, and the outward normal there. They know no
//! materials.

mod clear;
mod cuboid;
mod hit;
mod moved;
mod place;
mod plane;
mod round;
mod settle;
mod shear;
mod sphere;
mod square;
mod triangle;
mod triangle_formulas;

pub use cuboid::Cuboid;
pub use hit::ShapeHit;
pub(crate) use moved::is_exact;
pub(crate) use place::on_triangle;
pub use plane::Plane;
pub use round::Round;
pub use shear::Shear;
pub use sphere::Sphere;
pub use square::Square;
pub(crate) use triangle::{FirstStep, misses_certainly};
pub use triangle::{Triangle, barycentric};

use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{Robustness, RuleSource};

/// A shape other than a mesh, in object space.
#[derive(Clone, Copy, Debug)]
pub enum Solid<T> {
    /// A sphere. [rule 14]
    Sphere(Sphere<T>),
    /// A plane. [rule 15]
    Plane(Plane<T>),
    /// The unit square. [rule 15]
    Square(Square),
    /// An axis-aligned box. [rule 15]
    Cuboid(Cuboid<T>),
    /// A cylinder or a cone.
    Round(Round<T>),
}

impl<T: Real> Solid<T> {
    /// Returns the first hit in the interval of `ray`, which is in object space; `None` for a miss.
    /// t is in units of the length of the direction.
    #[inline(always)]
    pub fn intersect<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        match self {
            Self::Sphere(sphere) => sphere.intersect(rules, ray),
            Self::Plane(plane) => plane.intersect(rules, ray),
            Self::Square(square) => square.intersect(rules, ray),
            Self::Cuboid(cuboid) => cuboid.intersect(rules, ray),
            Self::Round(round) => round.intersect(rules, ray),
        }
    }

    /// Calls `found` with t of every crossing of the ray with the surface, in ascending order.
    /// [rule 6]
    ///
    /// `ray` is in the space of the shape, with the interval of `cast`. `cast` is the ray as it was
    /// cast, in world space: from it follows where the rest of the ray behind a crossing begins.
    #[inline(always)]
    pub fn crossings<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        cast: &Ray<T>,
        mut found: impl FnMut(T),
    ) {
        match self {
            Self::Sphere(sphere) => {
                if let Some(roots) = sphere.roots(rules, ray) {
                    cast.cross(rules, |rest| sphere.first(rules, rest, roots), found);
                }
            }
            Self::Cuboid(cuboid) => {
                if let Some(ends) =
                    cuboid.cut(ray, rules.get().style.robustness == Robustness::Certified)
                {
                    cast.cross(
                        rules,
                        |rest| cuboid.first(rules, rest, ends).map(|hit| hit.t),
                        found,
                    );
                }
            }
            Self::Plane(_) | Self::Square(_) => {
                if let Some(hit) = self.intersect(rules, ray) {
                    found(hit.t);
                }
            }
            Self::Round(round) => {
                let first =
                    |rest: &Ray<T>| round.intersect(rules, &rest.along(ray)).map(|hit| hit.t);
                cast.cross(rules, first, found);
            }
        }
    }

    /// Returns the outward unit normal, in object space, at `point` of the part that was hit.
    /// [rule 11]
    #[inline(always)]
    pub fn normal<R: RuleSource>(&self, rules: R, point: Vec3<T>, part: u32) -> Vec3<T> {
        match self {
            Self::Sphere(sphere) => sphere.normal(rules, point),
            Self::Plane(plane) => plane.normal,
            Self::Square(_) => Square::normal(rules),
            Self::Cuboid(_) => Cuboid::normal_at(rules, point, part),
            Self::Round(round) => round.normal(rules, point, part),
        }
    }

    /// Returns the least box around the shape, in object space; `None` for a plane, which has no
    /// bounds.
    pub fn bounds(&self) -> Option<Bounds<T>> {
        match self {
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Plane(_) => None,
            Self::Square(_) => Some(Square::bounds()),
            Self::Cuboid(cuboid) => Some(Bounds { min: cuboid.min, max: cuboid.max }),
            Self::Round(round) => Some(round.bounds()),
        }
    }
}
