//! Mistakes in the light at a point. [rule 3]

use super::kind::Misconception;
use crate::rules::{
    Ambient, Diffuse, Emission, Facing, Highlight, HighlightColour, LightSum, Viewer,
};

misconceptions! {
    LIGHT:
    phong_highlight, 3, "shade.rs light_term", highlight = Highlight::Phong,
        "the highlight is Phong's (R·V) where the half vector's (N·H) is due";
    blinn_highlight, 3, "shade.rs light_term", highlight = Highlight::Blinn,
        "the highlight is Blinn's (N·H) where the mirrored direction's (R·V) is due";
    half_vector_not_unit, 3, "shade.rs light_term", highlight = Highlight::HalfNotUnit,
        "the half vector L + V is not normalised";
    half_cosine_not_clamped, 3, "shade.rs light_term", highlight = Highlight::Unclamped,
        "a negative N·H is raised to the power ns; it must be cut at 0 first";
    no_exponent, 3, "shade.rs light_term", highlight = Highlight::NoExponent,
        "N·H is not raised to the power ns";
    highlight_times_cosine, 3, "shade.rs light_term", highlight = Highlight::TimesCosine,
        "the specular term is multiplied by N·L, as only the diffuse one is";
    no_highlight, 3, "shade.rs light_term", highlight = Highlight::Absent,
        "there is no specular term";
    no_cosine, 3, "shade.rs light_term", diffuse = Diffuse::Flat,
        "the diffuse term lacks the cosine N·L";
    highlight_from_behind, 3, "shade.rs light_term", facing = Facing::SpecularFromBehind,
        "a light behind the surface still gives a highlight: B is left out of the specular term";
    negative_light, 3, "shade.rs light_term", facing = Facing::Unclamped,
        "a light behind the surface takes light away: N·L is not cut at 0";
    lit_from_behind, 3, "shade.rs light_term", facing = Facing::BothSides,
        "a light behind the surface shines on it: |N·L| instead of N·L";
    glass_lit_from_behind, 3, "shade.rs light_term", facing = Facing::BothSidesOfTransmissive,
        "a light behind the surface shines on it where kt > 0, and only there: |N·L| instead of \
            N·L";
    dark_from_behind, 3, "shade.rs light_term", facing = Facing::OnlyFront,
        "a light behind the surface never shines on it: N·L is cut at 0";
    emission_per_light, 3, "shade.rs shade", emission = Emission::PerLight,
        "ke is added once for each light, not once";
    no_emission, 3, "shade.rs shade", emission = Emission::Absent,
        "ke is left out";
    ambient_of_one_light, 3, "shade.rs ambient", ambient = Ambient::FirstLight,
        "only the first light's ambient colour counts";
    ambient_from_light_colour, 3, "shade.rs ambient", ambient = Ambient::LightColour,
        "the ambient term takes the light's colour, not its ambient colour";
    ambient_in_shadow, 3, "shade.rs shade", ambient = Ambient::Shadowed,
        "shadow and distance darken the ambient term too";
    no_ambient, 3, "shade.rs ambient", ambient = Ambient::Absent,
        "there is no ambient term";
    half_vector_halved, 3, "shade.rs light_term", highlight = Highlight::HalfHalved,
        "the half vector is (L + V)/2, which is shorter than 1; it must be normalised";
    half_cosine_absolute, 3, "shade.rs light_term", highlight = Highlight::Absolute,
        "|N·H| is raised to the power ns; a negative N·H must be cut at 0";
    exponent_times_four, 3, "shade.rs light_term", highlight = Highlight::FourTimesExponent,
        "the exponent is 4 ns, not ns";
    exponent_times_128, 3, "shade.rs light_term", highlight = Highlight::Times128,
        "the exponent is 128 ns, not ns";
    highlight_by_kd, 3, "shade.rs light_term", highlight_colour = HighlightColour::Kd,
        "the specular term is multiplied by kd, not by ks";
    highlight_unlit, 3, "shade.rs light_term", highlight_colour = HighlightColour::Unlit,
        "the specular term is not multiplied by the light that arrives";
    viewer_reversed, 3, "shade.rs light_term", viewer = Viewer::Reversed,
        "V points along the ray, away from the viewer";
    viewer_is_the_camera, 3, "shade.rs shade", viewer = Viewer::Camera,
        "V points to the camera even for rays that do not come from there: V is −d of the ray";
    viewer_at_the_origin, 3, "shade.rs shade", viewer = Viewer::Origin,
        "V points to the origin of world space, not to the viewer";
    no_diffuse, 3, "shade.rs light_term", diffuse = Diffuse::Absent,
        "there is no diffuse term";
    cosine_squared, 3, "shade.rs light_term", diffuse = Diffuse::Squared,
        "the diffuse term is multiplied by N·L twice";
    cosine_wrapped, 3, "shade.rs light_term", diffuse = Diffuse::Wrapped,
        "the diffuse term has (N·L + 1)/2 where N·L is due";
    diffuse_over_pi, 3, "shade.rs light_term", diffuse = Diffuse::OverPi,
        "the diffuse term is divided by π";
    first_light_only, 3, "shade.rs shade", light_sum = LightSum::First,
        "only the first light counts";
    last_light_only, 3, "shade.rs shade", light_sum = LightSum::Last,
        "only the last light counts: each one replaces the sum of those before";
    mean_of_lights, 3, "shade.rs shade", light_sum = LightSum::Mean,
        "the sum over the lights is divided by their number";
    lights_are_white, 3, "shade.rs shade", coloured_lights = false,
        "every light counts as white: its colour is left out";
    ambient_by_kd, 3, "shade.rs ambient", ambient = Ambient::Kd,
        "the ambient term is multiplied by kd, not by ka";
    ambient_without_ka, 3, "shade.rs ambient", ambient = Ambient::WithoutKa,
        "the ambient term is not multiplied by ka";
    ambient_by_ka_twice, 3, "shade.rs ambient", ambient = Ambient::KaTwice,
        "the ambient term is multiplied by ka twice";
    ambient_weakened, 3, "shade.rs shade", ambient = Ambient::Weakened,
        "distance weakens the ambient term too";
    ambient_blocked, 3, "shade.rs shade", ambient = Ambient::InShadow,
        "a shadow darkens the ambient term too";
}
