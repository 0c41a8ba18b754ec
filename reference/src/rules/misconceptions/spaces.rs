//! Mistakes in interpolated normals, transforms and the start of rays. [rule 18] to [rule 21]

use cases::Effect;

use super::kind::Misconception;
use crate::rules::{
    Epsilon, InsideBy, InterpolatedIn, Interpolation, ObjectRay, ReflectBy, RefractBy, WorldNormal,
};

misconceptions! {
    SPACES:
    interpolated_normal_not_unit, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::NotUnit,
        "the interpolated normal is not normalised";
    flat_shading, 18, "smooth.rs interpolate_normal", interpolation = Interpolation::Absent,
        "vertex normals are not used";
    nearest_vertex_normal, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::NearestVertex,
        "the nearest vertex's normal is taken, not the mix of all three";
    first_vertex_normal, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::FirstVertex,
        "the first vertex's normal is taken, not the mix of all three";
    interpolated_normal_reversed, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::Reversed,
        "the interpolated normal points the other way";
    unlisted_smooth_normals, 18, "smooth.rs interpolate_normal",
        unlisted = Some(Effect::SmoothNormals),
        "normals are interpolated even where the scene does not list that";
    mirror_into_the_object, 19, "smooth.rs smooth_reflect", reflect_by = ReflectBy::Interpolated,
        "rays are mirrored by the interpolated normal, even where they then enter the object";
    mirror_by_fallback, 19, "smooth.rs smooth_reflect", reflect_by = ReflectBy::WithFallback,
        "where the mirrored ray would enter the object it is recomputed with the geometric normal";
    mirror_by_geometric_normal, 19, "smooth.rs smooth_reflect", reflect_by = ReflectBy::Geometric,
        "rays are mirrored by the geometric normal";
    refract_without_retest, 19, "smooth.rs smooth_refract", refract_by = RefractBy::Interpolated,
        "rays are refracted by the interpolated normal, even where they then do not cross the \
            surface";
    refract_by_fallback, 19, "smooth.rs smooth_refract", refract_by = RefractBy::WithFallback,
        "where the transmitted ray would not cross the surface it is recomputed with the \
            geometric normal";
    refract_by_geometric_normal, 19, "smooth.rs smooth_refract", refract_by = RefractBy::Geometric,
        "rays are refracted by the geometric normal";
    inside_by_interpolated_normal, 19, "shade.rs facing_normal", inside_by = InsideBy::Interpolated,
        "the interpolated normal decides between inside and outside; the geometric one must";
    inside_by_geometric_normal, 19, "shade.rs facing_normal", inside_by = InsideBy::Geometric,
        "the geometric normal decides between inside and outside; the interpolated one must";
    direction_renormalised, 20, "transform.rs ray_to_object", object_ray = ObjectRay::Renormalised,
        "the direction is normalised in object space, so that t no longer holds in world space";
    direction_translated, 20, "transform.rs ray_to_object", object_ray = ObjectRay::Translated,
        "the translation is applied to the ray's direction";
    origin_not_transformed, 20, "transform.rs ray_to_object",
        object_ray = ObjectRay::OriginNotMoved,
        "the ray's origin is not taken to object space";
    normal_by_matrix, 20, "transform.rs normal_to_world", world_normal = WorldNormal::ByMatrix,
        "the normal is transformed by M; it needs the transpose of the inverse";
    normal_by_inverse, 20, "transform.rs normal_to_world", world_normal = WorldNormal::ByInverse,
        "the normal is transformed by the inverse, which is not transposed";
    world_normal_not_unit, 20, "transform.rs normal_to_world", world_normal = WorldNormal::NotUnit,
        "the normal is not normalised after the transformation";
    normal_not_transformed, 20, "transform.rs normal_to_world",
        world_normal = WorldNormal::Untransformed,
        "the normal stays in object space";
    direction_not_transformed, 20, "transform.rs ray_to_object",
        object_ray = ObjectRay::DirectionNotMoved,
        "the ray's direction is not taken to object space";
    origin_not_translated, 20, "transform.rs ray_to_object", object_ray = ObjectRay::OriginAsVector,
        "the ray's origin is not translated: it is transformed like a direction";
    ray_end_lost, 20, "transform.rs ray_to_object", object_ray = ObjectRay::EndLost,
        "in object space the ray has no end: a shadow ray hits what is behind the light";
    normal_by_transpose, 20, "transform.rs normal_to_world",
        world_normal = WorldNormal::ByTranspose,
        "the normal is transformed by the transpose of M; it needs the transpose of the inverse";
    normal_translated, 20, "transform.rs normal_to_world", world_normal = WorldNormal::AsPoint,
        "the normal is translated as points are";
    normal_turned_by_mirror, 20, "transform.rs normal_to_world",
        world_normal = WorldNormal::TurnedByMirror,
        "the normal is negated where M mirrors";
    interpolated_in_world_space, 20, "smooth.rs interpolate_normal",
        interpolated_in = InterpolatedIn::WorldSpace,
        "vertex normals are taken to world space before they are interpolated, not after";
    no_epsilon, 21, "reflection.rs reflected_light", epsilon = Epsilon::Mistaken(0.0),
        "a ray that leaves a surface hits the same surface again: RAY_EPSILON is missing";
    large_epsilon, 21, "reflection.rs reflected_light", epsilon = Epsilon::Mistaken(0.05),
        "RAY_EPSILON is so large that rays jump over what touches the surface";
}
