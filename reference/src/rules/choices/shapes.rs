//! Decisions on shapes. [rule 14] to [rule 18]

choices! {
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
        /// The nearest one in the interval, from the discriminant 4 b² − a c.
        FourMissing,
    }
    /// The square of the radius in the sphere's quadratic. [rule 14]
    SquaredRadius {
        /// r².
        Given,
        /// 1.
        One,
        /// (r/2)².
        Halved,
        /// r.
        NotSquared,
    }
    /// The sphere's normal. [rule 14]
    SphereNormal {
        /// Outwards from the sphere's centre.
        FromCentre,
        /// Outwards from the origin, regardless of the centre.
        FromOrigin,
        /// Inwards.
        Inwards,
        /// Outwards from the sphere's centre, not normalised.
        NotUnit,
    }
    /// The equation and the visible side of a plane. [rule 15]
    PlaneSide {
        /// N·X = k, visible from both sides.
        Both,
        /// N·X = −k.
        NegatedK,
        /// N·X = k, visible from the side of its normal only.
        FrontOnly,
        /// N·X = 0, visible from both sides.
        ThroughOrigin,
    }
    /// The extent of the square. [rule 15]
    SquareSize {
        /// |x|, |y| ≤ 1/2.
        Half,
        /// |x|, |y| ≤ 1.
        One,
        /// x² + y² ≤ 1/4: a disc.
        Disc,
        /// 0 ≤ x, y ≤ 1.
        FromZero,
    }
    /// The intersection with the box that counts. [rule 15]
    BoxRoots {
        /// The nearest one in the ray's interval.
        NearThenFar,
        /// The near one only: from inside, nothing is hit.
        NearOnly,
        /// The far one before the near one.
        FarFirst,
    }
    /// The normal of a box. [rule 15]
    BoxNormal {
        /// Outwards from the face that is hit.
        Outwards,
        /// Inwards from the face that is hit.
        Inwards,
        /// Along the axis on which the point is farthest from the origin.
        FromOrigin,
    }
    /// The discs that close cylinders and cones. [rule 15]
    Lids {
        /// On capped ones only.
        AsGiven,
        /// None.
        Never,
        /// On all.
        Always,
    }
    /// The side of cylinders and cones. [rule 15]
    RoundSide {
        /// Between both ends, all of it.
        Full,
        /// Without ends.
        Endless,
        /// Between both ends, the nearer root only.
        NearOnly,
    }
    /// The normal of the side of a cone. [rule 15]
    ConeNormal {
        /// Perpendicular to the side.
        OfSide,
        /// Perpendicular to the axis.
        Horizontal,
    }
    /// The triangle test. [rule 16]
    TriangleTest {
        /// Visible from both sides, all three edges tested.
        Full,
        /// Visible from the front only.
        FrontOnly,
        /// The edge BC is not tested: an unbounded parallelogram.
        TwoEdges,
        /// The edge AB is not tested.
        WithoutAb,
        /// No edge is tested.
        WholePlane,
    }
    /// The geometric normal of a triangle. [rule 16]
    TriangleNormal {
        /// Along (B − A) × (C − A).
        Right,
        /// Along (C − A) × (B − A).
        Left,
        /// (B − A) × (C − A), not normalised.
        NotUnit,
    }
    /// The weights of a triangle's vertices. [rule 17]
    Weights {
        /// α, β, γ for A, B, C.
        Lecture,
        /// β and γ exchanged.
        Swapped,
        /// Each vertex has the weight of its neighbour.
        Rotated,
        /// α and β exchanged.
        FirstSwapped,
        /// 1/3 for each vertex.
        Equal,
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
        /// The normal of the first vertex.
        FirstVertex,
        /// The interpolated normal, negated.
        Reversed,
    }
}
