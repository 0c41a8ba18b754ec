//! Bare shapes in object space: where a ray meets them, and the outward normal there. They know no
//! materials.

mod cuboid;
mod meeting;
mod place;
mod plane;
mod round;
mod settle;
mod sphere;
mod square;
mod triangle;
mod triangle_formulas;

pub use cuboid::Cuboid;
pub use meeting::Meeting;
pub(crate) use place::on_triangle;
pub use plane::Plane;
pub use round::Round;
pub use sphere::Sphere;
pub use square::Square;
pub(crate) use triangle::{Look, misses_certainly};
pub use triangle::{Shear, Triangle, barycentric};

use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{Robustness, RuleSource};
use crate::vec3::Vec3;

/// A shape that is no mesh.
#[derive(Clone, Copy, Debug)]
pub enum Solid<T> {
    /// [rule 14]
    Sphere(Sphere<T>),
    /// [rule 15]
    Plane(Plane<T>),
    /// [rule 15]
    Square(Square),
    /// [rule 15]
    Cuboid(Cuboid<T>),
    /// A cylinder or a cone.
    Round(Round<T>),
}

impl<T: Real> Solid<T> {
    /// The first meeting in the ray's interval.
    #[inline(always)]
    pub fn meet<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        match self {
            Self::Sphere(sphere) => sphere.meet(rules, ray),
            Self::Plane(plane) => plane.meet(rules, ray),
            Self::Square(square) => square.meet(rules, ray),
            Self::Cuboid(cuboid) => cuboid.meet(rules, ray),
            Self::Round(round) => round.meet(rules, ray),
        }
    }

    /// Every crossing of the ray with it, told to `found` in order of t: `ray` in the space of the
    /// shape, its interval that of the ray as it was cast, from which beginnings behind a crossing
    /// are counted. [rule 6]
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
                        |rest| cuboid.first(rules, rest, ends).map(|met| met.t),
                        found,
                    );
                }
            }
            Self::Plane(_) | Self::Square(_) => {
                if let Some(met) = self.meet(rules, ray) {
                    found(met.t);
                }
            }
            Self::Round(round) => {
                let first = |rest: &Ray<T>| round.meet(rules, &rest.along(ray)).map(|met| met.t);
                cast.cross(rules, first, found);
            }
        }
    }

    /// The outward unit normal at `point`, where `part` was met. [rule 11]
    #[inline(always)]
    pub fn normal<R: RuleSource>(&self, rules: R, point: Vec3<T>, part: u32) -> Vec3<T> {
        match self {
            Self::Sphere(sphere) => sphere.normal(rules, point),
            Self::Plane(plane) => plane.normal,
            Self::Square(_) => Vec3::axis(2),
            Self::Cuboid(_) => Cuboid::normal(part),
            Self::Round(round) => round.normal(point, part),
        }
    }

    /// The least box around it; `None` for a plane, which has no end.
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
