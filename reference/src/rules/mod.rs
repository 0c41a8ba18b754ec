//! The rules of light as a value: one field for every decision, the lecture's first, then what else
//! people write.
//!
//! The kernel is generic over a [`RuleSource`]. [`Lecture`] has no size and its rules are a
//! constant, so that the compiler removes every alternative: they cost nothing. A `&Rules` is
//! looked up as the picture is rendered.

mod choices;
mod course;
mod style;

pub use choices::*;
pub use style::*;

use cases::film::Quantiser;

use crate::real::Real;

/// Where the kernel finds the rules it follows.
pub trait RuleSource: Copy + Send + Sync {
    /// Whether they are known to be those of [`Lecture`].
    const IS_LECTURE: bool = false;

    /// The rules.
    fn get(&self) -> &Rules;

    /// RAY_EPSILON under these rules. [rule 21]
    #[inline(always)]
    fn epsilon<T: Real>(&self) -> T {
        match self.get().epsilon {
            Epsilon::RayEpsilon => T::RAY_EPSILON,
            Epsilon::Fixed(t) | Epsilon::Mistaken(t) => T::of(t),
        }
    }
}

/// The rules as `docs/shading-model.md` has them, known when the program is compiled.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lecture;

impl RuleSource for Lecture {
    const IS_LECTURE: bool = true;

    #[inline(always)]
    fn get(&self) -> &Rules {
        const { &Rules::LECTURE }
    }
}

impl RuleSource for &Rules {
    #[inline(always)]
    fn get(&self) -> &Rules {
        self
    }
}

/// One value for every decision of the rules of light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "each type says what its field decides; the flags are documented")]
pub struct Rules {
    /// Whether a ray goes through the pixel's centre, not its top left corner. [rule 1]
    pub pixel_centre: bool,
    /// Whether rows are counted from the top. [rule 1]
    pub rows_from_top: bool,
    /// Whether the picture's first row, the top one, is taken for row 0, not for the last. [rule 1]
    pub picture_from_top: bool,
    /// Whether the shape of the picture widens the view, so that pixels are square. [rule 1]
    pub square_pixels: bool,
    /// Whether an eye ray's direction is of unit length. [rule 1]
    pub unit_direction: bool,
    pub fov: Fov,
    pub nearest: Nearest,
    pub highlight: Highlight,
    pub diffuse: Diffuse,
    pub facing: Facing,
    pub emission: Emission,
    pub ambient: Ambient,
    pub attenuation: Attenuation,
    /// Whether a shadow ray is cast at all. [rule 5]
    pub casts_shadows: bool,
    pub shadow_reach: ShadowReach,
    /// Whether L points to a directional light, not along with its light. [rule 5]
    pub towards_light: bool,
    pub tint: Tint,
    pub mirror: Mirror,
    pub mirror_weight: MirrorWeight,
    pub transmit_weight: TransmitWeight,
    pub bend: Bend,
    /// The index of air. [rule 9]
    pub air: f64,
    pub leaving: Leaving,
    pub total_reflection: TotalReflection,
    pub turning: Turning,
    /// Whether kt scales the ambient term on the way out. [rule 12]
    pub ambient_inside: bool,
    pub depth: Depth,
    pub cutoff: Cutoff,
    /// Whether a ray of too small a weight is cast nevertheless, to bring back its own light. [rule
    /// 13]
    pub casts_faint_rays: bool,
    pub sphere_roots: SphereRoots,
    pub sphere_normal: SphereNormal,
    pub plane: PlaneSide,
    pub square: SquareSize,
    pub box_roots: BoxRoots,
    pub triangle: TriangleTest,
    pub triangle_normal: TriangleNormal,
    pub weights: Weights,
    pub interpolation: Interpolation,
    pub reflect_by: ReflectBy,
    pub refract_by: RefractBy,
    pub inside_by: InsideBy,
    pub object_ray: ObjectRay,
    pub world_normal: WorldNormal,
    pub epsilon: Epsilon,
    /// How the picture's light becomes bytes; light itself it does not touch.
    pub quantiser: Quantiser,
    /// What is free: it changes no more than roundings.
    pub style: Style,
}

impl Rules {
    /// The rules of the lecture.
    pub const LECTURE: Self = Self {
        pixel_centre: true,
        rows_from_top: true,
        picture_from_top: true,
        square_pixels: true,
        unit_direction: true,
        fov: Fov::Vertical,
        nearest: Nearest::LeastT,
        highlight: Highlight::Blinn,
        diffuse: Diffuse::Cosine,
        facing: Facing::OnlyFront,
        emission: Emission::Once,
        ambient: Ambient::PerLight,
        attenuation: Attenuation::Clamped,
        casts_shadows: true,
        shadow_reach: ShadowReach::Light,
        towards_light: true,
        tint: Tint::PerCrossing,
        mirror: Mirror::Lecture,
        mirror_weight: MirrorWeight::Kr,
        transmit_weight: TransmitWeight::Kt,
        bend: Bend::Snell,
        air: 1.0003,
        leaving: Leaving::Swapped,
        total_reflection: TotalReflection::ReflectOnly,
        turning: Turning::Everywhere,
        ambient_inside: true,
        depth: Depth::Less,
        cutoff: Cutoff::AllChannels,
        casts_faint_rays: true,
        sphere_roots: SphereRoots::NearThenFar,
        sphere_normal: SphereNormal::FromCentre,
        plane: PlaneSide::Both,
        square: SquareSize::Half,
        box_roots: BoxRoots::NearThenFar,
        triangle: TriangleTest::Full,
        triangle_normal: TriangleNormal::Right,
        weights: Weights::Lecture,
        interpolation: Interpolation::Unit,
        reflect_by: ReflectBy::WithFallback,
        refract_by: RefractBy::WithFallback,
        inside_by: InsideBy::Geometric,
        object_ray: ObjectRay::AsIs,
        world_normal: WorldNormal::InverseTranspose,
        epsilon: Epsilon::RayEpsilon,
        quantiser: Quantiser::Rounding,
        style: Style::REFERENCE,
    };

    /// The same rules, in the style of [`Style::PLAIN`].
    pub fn plain(self) -> Self {
        Self { style: Style::PLAIN, ..self }
    }

    /// Whether hits are put back on their surfaces, with a bound of what is left: not where a
    /// mistake takes t or the surface elsewhere, and the point that a student computes is the one
    /// along the ray.
    #[inline(always)]
    pub fn places_hits(&self) -> bool {
        self.style.robustness == Robustness::Certified
            && self.object_ray == ObjectRay::AsIs
            && self.sphere_roots != SphereRoots::UnitDirection
            && self.plane != PlaneSide::NegatedK
    }
}
