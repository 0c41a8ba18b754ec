//! The shear of a ray, for the test of triangles. [rule 16]

use crate::lanes::TriangleRay;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::rays::ray::Ray;

/// The shear that turns a ray along an axis, computed once for all triangles.
///
/// Corners are moved so that the ray starts at the origin, then sheared so that it runs along one
/// axis: there the three edge tests are signs of areas in a plane. Two triangles that share an edge
/// compute the same area for it with opposite signs, so no ray slips between them (Woop, Benthin,
/// Wald 2013).
#[derive(Clone, Copy, Debug)]
pub struct Shear<T> {
    pub(super) axes: [usize; 3],
    pub(super) shear: [T; 2],
    pub(super) scale: T,
    /// The error bound of every area.
    pub(super) doubt: T,
}

impl<T: Real> Shear<T> {
    /// Returns the shear of `ray`, along the axis where its direction is longest. The error bound
    /// of the areas is infinite until [`Shear::within`] computes one.
    pub fn of(ray: &Ray<T>) -> Self {
        let d = ray.direction;
        let size = d.abs();
        let z =
            if size.x > size.y && size.x > size.z { 0 } else { 1 + usize::from(size.z >= size.y) };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        Self {
            axes: [x, y, z],
            shear: [d[x] / d[z], d[y] / d[z]],
            scale: T::ONE / d[z],
            doubt: T::INFINITY,
        }
    }

    /// Returns two axes across the ray, and the axis along which its direction is longest.
    #[inline(always)]
    pub(crate) fn axes(&self) -> [usize; 3] {
        self.axes
    }

    /// Returns how far the ray goes along the first two axes per step along the third.
    #[inline(always)]
    pub(crate) fn slopes(&self) -> [T; 2] {
        self.shear
    }

    /// Returns 1 over the component of the direction along the third axis.
    #[inline(always)]
    pub(crate) fn scale(&self) -> T {
        self.scale
    }

    /// Returns whether one error bound decides nearly everything: no coordinate, product or
    /// quotient is near the limits of the number range.
    #[inline(always)]
    pub(crate) fn is_bounded(&self) -> bool {
        self.doubt.is_finite()
    }

    /// Returns the shear of another ray from the same origin along the same axis.
    #[inline(always)]
    pub(crate) fn of_other(&self, slopes: [T; 2], scale: T) -> Self {
        Self { shear: slopes, scale, ..*self }
    }

    /// Returns the shear for triangles within `all`: one error bound for all of them decides nearly
    /// everything, see [`super::Triangle::intersect`].
    ///
    /// With f the greatest coordinate of a corner as seen from the origin, sheared ones are 2f at
    /// most and so their bound 48u 2f (2f + f).
    pub fn within(self, ray: &Ray<T>, all: Bounds<T>) -> Self {
        let far = (all.min - ray.origin).abs().greatest((all.max - ray.origin).abs()).max_element();
        let doubt = far * far * (T::of(144.0) * T::ULP);
        Self { doubt: if doubt.is_safe() { doubt } else { T::INFINITY }, ..self }
    }

    /// Returns the ray as the test of four triangles at once needs it.
    #[inline(always)]
    pub(crate) fn across(&self, ray: &Ray<T>) -> TriangleRay {
        let origin = [ray.origin.x.f64(), ray.origin.y.f64(), ray.origin.z.f64()];
        TriangleRay {
            origin,
            axes: self.axes,
            shear: self.shear.map(T::f64),
            doubt: self.doubt.f64(),
        }
    }
}
