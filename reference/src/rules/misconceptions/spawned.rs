//! Mistakes in reflection, refraction and the recursion. [rule 7] to [rule 13]

use cases::Effect;

use super::kind::Misconception;
use crate::rules::{
    Background, Bend, Cut, Cutoff, Depth, Index, InsideAmbient, InsideBy, Leaving, Mirror,
    MirrorWeight, Mixing, Outside, TotalReflection, TransmitWeight, Turning,
};

/// Returns the depth test with one bounce more than `right`. If the course already allows one more
/// than the lecture, that is `right` itself, so that the mistake is left out.
fn one_more(right: Depth) -> Depth {
    if right == Depth::OneMore { right } else { Depth::LessOrEqual }
}

misconceptions! {
    SPAWNED_RAYS:
    mirror_backwards, 7, "reflection.rs reflect", mirror = Mirror::Backwards,
        "the mirrored direction points the other way: d − 2 (d·N) N has the sign of d";
    mirror_without_two, 7, "reflection.rs reflect", mirror = Mirror::Tangential,
        "the factor 2 of d − 2 (d·N) N is missing";
    perfect_mirror, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::One,
        "mirrored light is not multiplied by kr";
    no_mirror_inside, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::OnlyOutside,
        "no ray is mirrored inside an object";
    mirror_plus, 7, "reflection.rs reflect", mirror = Mirror::Plus,
        "2 (d·N) N is added to d, not subtracted";
    mirror_by_ks, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::Ks,
        "mirrored light is multiplied by ks, not by kr";
    mirror_by_kr_twice, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::Squared,
        "mirrored light is multiplied by kr twice";
    mirror_by_schlick, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::Schlick,
        "kr grows towards grazing angles, as by Schlick's formula; it is the same at all angles";
    mirror_blends, 7, "trace.rs trace", mixing = Mixing::OneMinusKr,
        "a mirror's own light is multiplied by 1 − kr; mirrored light is added to all of it";
    mirror_replaces, 7, "trace.rs trace", mixing = Mixing::MirrorReplaces,
        "mirrored light replaces the surface's own light; it is added";
    spawned_light_cut, 7, "trace.rs trace", cut = Cut::Spawned,
        "the light of a mirrored or transmitted ray is cut at 1 before it is weighted";
    surface_light_cut, 7, "shade.rs shade", cut = Cut::Surface,
        "a surface's own light is cut at 1 before mirrors and glass weight it";
    unlisted_mirrors, 7, "trace.rs trace", unlisted = Some(Effect::Reflection),
        "mirrors are simulated even where the scene does not list reflection";
    background_black_in_mirrors, 7, "trace.rs trace", background = Background::BlackForSpawned,
        "a mirrored or transmitted ray that hits nothing returns black, not the background";
    perfect_glass, 8, "refraction.rs refracted_light", transmit_weight = TransmitWeight::One,
        "transmitted light is not multiplied by kt";
    transmits_the_rest, 8, "refraction.rs refracted_light",
        transmit_weight = TransmitWeight::OneMinusKr,
        "transmitted light is multiplied by 1 − kr, not by kt";
    eta_inverted, 8, "refraction.rs refract", bend = Bend::Inverted,
        "the ratio of indices is upside down: it is η_i / η_t";
    glass_does_not_bend, 8, "refraction.rs refract", bend = Bend::Straight,
        "light goes through glass without being bent";
    glass_by_kr, 8, "refraction.rs refracted_light", transmit_weight = TransmitWeight::Kr,
        "transmitted light is multiplied by kr, not by kt";
    glass_tints_on_entry, 8, "refraction.rs refracted_light",
        transmit_weight = TransmitWeight::OnEntry,
        "transmitted light is multiplied by kt on the way in only";
    no_way_out_of_glass, 8, "refraction.rs refracted_light",
        transmit_weight = TransmitWeight::NoWayOut,
        "no ray leaves an object again";
    glass_tints_by_length, 8, "refraction.rs refracted_light",
        transmit_weight = TransmitWeight::ByLength,
        "kt is raised to the length of the way inside, as if the colour were in the volume";
    refract_cosine_reversed, 8, "refraction.rs refract", bend = Bend::CosineReversed,
        "cos θ_i has the wrong sign: it is −d·N";
    refract_ratio_not_squared, 8, "refraction.rs refract", bend = Bend::RatioNotSquared,
        "the ratio of indices is not squared under the root";
    refract_root_added, 8, "refraction.rs refract", bend = Bend::PlusRoot,
        "cos θ_t N is added, not subtracted, so that T comes back out of the surface";
    glass_blends, 8, "trace.rs trace", mixing = Mixing::OneMinusKt,
        "glass's own light is multiplied by 1 − kt; transmitted light is added to all of it";
    glass_replaces, 8, "trace.rs trace", mixing = Mixing::GlassReplaces,
        "transmitted light replaces all other light of the surface; it is added";
    unlisted_glass, 8, "trace.rs trace", unlisted = Some(Effect::Refraction),
        "refraction is simulated even where the scene does not list it";
    air_is_one, 9, "refraction.rs indices", air = 1.0,
        "the index of air is taken as 1; it is 1.0003";
    air_is_not_one, 9, "refraction.rs indices", air = 1.0003,
        "the index of air is taken as 1.0003; it is 1";
    leaving_as_entering, 9, "refraction.rs indices", leaving = Leaving::AsEntering,
        "the indices are not exchanged on the way out";
    index_always_glass, 9, "refraction.rs indices", index = Index::Glass,
        "every object has the index 1.5, whatever its material";
    nested_media, 9, "refraction.rs refracted_light", outside = Outside::ObjectAround,
        "outside an object within another, the index is that of the other; it is that of air";
    total_reflection_ignored, 10, "refraction.rs refract",
        total_reflection = TotalReflection::Straight,
        "beyond the critical angle a ray still leaves, straight on";
    total_reflection_grazes, 10, "refraction.rs refract",
        total_reflection = TotalReflection::Grazing,
        "beyond the critical angle a ray still leaves, along the surface: a negative square is \
            taken as 0";
    total_reflection_is_black, 10, "refraction.rs refracted_light",
        total_reflection = TotalReflection::Black,
        "beyond the critical angle the mirrored ray is lost as well";
    total_reflection_by_kt, 10, "refraction.rs refracted_light",
        total_reflection = TotalReflection::MirroredByKt,
        "beyond the critical angle, the mirrored ray is added once more with the weight kt";
    total_reflection_shows_background, 10, "refraction.rs refracted_light",
        total_reflection = TotalReflection::Background,
        "beyond the critical angle, kt times the background is added";
    normal_not_turned, 11, "shade.rs facing_normal", turning = Turning::Nowhere,
        "the outward normal is not negated on the way out";
    shaded_by_outward_normal, 11, "shade.rs facing_normal", turning = Turning::NotShading,
        "inside an object the outward normal is used for shading";
    always_outside, 11, "shade.rs facing_normal", inside_by = InsideBy::Never,
        "every hit is taken for one from outside";
    inside_reversed, 11, "shade.rs facing_normal", inside_by = InsideBy::Reversed,
        "rays from outside are taken for rays from inside, and the other way round";
    ambient_inside_not_tinted, 12, "shade.rs ambient", ambient_inside = InsideAmbient::AsOutside,
        "from inside the ambient term is not multiplied by kt";
    ambient_inside_tinted, 12, "shade.rs ambient", ambient_inside = InsideAmbient::TimesKt,
        "from inside the ambient term is multiplied by kt";
    no_ambient_inside, 12, "shade.rs ambient", ambient_inside = InsideAmbient::Absent,
        "from inside there is no ambient term";
    ambient_inside_by_rest, 12, "shade.rs ambient", ambient_inside = InsideAmbient::OneMinusKt,
        "from inside the ambient term is multiplied by 1 − kt, not by kt";
    one_bounce_too_many, 13, "reflection.rs goes_on", |rules| depth = one_more(rules.depth),
        "a ray of depth max_depth still spawns rays";
    last_bounce_missing, 13, "reflection.rs goes_on", depth = Depth::Less,
        "a ray of depth max_depth spawns no more";
    one_bounce_too_few, 13, "reflection.rs goes_on", depth = Depth::OneLess,
        "a ray of depth max_depth − 1 spawns no more";
    cutoff_by_any_channel, 13, "reflection.rs goes_on", cutoff = Cutoff::AnyChannel,
        "a path ends where one channel falls below the threshold; all must";
    cutoff_by_all_channels, 13, "reflection.rs goes_on", cutoff = Cutoff::AllChannels,
        "a path goes on until all channels fall below the threshold; one is enough";
    cutoff_ignored, 13, "reflection.rs goes_on", cutoff = Cutoff::Absent,
        "the threshold is ignored";
    cutoff_by_last_surface, 13, "reflection.rs reflected_light", cutoff = Cutoff::LastOnly,
        "the threshold is compared with the last surface's kr or kt, not with the product along \
            the path";
    faint_rays_not_cast, 13, "reflection.rs reflected_light", casts_faint_rays = false,
        "a ray whose weight is below the threshold is not cast; it still brings back its own \
            light, and spawns no more";
    only_eye_rays_spawn, 13, "reflection.rs goes_on", depth = Depth::EyeOnly,
        "only eye rays spawn rays, whatever max_depth is";
    depth_of_five, 13, "reflection.rs goes_on", depth = Depth::Five,
        "rays up to depth 4 spawn rays, whatever max_depth is";
    depth_counted_twice, 13, "reflection.rs reflected_light", depth_step = 2,
        "a spawned ray is two levels deeper, not one";
    cutoff_by_mean, 13, "reflection.rs goes_on", cutoff = Cutoff::Mean,
        "the mean of the channels is compared with the threshold; all must be below";
    cutoff_includes_equal, 13, "reflection.rs goes_on", cutoff = Cutoff::OrEqual,
        "a path ends where its weight equals the threshold; it must be below";
}
