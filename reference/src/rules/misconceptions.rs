//! The known mistakes. Each is one change to the rules, with a sentence that explains it to a
//! student.

use crate::rules::{
    Ambient, Attenuation, Bend, BoxRoots, Cutoff, Depth, Diffuse, Emission, Epsilon, Facing, Fov,
    Highlight, InsideBy, Interpolation, Leaving, Mirror, MirrorWeight, Nearest, ObjectRay,
    PlaneSide, ReflectBy, RefractBy, Rules, ShadowReach, SphereNormal, SphereRoots, SquareSize,
    Tint, TotalReflection, TransmitWeight, TriangleNormal, TriangleTest, Turning, Weights,
    WorldNormal,
};

/// A known way to get a rule wrong.
#[derive(Clone, Copy, Debug)]
pub struct Misconception {
    /// A unique name, such as `mirror_backwards`.
    pub id: &'static str,
    /// The rule that the mistake breaks, 1 to 21.
    pub rule: u8,
    /// A sentence for the student on what the program does wrong. It does not give the solution:
    /// that is the rule.
    pub says: &'static str,
    /// The student's function to check, as `file.rs function`.
    pub look_at: &'static str,
    /// The field of [`Rules`] that the mistake changes. A program makes at most one mistake of each
    /// field.
    pub field: &'static str,
    /// Makes the mistake in a set of rules.
    pub apply: fn(&mut Rules),
}

impl Misconception {
    /// Returns the rules of a course with this mistake, in the plain style of a student.
    pub fn in_student_style(&self, rules: &Rules) -> Rules {
        self.on(rules).plain()
    }

    /// Returns the rules of a course with this mistake.
    pub fn on(&self, rules: &Rules) -> Rules {
        let mut rules = *rules;
        (self.apply)(&mut rules);
        rules
    }
}

/// Returns the mistakes that change these rules, in the order of the rules that they break. A
/// mistake that the course itself requires is left out.
pub fn of(rules: &Rules) -> Vec<&'static Misconception> {
    MISCONCEPTIONS.iter().filter(|wrong| wrong.on(rules) != *rules).collect()
}

/// Returns the depth test with one bounce more than `right`. If the course already allows one more
/// than the lecture, that is `right` itself, so that the mistake is left out.
fn one_more(right: Depth) -> Depth {
    if right == Depth::OneMore { right } else { Depth::LessOrEqual }
}

macro_rules! misconceptions {
    ($(
        $id:ident, $rule:literal, $look_at:literal,
        $($field:ident)? $(|$rules:ident| $other:ident)? = $value:expr, $says:literal;
    )*) => {
        /// All mistakes, in the order of the rules that they break. [`of`] leaves out those that a
        /// course requires.
        const MISCONCEPTIONS: &[Misconception] = &[$(Misconception {
            id: stringify!($id),
            rule: $rule,
            says: $says,
            look_at: $look_at,
            field: stringify!($($field)? $($other)?),
            apply: misconceptions!(@apply $($field)? $(|$rules| $other)? = $value),
        },)*];
    };
    (@apply $field:ident = $value:expr) => { |rules| rules.$field = $value };
    (@apply |$rules:ident| $field:ident = $value:expr) => { |$rules| $rules.$field = $value };
}

misconceptions! {
    pixel_corner, 1, "camera.rs eye_ray", pixel_centre = false,
        "the ray goes through the pixel's corner, not its centre";
    pixel_centre, 1, "camera.rs eye_ray", pixel_centre = true,
        "the ray goes through the pixel's centre, not its corner";
    upside_down, 1, "camera.rs eye_ray", |rules| rows_from_top = !rules.rows_from_top,
        "rows are counted from the wrong end, so that the picture is upside down";
    horizontal_fov, 1, "camera.rs eye_ray", fov = Fov::Horizontal,
        "fov is taken for the horizontal angle";
    vertical_fov, 1, "camera.rs eye_ray", fov = Fov::Vertical,
        "fov is taken for the vertical angle";
    stretched, 1, "camera.rs eye_ray", square_pixels = false,
        "the shape of the picture does not widen the view plane, so that pixels are not square";
    eye_ray_not_unit, 1, "camera.rs eye_ray", unit_direction = false,
        "the eye ray's direction is not normalised";
    first_object_wins, 2, "nearest.rs nearest_hit", nearest = Nearest::FirstListed,
        "the first object in the list that is hit wins, not the nearest";
    last_object_wins, 2, "nearest.rs nearest_hit", nearest = Nearest::LastListed,
        "the last object in the list that is hit wins, not the nearest";
    behind_the_eye, 2, "nearest.rs nearest_hit", epsilon = Epsilon::Mistaken(-1e9),
        "hits behind the ray's origin (t < 0) count";
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
    no_shadows, 5, "shadow.rs shadow_attenuation", casts_shadows = false,
        "nothing casts a shadow";
    shadow_beyond_light, 5, "shadow.rs shadow_attenuation", shadow_reach = ShadowReach::Unbounded,
        "the shadow ray goes on behind the light, where nothing can block it";
    light_reversed, 5, "light.rs to_light", towards_light = false,
        "a directional light is sought along its direction of travel; it comes from the other side";
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
    mirror_backwards, 7, "reflection.rs reflect", mirror = Mirror::Backwards,
        "the mirrored direction points the other way: d − 2 (d·N) N has the sign of d";
    mirror_without_two, 7, "reflection.rs reflect", mirror = Mirror::Tangential,
        "the factor 2 of d − 2 (d·N) N is missing";
    perfect_mirror, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::One,
        "mirrored light is not multiplied by kr";
    no_mirror_inside, 7, "reflection.rs reflected_light", mirror_weight = MirrorWeight::OnlyOutside,
        "no ray is mirrored inside an object";
    perfect_glass, 8, "refraction.rs refracted_light", transmit_weight = TransmitWeight::One,
        "transmitted light is not multiplied by kt";
    transmits_the_rest, 8, "refraction.rs \
        refracted_light", transmit_weight = TransmitWeight::OneMinusKr,
        "transmitted light is multiplied by 1 − kr, not by kt";
    eta_inverted, 8, "refraction.rs refract", bend = Bend::Inverted,
        "the ratio of indices is upside down: it is η_i / η_t";
    glass_does_not_bend, 8, "refraction.rs refract", bend = Bend::Straight,
        "light goes through glass without being bent";
    air_is_one, 9, "refraction.rs indices", air = 1.0,
        "the index of air is taken as 1; it is 1.0003";
    air_is_not_one, 9, "refraction.rs indices", air = 1.0003,
        "the index of air is taken as 1.0003; it is 1";
    leaving_as_entering, 9, "refraction.rs indices", leaving = Leaving::AsEntering,
        "the indices are not exchanged on the way out";
    total_reflection_ignored, 10, "refraction.rs \
        refract", total_reflection = TotalReflection::Straight,
        "beyond the critical angle a ray still leaves, straight on";
    total_reflection_grazes, 10, "refraction.rs \
        refract", total_reflection = TotalReflection::Grazing,
        "beyond the critical angle a ray still leaves, along the surface: a negative square is \
            taken as 0";
    total_reflection_is_black, 10, "refraction.rs \
        refracted_light", total_reflection = TotalReflection::Black,
        "beyond the critical angle the mirrored ray is lost as well";
    normal_not_turned, 11, "shade.rs facing_normal", turning = Turning::Nowhere,
        "the outward normal is not negated on the way out";
    shaded_by_outward_normal, 11, "shade.rs facing_normal", turning = Turning::NotShading,
        "inside an object the outward normal is used for shading";
    always_outside, 11, "shade.rs facing_normal", inside_by = InsideBy::Never,
        "every hit is taken for one from outside";
    ambient_inside_not_tinted, 12, "shade.rs ambient", ambient_inside = false,
        "from inside the ambient term is not multiplied by kt";
    ambient_inside_tinted, 12, "shade.rs ambient", ambient_inside = true,
        "from inside the ambient term is multiplied by kt";
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
    sphere_far_root_ignored, 14, "sphere.rs intersect_sphere", sphere_roots = SphereRoots::NearOnly,
        "from inside the sphere nothing is hit: the far root is ignored";
    sphere_far_root_first, 14, "sphere.rs intersect_sphere", sphere_roots = SphereRoots::FarFirst,
        "the far root of the sphere is taken before the near one";
    sphere_assumes_unit_direction, 14, "sphere.rs intersect_sphere",
        sphere_roots = SphereRoots::UnitDirection,
        "the quadratic is solved as if d·d were 1";
    sphere_normal_from_origin, 14, "sphere.rs intersect_sphere",
        sphere_normal = SphereNormal::FromOrigin,
        "the normal is taken from the origin, not from the sphere's centre";
    sphere_normal_inwards, 14, "sphere.rs intersect_sphere", sphere_normal = SphereNormal::Inwards,
        "the sphere's normal points inwards";
    plane_on_other_side, 15, "plane.rs intersect_plane", plane = PlaneSide::NegatedK,
        "the sign of k is wrong: the plane is N·X = k";
    plane_one_sided, 15, "plane.rs intersect_plane", plane = PlaneSide::FrontOnly,
        "the plane is not seen from behind";
    square_twice_as_large, 15, "plane.rs intersect_square", square = SquareSize::One,
        "the square goes from −1 to 1; it goes from −0.5 to 0.5";
    square_is_a_disc, 15, "plane.rs intersect_square", square = SquareSize::Disc,
        "the square is a disc";
    box_missed_from_inside, 15, "cuboid.rs intersect_box", box_roots = BoxRoots::NearOnly,
        "from inside the box nothing is hit";
    triangle_culled, 16, "triangle.rs intersect_triangle", triangle = TriangleTest::FrontOnly,
        "triangles are not seen from behind";
    triangle_without_third_edge, 16, "triangle.rs intersect_triangle",
        triangle = TriangleTest::TwoEdges,
        "the edge from B to C is not tested";
    triangle_normal_reversed, 16, "triangle.rs intersect_triangle",
        triangle_normal = TriangleNormal::Left,
        "the triangle's normal points the other way: it is along (B − A) × (C − A)";
    weights_swapped, 17, "smooth.rs barycentric", weights = Weights::Swapped,
        "β and γ are exchanged";
    weights_rotated, 17, "smooth.rs barycentric", weights = Weights::Rotated,
        "each vertex gets the weight of its neighbour";
    interpolated_normal_not_unit, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::NotUnit,
        "the interpolated normal is not normalised";
    flat_shading, 18, "smooth.rs interpolate_normal", interpolation = Interpolation::Absent,
        "vertex normals are not used";
    nearest_vertex_normal, 18, "smooth.rs interpolate_normal",
        interpolation = Interpolation::NearestVertex,
        "the nearest vertex's normal is taken, not the mix of all three";
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
    origin_not_transformed, 20, "transform.rs \
        ray_to_object", object_ray = ObjectRay::OriginNotMoved,
        "the ray's origin is not taken to object space";
    normal_by_matrix, 20, "transform.rs normal_to_world", world_normal = WorldNormal::ByMatrix,
        "the normal is transformed by M; it needs the transpose of the inverse";
    normal_by_inverse, 20, "transform.rs normal_to_world", world_normal = WorldNormal::ByInverse,
        "the normal is transformed by the inverse, which is not transposed";
    world_normal_not_unit, 20, "transform.rs normal_to_world", world_normal = WorldNormal::NotUnit,
        "the normal is not normalised after the transformation";
    normal_not_transformed, 20, "transform.rs \
        normal_to_world", world_normal = WorldNormal::Untransformed,
        "the normal stays in object space";
    no_epsilon, 21, "reflection.rs reflected_light", epsilon = Epsilon::Mistaken(0.0),
        "a ray that leaves a surface hits the same surface again: RAY_EPSILON is missing";
    large_epsilon, 21, "reflection.rs reflected_light", epsilon = Epsilon::Mistaken(0.05),
        "RAY_EPSILON is so large that rays jump over what touches the surface";
}
