//! The rules of a course: the lecture's, except where the course decides otherwise.

use cases::Course;
use cases::course::{
    Air, AmbientInside, Bytes, CutoffTest, DepthTest, FovAxis, InsideNormal, Lobe, Near, Pixel,
    ReflectNormal, RefractNormal, Row0, ShadowTint, TwoSided,
};
use cases::film::Quantiser;

use super::{
    Attenuation, Cutoff, Depth, Epsilon, Facing, Fov, Highlight, InsideAmbient, InsideBy,
    ReflectBy, RefractBy, Rules, Tint,
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
            ambient_inside: match ambient_inside {
                AmbientInside::TimesKt => InsideAmbient::TimesKt,
                AmbientInside::AsOutside => InsideAmbient::AsOutside,
            },
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
    /// Returns whether the proofs hold by which work is left out that cannot change a picture: the
    /// style is the reference's, and the rules differ from the lecture's at most in choices of a
    /// course that the proofs allow for. It is false for every mistake that moves a ray or a hit.
    pub fn is_proven(&self) -> bool {
        let has_known_light = matches!(
            (self.facing, self.attenuation),
            (
                Facing::OnlyFront | Facing::BothSidesOfTransmissive | Facing::BothSides,
                Attenuation::Clamped | Attenuation::Unclamped
            )
        );
        let has_known_epsilon = matches!(self.epsilon, Epsilon::RayEpsilon | Epsilon::Fixed(_));
        let lecture = Self {
            pixel_centre: self.pixel_centre,
            rows_from_top: self.rows_from_top,
            picture_from_top: self.picture_from_top,
            fov: self.fov,
            highlight: self.highlight,
            facing: self.facing,
            attenuation: self.attenuation,
            tint: self.tint,
            air: self.air,
            ambient_inside: self.ambient_inside,
            depth: self.depth,
            cutoff: self.cutoff,
            quantiser: self.quantiser,
            epsilon: self.epsilon,
            ..Self::LECTURE
        };
        has_known_light && has_known_epsilon && *self == lecture
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::misconceptions;

    #[test]
    fn the_proofs_hold_for_courses_and_for_no_mistake_that_moves_a_ray() {
        let course = |line: &str| Rules::of(&cases::course::parse("course", line).unwrap());
        for line in [
            "bytes = \"truncated\"",
            "two_sided = \"always\"",
            "tint = \"per_object\"",
            "epsilon = 1e-3",
        ] {
            assert!(course(line).is_proven(), "{line}");
        }
        assert!(!course("reflect_by = \"geometric\"").is_proven());
        assert!(!Rules::LECTURE.plain().is_proven());
        let spoilt = misconceptions::of(&Rules::LECTURE);
        let n = spoilt.iter().filter(|wrong| !wrong.on(&Rules::LECTURE).is_proven()).count();
        assert!(n > spoilt.len() / 2, "{n} of {}", spoilt.len());
    }
}
