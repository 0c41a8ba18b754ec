//! What rays can be known to miss without a search. It is found once for a scene.

use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::shapes::Solid;
use crate::world::mesh::Mesh;
use crate::world::object::{Object, ObjectShape};

/// The ball around all transparent objects.
///
/// A shadow ray that misses the ball crosses no transparent object, so that the first opaque object
/// that it hits decides about it. [rule 6]
///
/// **No ball hides a crossing.** The test of an object loses up to k = 512 ULP · loss of the
/// greatest coordinate involved, twice what trees allow for ([`crate::bvh`]). That coordinate is at
/// most c + R + w, where c is the distance of the centre from the origin, R the radius, and w the
/// distance of the ray's start from the centre. The ball therefore grows to G = R + k (c + R) +
/// 2⁻¹⁰ R, and by k w. With (G + k w)² ≤ (1 + 2⁻¹⁰) G² + 1025 k² w², the term in w reduces w² in
/// the comparison. The rounding of the comparison itself is below 16 ULP of w².
#[derive(Clone, Copy, Debug)]
pub(crate) struct GlassBall<T> {
    centre: Vec3<T>,
    /// (1 + 2⁻¹⁰) G². It is −∞ without transparent objects, and ∞ where one has no bounds.
    radius_squared: T,
    /// The share of w² that is left for the comparison; at most 0 where the test is blind.
    kept: T,
}

impl<T: Real> GlassBall<T> {
    /// Returns the ball around the transparent ones of `objects`, whose tests lose `loss` times as
    /// much as they would in world space.
    pub(crate) fn of<'a>(
        transparent: impl Iterator<Item = &'a Object<T>>,
        meshes: &[Mesh<T>],
        loss: T,
    ) -> Self {
        let (mut all, mut is_empty) = (Bounds::empty(), true);
        for object in transparent {
            let Some(bounds) = object.bounds(meshes) else { return Self::with(T::INFINITY) };
            (all, is_empty) = (all.join(bounds), false);
        }
        if is_empty {
            return Self::with(-T::INFINITY);
        }
        let centre = all.middle();
        let radius = (all.max - centre).length();
        let k = T::of(512.0) * T::ULP * loss;
        let grown = radius * T::of(1.0 + 1.0 / 1024.0) + k * (centre.length() + radius);
        Self {
            centre,
            radius_squared: grown * grown * T::of(1.0 + 1.0 / 1024.0),
            kept: T::ONE - T::of(16.0) * T::ULP - T::of(1025.0) * k * k,
        }
    }

    fn with(radius_squared: T) -> Self {
        Self { centre: Vec3::ZERO, radius_squared, kept: T::ONE }
    }

    /// Returns whether a transparent object may lie on the line of the ray, at t > 0.
    ///
    /// The squared distance of the centre from a ray with start O and direction d is w² − b²/d²,
    /// with b the greater of 0 and (C − O)·d. A number that is not finite gives `true`.
    #[inline(always)]
    pub(crate) fn may_be_on(&self, ray: &Ray<T>) -> bool {
        let (way, d) = (self.centre - ray.origin, ray.direction);
        let (d_squared, along) = (d.dot(d), way.dot(d).greatest(T::ZERO));
        let beside = way.dot(way) * self.kept * d_squared - along * along;
        !(beside.is_finite() && beside > self.radius_squared * d_squared)
    }
}

/// What a ray can still hit that leaves the only object of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Alone {
    /// Anything: there are other objects, or the object is not convex.
    No,
    /// Nothing, if the ray leaves to the outside of the convex object.
    Convex,
    /// Nothing, to whichever side the ray leaves the flat object.
    Flat,
}

/// The sine of the angle between a ray and a surface, in units of `ULP`, up to which rounding may
/// hide to which side the ray goes. Normals are right to a few hundred units.
const GRAZING: f64 = 4096.0;

impl Alone {
    /// Returns what a ray can hit that leaves one of `objects`. A mesh of several triangles counts
    /// as not convex, and so does a transformed object that is not a sphere.
    pub(crate) fn of<T: Real>(objects: &[Object<T>], meshes: &[Mesh<T>]) -> Self {
        let [only] = objects else { return Self::No };
        // Under a matrix, the side of a flat face is known only as exactly as its normal.
        if only.frame.is_some() && !matches!(only.shape, ObjectShape::Solid(Solid::Sphere(_))) {
            return Self::No;
        }
        match &only.shape {
            ObjectShape::Solid(Solid::Plane(_) | Solid::Square(_)) => Self::Flat,
            ObjectShape::Solid(Solid::Sphere(_) | Solid::Cuboid(_)) => Self::Convex,
            ObjectShape::Solid(Solid::Round(round)) if round.is_capped => Self::Convex,
            ObjectShape::Mesh(mesh) if meshes[*mesh].is_single() => Self::Flat,
            ObjectShape::Solid(Solid::Round(_)) | ObjectShape::Mesh(_) => Self::No,
        }
    }

    /// Returns whether a ray that leaves the object can only miss. It is certain of a ray that
    /// starts off the surface by the bound of its error, on the side to which it goes. `along` is
    /// the product of its unit direction and the normal.
    #[inline(always)]
    pub(crate) fn is_clear<T: Real>(self, goes_outside: bool, along: T) -> bool {
        let is_apart = along.abs() > T::of(GRAZING) * T::ULP; // false for NaN
        match self {
            Self::No => false,
            Self::Convex => goes_outside && is_apart,
            Self::Flat => is_apart,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of radius 1 about (0, 0, 5), with its box of half-diagonal √3.
    fn ball() -> GlassBall<f64> {
        let bounds = cases::Shape::Sphere { center: glam::DVec3::Z * 5.0, radius: 1.0 };
        let object = cases::Object {
            name: String::new(),
            material: 0,
            shape: bounds,
            world_from_object: glam::DAffine3::IDENTITY,
            object_from_world: glam::DAffine3::IDENTITY,
        };
        GlassBall::of([Object::of(&object)].iter(), &[], 1.0)
    }

    #[test]
    fn a_ray_is_clear_that_passes_the_ball_or_goes_away_from_it() {
        let ray = |x: f64, z: f64, d: [f64; 3]| {
            Ray::all_of(Vec3::new(x, 0.0, z), Vec3::new(d[0], d[1], d[2]))
        };
        for (ray, expected) in [
            (ray(0.0, 0.0, [0.0, 0.0, 1.0]), true),
            (ray(0.0, 0.0, [0.0, 0.0, 1e-3]), true),
            (ray(0.0, 0.0, [0.0, 0.0, -1.0]), false),
            (ray(0.0, 5.0, [1.0, 0.0, 0.0]), true),
            (ray(1.7, 0.0, [0.0, 0.0, 1.0]), true),
            (ray(1.74, 0.0, [0.0, 0.0, 1.0]), false),
            (ray(1.74, 0.0, [0.0, 0.0, 1e3]), false),
            (ray(f64::NAN, 0.0, [0.0, 0.0, 1.0]), true),
            (ray(1e200, 0.0, [0.0, 0.0, 1.0]), true),
        ] {
            assert_eq!(ball().may_be_on(&ray), expected, "{ray:?}");
        }
        let far = ray(0.0, 1e12, [0.0, 0.0, -1.0]);
        assert!(ball().may_be_on(&far));
        assert!(!GlassBall::<f64>::of([].iter(), &[], 1.0).may_be_on(&far));
    }
}
