//! Decisions on eye rays and hits. [rule 1] [rule 2]

choices! {
    /// The angle that fov measures. [rule 1]
    Fov {
        /// The angle from bottom to top.
        Vertical,
        /// The angle from left to right.
        Horizontal,
    }
    /// The tangent by which the view plane is scaled. [rule 1]
    HalfAngle {
        /// The tangent of half the angle.
        Half,
        /// The tangent of the whole angle.
        Whole,
        /// Half the tangent of the whole angle.
        HalfOfTangent,
        /// The tangent of half the angle, with degrees taken for radians.
        Radians,
    }
    /// The effect of the picture's shape on the view plane. [rule 1]
    Aspect {
        /// Widens the plane: pixels are square.
        Widens,
        /// None.
        Ignored,
        /// Narrows the plane.
        Inverted,
        /// Heightens the plane.
        Heightens,
    }
    /// The number of pixels that a row or a column is divided by. [rule 1]
    Span {
        /// All.
        Pixels,
        /// One less: the outermost pixels lie on the border of the view.
        EdgeToEdge,
    }
    /// The hit that wins among those of several objects. [rule 2]
    Nearest {
        /// The hit with the least t.
        LeastT,
        /// The hit on the first object in the list.
        FirstListed,
        /// The hit on the last object in the list.
        LastListed,
        /// The hit with the greatest t.
        Farthest,
        /// The hit with the least t; of several, the one on the last object.
        LastOfEqual,
    }
    /// The objects that are searched for the nearest hit. [rule 2]
    Searched {
        /// All.
        All,
        /// All but the first.
        NotFirst,
        /// All but the last.
        NotLast,
    }
    /// The light of a ray that hits nothing. [rule 2]
    Background {
        /// The background of the scene.
        Scene,
        /// None.
        Black,
        /// None, except for an eye ray.
        BlackForSpawned,
    }
}
