//! Decisions on reflection, refraction and the recursion. [rule 7] to [rule 13]

choices! {
    /// The reflected direction. [rule 7]
    Mirror {
        /// d − 2 (d·N) N.
        Lecture,
        /// 2 (d·N) N − d, the opposite direction.
        Backwards,
        /// d − (d·N) N.
        Tangential,
        /// d + 2 (d·N) N.
        Plus,
    }
    /// The weight of the reflected ray. [rule 7]
    MirrorWeight {
        /// kr.
        Kr,
        /// 1.
        One,
        /// kr outside an object; no reflected ray inside.
        OnlyOutside,
        /// ks.
        Ks,
        /// kr².
        Squared,
        /// kr + (1 − kr) (1 − cos θ)⁵, where kr > 0.
        Schlick,
    }
    /// The weight of the transmitted ray. [rule 8]
    TransmitWeight {
        /// kt.
        Kt,
        /// 1.
        One,
        /// 1 − kr.
        OneMinusKr,
        /// kr.
        Kr,
        /// kt on the way in, 1 on the way out.
        OnEntry,
        /// kt on the way in, 0 on the way out.
        NoWayOut,
        /// 1 on the way in, kt to the power of the length of the way on the way out.
        ByLength,
    }
    /// The combination of a surface's own light with that of spawned rays. [rule 7] [rule 8]
    Mixing {
        /// The sum of both.
        Sum,
        /// Own light is multiplied by 1 − kr.
        OneMinusKr,
        /// Own light is multiplied by 1 − kt.
        OneMinusKt,
        /// Reflected light replaces own light.
        MirrorReplaces,
        /// Transmitted light replaces all other light.
        GlassReplaces,
    }
    /// The light that is cut at 1 before it is weighted. [rule 7]
    Cut {
        /// None.
        Never,
        /// A surface's own light.
        Surface,
        /// The light of a spawned ray.
        Spawned,
    }
    /// The transmitted direction. [rule 8]
    Bend {
        /// Bent with the ratio η_i / η_t.
        Snell,
        /// Bent with the ratio η_t / η_i.
        Inverted,
        /// Not bent.
        Straight,
        /// Bent with cos θ_i = d·N.
        CosineReversed,
        /// Bent with cos θ_t = √(1 − η sin²θ_i).
        RatioNotSquared,
        /// Bent with + cos θ_t N.
        PlusRoot,
    }
    /// The index of refraction of an object. [rule 9]
    Index {
        /// The index of its material.
        Material,
        /// 1.5.
        Glass,
    }
    /// The medium outside an object. [rule 9]
    Outside {
        /// Air.
        Air,
        /// The object around it, or air.
        ObjectAround,
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
        /// The reflected ray, once more with the weight kt.
        MirroredByKt,
        /// The reflected ray, and kt times the background.
        Background,
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
    /// The ambient term inside an object. [rule 12]
    InsideAmbient {
        /// Multiplied by kt.
        TimesKt,
        /// Equal to the one outside.
        AsOutside,
        /// Absent.
        Absent,
        /// Multiplied by 1 − kt.
        OneMinusKt,
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
        /// 0 only, and never at max_depth 0.
        EyeOnly,
        /// depth < 5.
        Five,
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
        /// The mean of the channels is below the threshold.
        Mean,
        /// Every channel is at or below the threshold.
        OrEqual,
    }
}
