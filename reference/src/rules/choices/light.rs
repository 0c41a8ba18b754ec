//! Decisions on the light at a point. [rule 3] to [rule 6]

choices! {
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
        /// (N·(L + V)/2)₊^ns.
        HalfHalved,
        /// |N·H|^ns.
        Absolute,
        /// (N·H)₊^(4 ns).
        FourTimesExponent,
        /// (N·H)₊^(128 ns).
        Times128,
    }
    /// The factors of the specular lobe. [rule 3]
    HighlightColour {
        /// ks and the light that arrives.
        Ks,
        /// kd and the light that arrives.
        Kd,
        /// ks alone.
        Unlit,
    }
    /// The diffuse term. [rule 3]
    Diffuse {
        /// kd (N·L).
        Cosine,
        /// kd.
        Flat,
        /// None.
        Absent,
        /// kd (N·L)².
        Squared,
        /// kd (N·L + 1)/2.
        Wrapped,
        /// kd (N·L)/π.
        OverPi,
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
    /// The direction V towards the viewer. [rule 3]
    Viewer {
        /// −d.
        AgainstRay,
        /// d.
        Reversed,
        /// Towards the camera, for every ray.
        Camera,
        /// Towards the origin of world space.
        Origin,
    }
    /// The lights that are summed. [rule 3]
    LightSum {
        /// All.
        All,
        /// The first.
        First,
        /// The last.
        Last,
        /// All, divided by their number.
        Mean,
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
        /// kd Ia_j.
        Kd,
        /// Ia_j.
        WithoutKa,
        /// ka² Ia_j.
        KaTwice,
        /// A_j ka Ia_j.
        Weakened,
        /// S_j ka Ia_j.
        InShadow,
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
        /// 1/(a r² + c).
        WithoutLinear,
        /// 1/(a r² + b r).
        WithoutConstant,
        /// With r² instead of r.
        LinearSquared,
        /// 1/(1 + a r² + b r + c).
        OnePlus,
        /// 1/r².
        InverseSquare,
    }
    /// The end of a shadow ray. [rule 5]
    ShadowReach {
        /// At the light.
        Light,
        /// None: objects behind the light block it.
        Unbounded,
        /// At distance 1, or at a light that is nearer.
        One,
        /// At the light where no surface is nearer; otherwise none.
        FirstHitOnly,
        /// At the distance of the light, counted again from each surface.
        Restarts,
    }
    /// The vector L towards a point light. [rule 5]
    LightVector {
        /// The unit vector towards the light.
        Unit,
        /// A vector as long as the distance to the light.
        NotUnit,
        /// The unit vector away from the light.
        Reversed,
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
        /// kt of the last crossing only.
        LastCrossing,
        /// 1 − kt at each crossing.
        Complement,
        /// 1 − kt is subtracted at each crossing.
        Subtracted,
        /// kt to the power of the length of the way inside.
        ByLength,
    }
}
