//! The rules of a course: the lecture's, except where the course decides otherwise.

use cases::Course;
use cases::course::{
    Air, AmbientInside, Bytes, CutoffTest, DepthTest, FovAxis, InsideNormal, Lobe, Near, Pixel,
    ReflectNormal, RefractNormal, Row0, ShadowTint, TwoSided,
};
use cases::film::Quantiser;

use super::{
    Attenuation, Cutoff, Depth, Epsilon, Facing, Fov, Highlight, InsideBy, ReflectBy, RefractBy,
    Rules, Tint,
};

impl Rules {
    /// Returns the rules by which a course renders; for the default course exactly
    /// [`Rules::LECTURE`].
    ///
    /// An epsilon of 1e-6 is the lecture's: in single precision it becomes 1e-4. Any other value
    /// holds in both precisions. [rule 21]
    pub fn of(course: &Course) -> Self {
        // The pattern names every field, so that a new key cannot be forgotten here.
        // `always_simulated` is no rule of light: it decides the effects of a scene.
        let Course {
            pixel,
            row_0,
            fov,
            highlight,
            two_sided,
            attenuation,
            tint,
            index_of_air,
            ambient_inside,
            depth,
            cutoff,
            inside_by,
            reflect_by,
            refract_by,
            bytes,
            epsilon,
            always_simulated: _,
        } = *course;
        Self {
            pixel_centre: pixel == Pixel::Centre,
            rows_from_top: row_0 == Row0::Top,
            picture_from_top: row_0 == Row0::Top,
            fov: match fov {
                FovAxis::Vertical => Fov::Vertical,
                FovAxis::Horizontal => Fov::Horizontal,
            },
            highlight: match highlight {
                Lobe::Blinn => Highlight::Blinn,
                Lobe::Phong => Highlight::Phong,
            },
            facing: match two_sided {
                TwoSided::Never => Facing::OnlyFront,
                TwoSided::Transmissive => Facing::BothSidesOfTransmissive,
                TwoSided::Always => Facing::BothSides,
            },
            attenuation: match attenuation {
                Near::Clamped => Attenuation::Clamped,
                Near::Unclamped => Attenuation::Unclamped,
            },
            tint: match tint {
                ShadowTint::PerCrossing => Tint::PerCrossing,
                ShadowTint::PerObject => Tint::PerObject,
                ShadowTint::Nothing => Tint::Clear,
                ShadowTint::Opaque => Tint::Opaque,
            },
            air: match index_of_air {
                Air::Air => 1.0003,
                Air::Vacuum => 1.0,
            },
            ambient_inside: ambient_inside == AmbientInside::TimesKt,
            depth: match depth {
                DepthTest::Less => Depth::Less,
                DepthTest::LessOrEqual => Depth::OneMore,
            },
            cutoff: match cutoff {
                CutoffTest::AllChannels => Cutoff::AllChannels,
                CutoffTest::AnyChannel => Cutoff::AnyChannel,
            },
            inside_by: match inside_by {
                InsideNormal::Geometric => InsideBy::Geometric,
                InsideNormal::Interpolated => InsideBy::Interpolated,
            },
            reflect_by: match reflect_by {
                ReflectNormal::WithFallback => ReflectBy::WithFallback,
                ReflectNormal::Interpolated => ReflectBy::Interpolated,
                ReflectNormal::Geometric => ReflectBy::Geometric,
            },
            refract_by: match refract_by {
                RefractNormal::WithFallback => RefractBy::WithFallback,
                RefractNormal::Interpolated => RefractBy::Interpolated,
                RefractNormal::Geometric => RefractBy::Geometric,
            },
            quantiser: match bytes {
                Bytes::Rounded => Quantiser::Rounding,
                Bytes::Truncated => Quantiser::Truncating,
            },
            epsilon: if epsilon == cases::RAY_EPSILON {
                Epsilon::RayEpsilon
            } else {
                Epsilon::Fixed(epsilon)
            },
            ..Self::LECTURE
        }
    }
}
