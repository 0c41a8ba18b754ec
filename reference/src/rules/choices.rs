//! The decisions of the rules of light, each with its alternatives: the lecture's first, then what
//! else people write.

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
    /// Which angle fov is. [rule 1]
    Fov {
        /// From bottom to top.
        Vertical,
        /// From left to right.
        Horizontal,
    }
    /// Which of several hits is the answer. [rule 2]
    Nearest {
        /// The one of least t.
        LeastT,
        /// That of the first object in the list.
        FirstListed,
        /// That of the last object in the list.
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
        /// (N·H)₊.
        NoExponent,
        /// (N·L) (N·H)₊^ns.
        TimesCosine,
        /// None.
        Absent,
    }
    /// The diffuse term. [rule 3]
    Diffuse {
        /// kd (N·L).
        Cosine,
        /// kd.
        Flat,
    }
    /// B_j. [rule 3]
    Facing {
        /// 1 if N·L > 0, else 0.
        OnlyFront,
        /// The diffuse term is cut at N·L > 0, the specular one is not.
        SpecularFromBehind,
        /// Always 1, the cosine as it is.
        Unclamped,
        /// Always 1, the cosine by its amount.
        BothSides,
        /// The same where kt > 0 in some channel; elsewhere 1 if N·L > 0, else 0.
        BothSidesOfTransmissive,
    }
    /// How often ke counts. [rule 3]
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
        /// ka Ia_j for each light, whatever hides or weakens it.
        PerLight,
        /// That of the first light alone.
        FirstLight,
        /// ka I_j: the light's own colour in the place of its ambient one.
        LightColour,
        /// S_j A_j ka Ia_j: none in shadow.
        Shadowed,
        /// None.
        Absent,
    }
    /// A_j. [rule 4]
    Attenuation {
        /// min(1, 1/(a r² + b r + c)).
        Clamped,
        /// 1/(a r² + b r + c).
        Unclamped,
        /// 1.
        Absent,
        /// With a and c exchanged.
        Swapped,
        /// With r in the place of r².
        NotSquared,
    }
    /// How far a shadow ray goes. [rule 5]
    ShadowReach {
        /// To the light.
        Light,
        /// On and on.
        Unbounded,
    }
    /// What a transparent object does to a shadow. [rule 6]
    Tint {
        /// kt at each crossing.
        PerCrossing,
        /// kt once for each object.
        PerObject,
        /// kt of the first crossing, then nothing more.
        FirstCrossing,
        /// It lets all light through.
        Clear,
        /// It lets none through.
        Opaque,
    }
    /// The mirrored direction. [rule 7]
    Mirror {
        /// d − 2 (d·N) N.
        Lecture,
        /// 2 (d·N) N − d: back to where the ray came from.
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
        /// kr from outside, no ray from inside.
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
        /// By η_i / η_t.
        Snell,
        /// By η_t / η_i.
        Inverted,
        /// Not at all.
        Straight,
    }
    /// Indices on the way out. [rule 9]
    Leaving {
        /// Exchanged.
        Swapped,
        /// As on the way in.
        AsEntering,
    }
    /// What happens beyond the critical angle. [rule 10]
    TotalReflection {
        /// Reflection alone remains.
        ReflectOnly,
        /// The ray goes straight on.
        Straight,
        /// The ray leaves along the surface: the root of a negative number taken as 0.
        Grazing,
        /// No ray at all, the reflected one neither.
        Black,
    }
    /// Where the outward normal is turned on the way out. [rule 11]
    Turning {
        /// Everywhere.
        Everywhere,
        /// Nowhere.
        Nowhere,
        /// For refraction only: shaded by the outward normal.
        NotShading,
    }
    /// When a ray spawns more. [rule 13]
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
    /// The adaptive end of a path. [rule 13]
    Cutoff {
        /// Where every channel is below the threshold.
        AllChannels,
        /// Where some channel is.
        AnyChannel,
        /// Never.
        Absent,
        /// By the last surface's own coefficient, not by the product along the path.
        LastOnly,
    }
    /// Roots of the sphere. [rule 14]
    SphereRoots {
        /// The nearer that counts.
        NearThenFar,
        /// The nearer alone: nothing is hit from inside.
        NearOnly,
        /// The farther.
        FarFirst,
        /// As if d were a unit vector.
        UnitDirection,
    }
    /// The sphere's normal. [rule 14]
    SphereNormal {
        /// Outwards from its centre.
        FromCentre,
        /// Outwards from the origin, whatever the centre.
        FromOrigin,
        /// Inwards.
        Inwards,
    }
    /// The plane. [rule 15]
    PlaneSide {
        /// N·X = k, seen from both sides.
        Both,
        /// N·X = −k.
        NegatedK,
        /// Seen from the side of its normal only.
        FrontOnly,
    }
    /// The square. [rule 15]
    SquareSize {
        /// |x|, |y| ≤ 1/2.
        Half,
        /// |x|, |y| ≤ 1.
        One,
        /// x² + y² ≤ 1/4: a disc.
        Disc,
    }
    /// The box. [rule 15]
    BoxRoots {
        /// The nearer that counts.
        NearThenFar,
        /// The nearer alone: nothing is hit from inside.
        NearOnly,
    }
    /// Triangles. [rule 16]
    TriangleTest {
        /// Seen from both sides, all three edges tested.
        Full,
        /// Seen from the front only.
        FrontOnly,
        /// The edge BC is not tested: a parallelogram without end.
        TwoEdges,
    }
    /// The triangle's own normal. [rule 16]
    TriangleNormal {
        /// Along (B − A) × (C − A).
        Right,
        /// The other way.
        Left,
    }
    /// Weights of the vertices. [rule 17]
    Weights {
        /// α, β, γ for A, B, C.
        Lecture,
        /// β and γ exchanged.
        Swapped,
        /// Each vertex gets its neighbour's.
        Rotated,
    }
    /// The interpolated normal. [rule 18]
    Interpolation {
        /// Normalised.
        Unit,
        /// As it comes.
        NotUnit,
        /// The triangle's own in its place.
        Absent,
        /// The normal of the nearest vertex.
        NearestVertex,
    }
    /// Which normal reflects. [rule 19]
    ReflectBy {
        /// The interpolated one, or the geometric one where R would enter the object.
        WithFallback,
        /// The interpolated one.
        Interpolated,
        /// The geometric one.
        Geometric,
    }
    /// Which normal refracts. [rule 19]
    RefractBy {
        /// The interpolated one, or the geometric one where T would leave the object.
        WithFallback,
        /// The interpolated one.
        Interpolated,
        /// The geometric one.
        Geometric,
    }
    /// What tells inside from outside. [rule 19]
    InsideBy {
        /// The geometric normal.
        Geometric,
        /// The interpolated normal.
        Interpolated,
        /// Nothing: every hit is from outside.
        Never,
    }
    /// The ray in object space. [rule 20]
    ObjectRay {
        /// Its direction as the matrix makes it.
        AsIs,
        /// Its direction normalised, t not put right.
        Renormalised,
        /// Its direction moved as points are.
        Translated,
        /// Its origin not moved.
        OriginNotMoved,
    }
    /// The normal in world space. [rule 20]
    WorldNormal {
        /// A⁻ᵀ N′, normalised.
        InverseTranspose,
        /// A N′, normalised.
        ByMatrix,
        /// A⁻¹ N′, normalised.
        ByInverse,
        /// A⁻ᵀ N′ as it comes.
        NotUnit,
        /// N′.
        Untransformed,
    }
}

/// How far a ray must go before a hit counts, in styles that need to be told. [rule 21]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Epsilon {
    /// [`RAY_EPSILON`](crate::real::Real::RAY_EPSILON).
    RayEpsilon,
    /// This.
    Fixed(f64),
    /// This, by mistake: it counts even where the style needs no epsilon.
    Mistaken(f64),
}
