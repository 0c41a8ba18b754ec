//! The rules of light as a value: one field for each decision. The lecture's choice comes first,
//! known mistakes and the choices of other courses follow.
//!
//! The kernel is generic over a [`RuleSource`]. [`Lecture`] has no size and its rules are a
//! constant, so that the compiler removes every alternative: they cost nothing. A `&Rules` is read
//! while the picture is rendered.

mod choices;
mod course;
mod formula;
pub mod misconceptions;
mod style;

pub use choices::*;
pub use formula::Formula;
pub use style::*;

use cases::Effect;
use cases::film::Quantiser;

use crate::numbers::real::Real;

/// The source of the rules that the kernel follows.
pub trait RuleSource: Copy + Send + Sync {
    /// Whether the rules are known at compile time to be those of [`Lecture`].
    const IS_LECTURE: bool = false;

    /// Returns the rules.
    fn get(&self) -> &Rules;

    /// Returns RAY_EPSILON under these rules. [rule 21]
    #[inline(always)]
    fn epsilon<T: Real>(&self) -> T {
        match self.get().epsilon {
            Epsilon::RayEpsilon => T::RAY_EPSILON,
            Epsilon::Fixed(t) | Epsilon::Mistaken(t) => T::of(t),
        }
    }
}

/// The rules of `docs/shading-model.md`, known at compile time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lecture;

impl RuleSource for Lecture {
    const IS_LECTURE: bool = true;

    #[inline(always)]
    fn get(&self) -> &Rules {
        const { &Rules::LECTURE }
    }
}

impl Formula {
    /// Returns the rules `base` with these formulas.
    pub const fn rules(self, base: &Rules) -> Rules {
        Rules { style: self.style(), ..*base }
    }
}

/// The rules of [`Lecture`], computed by [`Formula::Plain`], known at compile time.
#[derive(Clone, Copy, Debug, Default)]
pub struct LecturePlain;

impl RuleSource for LecturePlain {
    #[inline(always)]
    fn get(&self) -> &Rules {
        const { &Formula::Plain.rules(&Rules::LECTURE) }
    }
}

/// The rules of [`Lecture`], computed by [`Formula::Stable`], known at compile time.
#[derive(Clone, Copy, Debug, Default)]
pub struct LectureStable;

impl RuleSource for LectureStable {
    #[inline(always)]
    fn get(&self) -> &Rules {
        const { &Formula::Stable.rules(&Rules::LECTURE) }
    }
}

impl RuleSource for &Rules {
    #[inline(always)]
    fn get(&self) -> &Rules {
        self
    }
}

/// A value for each decision of the rules of light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "each type says what its field decides; the flags are documented")]
pub struct Rules {
    /// Whether an eye ray goes through the pixel's centre instead of its top left corner. [rule 1]
    pub pixel_centre: bool,
    /// Whether rows are counted from the top. [rule 1]
    pub rows_from_top: bool,
    /// Whether row 0 is the picture's top row instead of its bottom row. [rule 1]
    pub picture_from_top: bool,
    pub aspect: Aspect,
    pub span: Span,
    /// Whether the direction of an eye ray is normalised. [rule 1]
    pub unit_direction: bool,
    /// Whether an eye ray starts at the eye instead of on the view plane. [rule 1]
    pub starts_at_eye: bool,
    /// Whether the camera's up is perpendicular to the view instead of the y axis. [rule 1]
    pub level_up: bool,
    pub fov: Fov,
    pub half_angle: HalfAngle,
    pub nearest: Nearest,
    pub searched: Searched,
    pub background: Background,
    /// The effect that is simulated even where the scene does not list it, if any. [rule 5]
    /// [rule 6] [rule 7] [rule 8] [rule 18]
    pub unlisted: Option<Effect>,
    pub highlight: Highlight,
    pub highlight_colour: HighlightColour,
    pub viewer: Viewer,
    pub diffuse: Diffuse,
    pub facing: Facing,
    pub light_sum: LightSum,
    /// Whether lights have their colours instead of white. [rule 3]
    pub coloured_lights: bool,
    pub emission: Emission,
    pub ambient: Ambient,
    pub attenuation: Attenuation,
    /// Whether the attenuation is a factor twice. [rule 4]
    pub attenuates_twice: bool,
    /// Whether shadow rays are cast. [rule 5]
    pub casts_shadows: bool,
    pub shadow_reach: ShadowReach,
    /// Whether each light has a shadow of its own instead of the first light's. [rule 5]
    pub own_shadows: bool,
    pub light_vector: LightVector,
    /// Whether t_light of a directional light is infinite instead of 1. [rule 5]
    pub endless_sun: bool,
    /// Whether L points towards a directional light instead of along its direction of travel.
    /// [rule 5]
    pub towards_light: bool,
    pub tint: Tint,
    pub mirror: Mirror,
    pub mirror_weight: MirrorWeight,
    pub transmit_weight: TransmitWeight,
    pub mixing: Mixing,
    pub cut: Cut,
    pub bend: Bend,
    /// The index of refraction of air. [rule 9]
    pub air: f64,
    pub index: Index,
    pub outside: Outside,
    pub leaving: Leaving,
    pub total_reflection: TotalReflection,
    pub turning: Turning,
    pub ambient_inside: InsideAmbient,
    pub depth: Depth,
    /// The number of levels by which a spawned ray is deeper. [rule 13]
    pub depth_step: u32,
    pub cutoff: Cutoff,
    /// Whether a ray whose weight is below the threshold is still cast, and only spawns no more.
    /// [rule 13]
    pub casts_faint_rays: bool,
    pub sphere_roots: SphereRoots,
    pub squared_radius: SquaredRadius,
    pub sphere_normal: SphereNormal,
    pub plane: PlaneSide,
    pub square: SquareSize,
    /// Whether the normal of the square is +z instead of −z. [rule 15]
    pub square_faces_z: bool,
    pub box_roots: BoxRoots,
    pub box_normal: BoxNormal,
    pub lids: Lids,
    pub round_side: RoundSide,
    pub cone_normal: ConeNormal,
    pub triangle: TriangleTest,
    pub triangle_normal: TriangleNormal,
    pub weights: Weights,
    pub interpolation: Interpolation,
    pub interpolated_in: InterpolatedIn,
    pub reflect_by: ReflectBy,
    pub refract_by: RefractBy,
    pub inside_by: InsideBy,
    pub object_ray: ObjectRay,
    pub world_normal: WorldNormal,
    pub epsilon: Epsilon,
    /// The conversion of linear light to bytes in the picture file. It does not change the light
    /// itself.
    pub quantiser: Quantiser,
    /// The freedoms of the implementation, which change results only by rounding.
    pub style: Style,
}

impl Rules {
    /// The rules of the lecture.
    pub const LECTURE: Self = Self {
        pixel_centre: true,
        rows_from_top: true,
        picture_from_top: true,
        aspect: Aspect::Widens,
        span: Span::Pixels,
        unit_direction: true,
        starts_at_eye: true,
        level_up: true,
        fov: Fov::Vertical,
        half_angle: HalfAngle::Half,
        nearest: Nearest::LeastT,
        searched: Searched::All,
        background: Background::Scene,
        unlisted: None,
        highlight: Highlight::Blinn,
        highlight_colour: HighlightColour::Ks,
        viewer: Viewer::AgainstRay,
        diffuse: Diffuse::Cosine,
        facing: Facing::OnlyFront,
        light_sum: LightSum::All,
        coloured_lights: true,
        emission: Emission::Once,
        ambient: Ambient::PerLight,
        attenuation: Attenuation::Clamped,
        attenuates_twice: false,
        casts_shadows: true,
        shadow_reach: ShadowReach::Light,
        own_shadows: true,
        light_vector: LightVector::Unit,
        endless_sun: true,
        towards_light: true,
        tint: Tint::PerCrossing,
        mirror: Mirror::Lecture,
        mirror_weight: MirrorWeight::Kr,
        transmit_weight: TransmitWeight::Kt,
        mixing: Mixing::Sum,
        cut: Cut::Never,
        bend: Bend::Snell,
        air: 1.0003,
        index: Index::Material,
        outside: Outside::Air,
        leaving: Leaving::Swapped,
        total_reflection: TotalReflection::ReflectOnly,
        turning: Turning::Everywhere,
        ambient_inside: InsideAmbient::TimesKt,
        depth: Depth::Less,
        depth_step: 1,
        cutoff: Cutoff::AllChannels,
        casts_faint_rays: true,
        sphere_roots: SphereRoots::NearThenFar,
        squared_radius: SquaredRadius::Given,
        sphere_normal: SphereNormal::FromCentre,
        plane: PlaneSide::Both,
        square: SquareSize::Half,
        square_faces_z: true,
        box_roots: BoxRoots::NearThenFar,
        box_normal: BoxNormal::Outwards,
        lids: Lids::AsGiven,
        round_side: RoundSide::Full,
        cone_normal: ConeNormal::OfSide,
        triangle: TriangleTest::Full,
        triangle_normal: TriangleNormal::Right,
        weights: Weights::Lecture,
        interpolation: Interpolation::Unit,
        interpolated_in: InterpolatedIn::ObjectSpace,
        reflect_by: ReflectBy::WithFallback,
        refract_by: RefractBy::WithFallback,
        inside_by: InsideBy::Geometric,
        object_ray: ObjectRay::AsIs,
        world_normal: WorldNormal::InverseTranspose,
        epsilon: Epsilon::RayEpsilon,
        quantiser: Quantiser::Rounding,
        style: Style::REFERENCE,
    };

    /// Returns the formulas of these rules, if they are the lecture's in all else that changes
    /// light.
    ///
    /// The quantiser is ignored, because light is converted to bytes after it is computed.
    pub fn lecture_by(&self) -> Option<Formula> {
        let light = Self { quantiser: Self::LECTURE.quantiser, ..*self };
        Formula::ALL.into_iter().find(|formula| light == formula.rules(&Self::LECTURE))
    }

    /// Returns the same rules in the style [`Style::PLAIN`].
    pub fn plain(self) -> Self {
        Self { style: Style::PLAIN, ..self }
    }

    /// Returns whether the quadratic of a sphere is that of rule 14, whichever root counts.
    #[inline(always)]
    pub fn has_right_spheres(&self) -> bool {
        !matches!(self.sphere_roots, SphereRoots::UnitDirection | SphereRoots::FourMissing)
            && self.squared_radius == SquaredRadius::Given
    }

    /// Returns whether cylinders and cones have the lids and sides of rule 15.
    #[inline(always)]
    pub fn has_right_rounds(&self) -> bool {
        self.lids == Lids::AsGiven && self.round_side == RoundSide::Full
    }

    /// Returns whether hits are moved back onto their surfaces, with a bound on the remaining
    /// error.
    ///
    /// It is false for plain styles. It is also false for a mistake that changes t or the surface:
    /// there the result must be the point along the ray, as a student computes it.
    #[inline(always)]
    pub fn places_hits(&self) -> bool {
        self.style.robustness == Robustness::Certified
            && self.object_ray == ObjectRay::AsIs
            && self.has_right_spheres()
            && !matches!(self.plane, PlaneSide::NegatedK | PlaneSide::ThroughOrigin)
            && self.square != SquareSize::FromZero
            && self.round_side == RoundSide::Full
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_of_the_lecture_are_found_whatever_the_formulas_and_bytes() {
        for formula in Formula::ALL {
            let rules = formula.rules(&Rules::LECTURE);
            assert_eq!(rules.lecture_by(), Some(formula));
            let truncated = Rules { quantiser: Quantiser::Truncating, ..rules };
            assert_eq!(truncated.lecture_by(), Some(formula));
            assert_eq!(Rules { air: 1.0, ..rules }.lecture_by(), None);
            let nudge = [0.5, 0.0];
            assert_eq!(Rules { style: Style { nudge, ..rules.style }, ..rules }.lecture_by(), None);
        }
    }
}
