//! Mistakes in eye rays and in the search for hits. [rule 1] to [rule 2]

use super::kind::Misconception;
use crate::rules::{Aspect, Background, Epsilon, Fov, HalfAngle, Nearest, Searched, Span};

misconceptions! {
    EYE_RAYS_AND_HITS:
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
    stretched, 1, "camera.rs eye_ray", aspect = Aspect::Ignored,
        "the shape of the picture does not widen the view plane, so that pixels are not square";
    eye_ray_not_unit, 1, "camera.rs eye_ray", unit_direction = false,
        "the eye ray's direction is not normalised";
    fov_not_halved, 1, "camera.rs eye_ray", half_angle = HalfAngle::Whole,
        "the view plane is scaled by the tangent of the whole angle, not of its half";
    tangent_halved, 1, "camera.rs eye_ray", half_angle = HalfAngle::HalfOfTangent,
        "the tangent is halved, not the angle";
    degrees_as_radians, 1, "camera.rs eye_ray", half_angle = HalfAngle::Radians,
        "the angle in degrees is taken for one in radians";
    aspect_inverted, 1, "camera.rs eye_ray", aspect = Aspect::Inverted,
        "x is divided by the ratio of width to height; it is multiplied by it";
    aspect_on_y, 1, "camera.rs eye_ray", aspect = Aspect::Heightens,
        "the ratio of width to height scales y, not x";
    from_edge_to_edge, 1, "camera.rs eye_ray", span = Span::EdgeToEdge,
        "the outermost pixels lie on the border of the view: i is divided by w − 1, not i + ½ by w";
    from_the_view_plane, 1, "camera.rs eye_ray", starts_at_eye = false,
        "the ray starts on the view plane, not at the eye: what is nearer is cut off";
    up_not_perpendicular, 1, "camera.rs eye_ray", level_up = false,
        "the y axis is taken for the camera's up: only its part perpendicular to the view counts";
    first_object_wins, 2, "nearest.rs nearest_hit", nearest = Nearest::FirstListed,
        "the first object in the list that is hit wins, not the nearest";
    last_object_wins, 2, "nearest.rs nearest_hit", nearest = Nearest::LastListed,
        "the last object in the list that is hit wins, not the nearest";
    behind_the_eye, 2, "nearest.rs nearest_hit", epsilon = Epsilon::Mistaken(-1e9),
        "hits behind the ray's origin (t < 0) count";
    farthest_hit, 2, "nearest.rs nearest_hit", nearest = Nearest::Farthest,
        "the farthest hit wins, not the nearest";
    last_of_equal_wins, 2, "nearest.rs nearest_hit", nearest = Nearest::LastOfEqual,
        "of two hits at the same t, the object that is listed last wins, not the first";
    first_object_forgotten, 2, "nearest.rs nearest_hit", searched = Searched::NotFirst,
        "the first object in the list is never tested";
    last_object_forgotten, 2, "nearest.rs nearest_hit", searched = Searched::NotLast,
        "the last object in the list is never tested";
    no_background, 2, "trace.rs trace", background = Background::Black,
        "a ray that hits nothing returns black, not the background";
}
