//! Decisions on normals, transforms and the start of rays. [rule 19] to [rule 21]

choices! {
    /// The space in which normals are interpolated. [rule 20]
    InterpolatedIn {
        /// Object space.
        ObjectSpace,
        /// World space: each vertex normal is transformed and normalised before.
        WorldSpace,
    }
    /// The normal about which rays are reflected. [rule 19]
    ReflectBy {
        /// The interpolated normal, or the geometric one where R would enter the object.
        WithFallback,
        /// The interpolated normal.
        Interpolated,
        /// The geometric normal.
        Geometric,
    }
    /// The normal by which rays are refracted. [rule 19]
    RefractBy {
        /// The interpolated normal, or the geometric one where T would not cross the surface.
        WithFallback,
        /// The interpolated normal.
        Interpolated,
        /// The geometric normal.
        Geometric,
    }
    /// The normal that decides between inside and outside. [rule 19]
    InsideBy {
        /// The geometric normal.
        Geometric,
        /// The interpolated normal.
        Interpolated,
        /// None: every hit counts as one from outside.
        Never,
        /// The geometric normal, with the opposite result.
        Reversed,
    }
    /// The transform of a ray into object space. [rule 20]
    ObjectRay {
        /// The direction is transformed and not normalised.
        AsIs,
        /// The direction is normalised, and t is not corrected.
        Renormalised,
        /// The direction is transformed like a point.
        Translated,
        /// The origin is not transformed.
        OriginNotMoved,
        /// The direction is not transformed.
        DirectionNotMoved,
        /// The origin is transformed like a direction.
        OriginAsVector,
        /// The end of the ray is lost.
        EndLost,
    }
    /// The transform of a normal into world space. [rule 20]
    WorldNormal {
        /// A⁻ᵀ N′, normalised.
        InverseTranspose,
        /// A N′, normalised.
        ByMatrix,
        /// A⁻¹ N′, normalised.
        ByInverse,
        /// A⁻ᵀ N′, not normalised.
        NotUnit,
        /// N′, the normal in object space.
        Untransformed,
        /// Aᵀ N′, normalised.
        ByTranspose,
        /// A N′ + t, normalised.
        AsPoint,
        /// A⁻ᵀ N′, normalised, with the sign of det A.
        TurnedByMirror,
    }
}

/// RAY_EPSILON: the parameter that a ray must exceed before a hit counts. [rule 21]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Epsilon {
    /// [`RAY_EPSILON`](crate::numbers::real::Real::RAY_EPSILON).
    RayEpsilon,
    /// One value for both precisions.
    Fixed(f64),
    /// A mistaken value, which also applies in styles that need no epsilon.
    Mistaken(f64),
}
