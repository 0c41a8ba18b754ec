//! Mistakes in attenuation and shadows. [rule 4] to [rule 6]

use cases::Effect;

use super::kind::Misconception;
use crate::rules::{Attenuation, LightVector, ShadowReach, Tint};

misconceptions! {
    SHADOWS:
    attenuation_above_one, 4, "light.rs distance_attenuation", attenuation = Attenuation::Unclamped,
        "near a light the attenuation exceeds 1";
    attenuation_cut, 4, "light.rs distance_attenuation", attenuation = Attenuation::Clamped,
        "near a light the attenuation is cut at 1";
    no_attenuation, 4, "light.rs distance_attenuation", attenuation = Attenuation::Absent,
        "light does not weaken with distance";
    attenuation_swapped, 4, "light.rs distance_attenuation", attenuation = Attenuation::Swapped,
        "the constant and the quadratic coefficient are exchanged";
    attenuation_not_squared, 4, "light.rs distance_attenuation",
        attenuation = Attenuation::NotSquared,
        "the quadratic coefficient is multiplied by r, not by r²";
    attenuation_without_linear, 4, "light.rs distance_attenuation",
        attenuation = Attenuation::WithoutLinear,
        "the linear coefficient is left out";
    attenuation_without_constant, 4, "light.rs distance_attenuation",
        attenuation = Attenuation::WithoutConstant,
        "the constant coefficient is left out";
    attenuation_linear_squared, 4, "light.rs distance_attenuation",
        attenuation = Attenuation::LinearSquared,
        "the linear coefficient is multiplied by r², not by r";
    attenuation_plus_one, 4, "light.rs distance_attenuation", attenuation = Attenuation::OnePlus,
        "1 is added to the denominator; the quotient is cut at 1";
    attenuation_inverse_square, 4, "light.rs distance_attenuation",
        attenuation = Attenuation::InverseSquare,
        "light weakens with 1/r², whatever the coefficients";
    attenuated_twice, 4, "shade.rs shade", attenuates_twice = true,
        "the attenuation is a factor twice";
    no_shadows, 5, "shadow.rs shadow_attenuation", casts_shadows = false,
        "nothing casts a shadow";
    shadow_beyond_light, 5, "shadow.rs shadow_attenuation", shadow_reach = ShadowReach::Unbounded,
        "the shadow ray goes on behind the light, where nothing can block it";
    light_reversed, 5, "light.rs to_light", towards_light = false,
        "a directional light is sought along its direction of travel; it comes from the other side";
    shadow_reach_of_one, 5, "shadow.rs shadow_attenuation", shadow_reach = ShadowReach::One,
        "the shadow ray ends at t = 1, although its direction is a unit vector";
    shadow_reach_of_first_hit, 5, "shadow.rs shadow_attenuation",
        shadow_reach = ShadowReach::FirstHitOnly,
        "only the first hit is compared with the distance to the light: behind glass, everything \
            counts";
    shadow_reach_restarts, 5, "shadow.rs shadow_attenuation", shadow_reach = ShadowReach::Restarts,
        "behind each surface, the shadow ray again goes as far as the light was from the point";
    shadow_of_first_light, 5, "shade.rs shade", own_shadows = false,
        "all lights have the shadow of the first one";
    light_vector_not_unit, 5, "light.rs to_light", light_vector = LightVector::NotUnit,
        "L is not normalised";
    light_vector_reversed, 5, "light.rs to_light", light_vector = LightVector::Reversed,
        "L points from the light to the point";
    sun_at_distance_one, 5, "light.rs to_light", endless_sun = false,
        "a directional light is at distance 1: what is farther casts no shadow";
    unlisted_shadows, 5, "trace.rs unblocked_share", unlisted = Some(Effect::Shadows),
        "shadows are simulated even where the scene does not list them";
    glass_blocks_all, 6, "shadow.rs shadow_attenuation", tint = Tint::Opaque,
        "a transparent object casts a black shadow";
    glass_casts_no_shadow, 6, "shadow.rs shadow_attenuation", tint = Tint::Clear,
        "a transparent object casts no shadow at all";
    tint_once_per_object, 6, "shadow.rs shadow_attenuation", tint = Tint::PerObject,
        "kt tints a shadow once for each object, not for each surface crossed";
    tint_at_each_crossing, 6, "shadow.rs shadow_attenuation", tint = Tint::PerCrossing,
        "kt tints a shadow for each surface crossed";
    tint_by_first_crossing, 6, "shadow.rs shadow_attenuation", tint = Tint::FirstCrossing,
        "the shadow ray stops at the first transparent surface";
    tint_by_last_crossing, 6, "shadow.rs shadow_attenuation", tint = Tint::LastCrossing,
        "the last transparent surface alone tints the light: each kt replaces the product";
    tint_by_one_minus_kt, 6, "shadow.rs shadow_attenuation", tint = Tint::Complement,
        "a transparent surface tints the light with 1 − kt, not with kt";
    tint_subtracted, 6, "shadow.rs shadow_attenuation", tint = Tint::Subtracted,
        "a transparent surface takes 1 − kt away; it multiplies by kt";
    tint_by_length, 6, "shadow.rs shadow_attenuation", tint = Tint::ByLength,
        "kt is raised to the length of the way inside, as if the colour were in the volume";
}
