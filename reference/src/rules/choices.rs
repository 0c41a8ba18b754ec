//! The decisions of the rules of light, each with its alternatives. The lecture's choice comes
//! first, known mistakes and the choices of other courses follow.

macro_rules! choices {
    ($($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $name { $($(#[$variant_doc])* $variant,)* }
        )*
    };
}

choices! {
    /// The angle that fov measures. [rule 1]
    Fov {
        /// The angle from bottom to top.
        Vertical,
        /// The angle from left to right.
        Horizontal,
    }
    /// The hit that wins among those of several objects. [rule 2]
    Nearest {
        /// The hit with the least t.
        LeastT,
        /// The hit on the first object in the list.
        FirstListed,
        /// The hit on the last object in the list.
        LastListed,
    }
    /// The specular lobe. [rule 3]
    Highlight {
        /// (N·H)₊^ns.
        Blinn,
        /// (R·V)₊^ns, R the mirrored direction to the light.
        Phong,
        /// (N·H)^ns, negative cosines included.
        Unclamped,
        /// (N·(L + V))₊^ns, the sum not normalised.
        HalfNotUnit,
        /// (N·H)₊, without the exponent.
        NoExponent,
        /// (N·L) (N·H)₊^ns.
        TimesCosine,
        /// No specular term.
        Absent,
    }
    /// The diffuse term. [rule 3]
    Diffuse {
        /// kd (N·L).
        Cosine,
        /// kd.
        Flat,
    }
    /// The facing factor B_j. [rule 3]
    Facing {
        /// 1 if N·L > 0, else 0.
        OnlyFront,
        /// 1 if N·L > 0, else 0, for the diffuse term; 1 for the specular term.
        SpecularFromBehind,
        /// Always 1, and N·L keeps its sign.
        Unclamped,
        /// Always 1, and |N·L| replaces N·L.
        BothSides,
        /// 1 with |N·L| if kt > 0 in some channel; otherwise 1 if N·L > 0, else 0.
        BothSidesOfTransmissive,
    }
    /// The number of times that ke is added. [rule 3]
    Emission {
        /// Once.
        Once,
        /// Once for each light.
        PerLight,
        /// Never.
        Absent,
    }
    /// The ambient term. [rule 3]
    Ambient {
        /// ka Ia_j for each light, regardless of shadows and attenuation.
        PerLight,
        /// ka Ia_j of the first light only.
        FirstLight,
        /// ka I_j: the light's colour instead of its ambient colour.
        LightColour,
        /// S_j A_j ka Ia_j: no ambient term in shadow.
        Shadowed,
        /// No ambient term.
        Absent,
    }
    /// The attenuation A_j. [rule 4]
    Attenuation {
        /// min(1, 1/(a r² + b r + c)).
        Clamped,
        /// 1/(a r² + b r + c).
        Unclamped,
        /// 1.
        Absent,
        /// With a and c exchanged.
        Swapped,
        /// With r instead of r².
        NotSquared,
    }
    /// The end of a shadow ray. [rule 5]
    ShadowReach {
        /// At the light.
        Light,
        /// None: objects behind the light block it.
        Unbounded,
    }
    /// The effect of a transparent object on a shadow ray. [rule 6]
    Tint {
        /// kt at each crossing.
        PerCrossing,
        /// kt once for each object.
        PerObject,
        /// kt of the first crossing only; further surfaces are ignored.
        FirstCrossing,
        /// All light passes.
        Clear,
        /// No light passes.
        Opaque,
    }
    /// The reflected direction. [rule 7]
    Mirror {
        /// d − 2 (d·N) N.
        Lecture,
        /// 2 (d·N) N − d, the opposite direction.
        Backwards,
        /// d − (d·N) N.
        Tangential,
    }
    /// The weight of the reflected ray. [rule 7]
    MirrorWeight {
        /// kr.
        Kr,
        /// 1.
        One,
        /// kr outside an object; no reflected ray inside.
        OnlyOutside,
    }
    /// The weight of the transmitted ray. [rule 8]
    TransmitWeight {
        /// kt.
        Kt,
        /// 1.
        One,
        /// 1 − kr.
        OneMinusKr,
    }
    /// The transmitted direction. [rule 8]
    Bend {
        /// Bent with the ratio η_i / η_t.
        Snell,
        /// Bent with the ratio η_t / η_i.
        Inverted,
        /// Not bent.
        Straight,
    }
    /// The indices of a ray that leaves an object. [rule 9]
    Leaving {
        /// Exchanged with respect to entering.
        Swapped,
        /// Equal to the indices on entering.
        AsEntering,
    }
    /// The result beyond the critical angle. [rule 10]
    TotalReflection {
        /// The reflected ray only.
        ReflectOnly,
        /// A transmitted ray that goes straight on.
        Straight,
        /// A transmitted ray along the surface: the root of a negative number is taken as 0.
        Grazing,
        /// No ray, not even the reflected one.
        Black,
    }
    /// The uses for which the outward normal is negated inside an object. [rule 11]
    Turning {
        /// All uses.
        Everywhere,
        /// No use.
        Nowhere,
        /// Reflection and refraction, but not shading.
        NotShading,
    }
    /// The depths at which a ray spawns further rays. [rule 13]
    Depth {
        /// depth < max_depth.
        Less,
        /// depth ≤ max_depth, but never at max_depth 0.
        OneMore,
        /// depth ≤ max_depth.
        LessOrEqual,
        /// depth + 1 < max_depth.
        OneLess,
    }
    /// The weights at which a path ends early. [rule 13]
    Cutoff {
        /// Every channel is below the threshold.
        AllChannels,
        /// Some channel is below the threshold.
        AnyChannel,
        /// No weight ends a path.
        Absent,
        /// Every channel of the last surface's coefficient is below the threshold, instead of the
        /// product along the path.
        LastOnly,
    }
    /// The root of the sphere's quadratic that counts. [rule 14]
    SphereRoots {
        /// The nearest one in the ray's interval.
        NearThenFar,
        /// The near root only: from inside, nothing is hit.
        NearOnly,
        /// The far root before the near one.
        FarFirst,
        /// The nearest one in the interval, computed as if d·d were 1.
        UnitDirection,
    }
    /// The sphere's normal. [rule 14]
    SphereNormal {
        /// Outwards from the sphere's centre.
        FromCentre,
        /// Outwards from the origin, regardless of the centre.
        FromOrigin,
        /// Inwards.
        Inwards,
    }
    /// The equation and the visible side of a plane. [rule 15]
    PlaneSide {
        /// N·X = k, visible from both sides.
        Both,
        /// N·X = −k.
        NegatedK,
        /// N·X = k, visible from the side of its normal only.
        FrontOnly,
    }
    /// The extent of the square. [rule 15]
    SquareSize {
        /// |x|, |y| ≤ 1/2.
        Half,
        /// |x|, |y| ≤ 1.
        One,
        /// x² + y² ≤ 1/4: a disc.
        Disc,
    }
    /// The intersection with the box that counts. [rule 15]
    BoxRoots {
        /// The nearest one in the ray's interval.
        NearThenFar,
        /// The near one only: from inside, nothing is hit.
        NearOnly,
    }
    /// The triangle test. [rule 16]
    TriangleTest {
        /// Visible from both sides, all three edges tested.
        Full,
        /// Visible from the front only.
        FrontOnly,
        /// The edge BC is not tested: an unbounded parallelogram.
        TwoEdges,
    }
    /// The geometric normal of a triangle. [rule 16]
    TriangleNormal {
        /// Along (B − A) × (C − A).
        Right,
        /// Along (C − A) × (B − A).
        Left,
    }
    /// The weights of a triangle's vertices. [rule 17]
    Weights {
        /// α, β, γ for A, B, C.
        Lecture,
        /// β and γ exchanged.
        Swapped,
        /// Each vertex has the weight of its neighbour.
        Rotated,
    }
    /// The normal at a point of a smooth triangle. [rule 18]
    Interpolation {
        /// The interpolated normal, normalised.
        Unit,
        /// The interpolated normal, not normalised.
        NotUnit,
        /// The geometric normal of the triangle.
        Absent,
        /// The normal of the nearest vertex.
        NearestVertex,
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
