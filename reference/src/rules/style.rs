//! The freedoms of the rules: choices with the same picture on paper and other roundings. The
//! reference's own choice comes first, those of students follow.

macro_rules! freedoms {
    ($($(#[$doc:meta])* $name:ident {
        $($(#[$variant_doc:meta])* $variant:ident = $says:literal,)*
    })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $name { $($(#[$variant_doc])* $variant,)* }

            impl $name {
                /// All choices, the reference's first.
                pub const ALL: &[Self] = &[$(Self::$variant,)*];

                /// Returns the published name of the choice.
                pub fn says(self) -> &'static str {
                    match self { $(Self::$variant => $says,)* }
                }
            }
        )*
    };
}

freedoms! {
    /// The handling of decisions that rounding could change. [rule 21]
    Robustness {
        /// The plain formula where its error bound decides, else two words of f64 for each number.
        Certified = "certified",
        /// The plain formula, without error bounds.
        Plain = "plain",
    }
    /// The roots of sphere, cylinder and cone. [rule 14]
    Quadratic {
        /// The discriminant from the ray's point nearest to the centre, the roots as c/q and q/a.
        NearestPoint = "quadratic about the nearest point",
        /// (−b ± √(b² − 4ac)) / 2a.
        Textbook = "textbook quadratic",
        /// b² − 4ac, the roots as c/q and q/a.
        Stable = "stable quadratic",
        /// The centre projected onto the ray, then half the chord to either side. Cylinder and cone
        /// as in the reference.
        Geometric = "geometric sphere",
    }
    /// The parameter t of a plane. [rule 15]
    PlaneFormula {
        /// N·(kN − P) / N·d.
        FromFoot = "plane from its foot",
        /// (k − N·P) / N·d.
        Textbook = "textbook plane",
    }
    /// The intersection test of a triangle. [rule 16] [rule 17]
    TriangleFormula {
        /// The ray sheared to an axis, three signs of areas in the plane perpendicular to it.
        Sheared = "sheared triangle",
        /// The point Q on the plane, then three edge tests by cross products.
        Edges = "three edge tests",
        /// Möller and Trumbore: β, γ, t by Cramer's rule.
        MollerTrumbore = "Möller–Trumbore",
        /// The point Q on the plane, then ratios of areas without the axis along which N is
        /// longest; α = 1 − β − γ.
        Areas = "barycentric areas",
    }
    /// The start of a ray that leaves a surface. [rule 21]
    Start {
        /// From Q, moved off the surface by the proven bound of its error to the side where the ray
        /// goes, over t > 0.
        OffBound = "offset by the error bound",
        /// From Q, over t > ε, the epsilon of the rules.
        Interval = "t >",
        /// From Q + ε N, over t > 0. N is the geometric normal, turned to the side where the ray
        /// goes.
        AlongNormal = "offset along the normal",
        /// From Q + ε d, over t > 0.
        AlongRay = "offset along the ray",
    }
    /// The direction and length of a shadow ray whose origin is moved off its point. [rule 5]
    ToLight {
        /// Measured from the point itself.
        FromPoint = "light seen from the point",
        /// Measured from the moved origin.
        FromStart = "light seen from the start",
    }
    /// The direction of the eye ray. [rule 1]
    CameraFormula {
        /// forward + x right + y up, with the tangent folded into x and y.
        Plane = "view plane at 1",
        /// A point of the view plane, counted from its corner in world space, minus the eye.
        Corner = "view plane by its corner",
        /// (1/tan) forward + x right + y up.
        Far = "view plane at 1/tan",
    }
    /// The cosine of the angle of refraction, cos θ_t. [rule 8]
    Snell {
        /// (η_t cos θ_t)² as a sum that does not cancel.
        Factored = "factored Snell",
        /// √(1 − η² (1 − cos²θ_i)).
        Textbook = "textbook Snell",
    }
    /// The power x^ns. [rule 3]
    Power {
        /// pow(x, ns).
        Pow = "pow",
        /// exp(ns ln x).
        ExpLog = "exp of ln",
    }
    /// The order in which the light of several lights is added. [rule 3]
    LightOrder {
        /// The order of the scene.
        Listed = "lights as listed",
        /// From the last light to the first.
        Reversed = "lights reversed",
    }
}

/// One way to compute the picture that the rules describe.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "each type says what its field decides")]
pub struct Style {
    pub robustness: Robustness,
    pub quadratic: Quadratic,
    pub plane: PlaneFormula,
    pub triangle: TriangleFormula,
    pub start: Start,
    pub to_light: ToLight,
    pub camera: CameraFormula,
    pub snell: Snell,
    pub power: Power,
    pub lights: LightOrder,
    /// Offset of eye rays from the centres of their pixels, in pixels to the right and down.
    /// [rule 1]
    pub nudge: [f64; 2],
}

impl Style {
    /// The reference's own style.
    pub const REFERENCE: Self = Self {
        robustness: Robustness::Certified,
        quadratic: Quadratic::NearestPoint,
        plane: PlaneFormula::FromFoot,
        triangle: TriangleFormula::Sheared,
        start: Start::OffBound,
        to_light: ToLight::FromPoint,
        camera: CameraFormula::Plane,
        snell: Snell::Factored,
        power: Power::Pow,
        lights: LightOrder::Listed,
        nudge: [0.0; 2],
    };

    /// The reference's formulas without certification, as a student writes them. Rays leave
    /// surfaces by RAY_EPSILON.
    pub const PLAIN: Self =
        Self { robustness: Robustness::Plain, start: Start::Interval, ..Self::REFERENCE };
}
