//! Mistakes in shapes. [rule 14] to [rule 17]

use super::kind::Misconception;
use crate::rules::{
    BoxNormal, BoxRoots, ConeNormal, Lids, PlaneSide, RoundSide, SphereNormal, SphereRoots,
    SquareSize, SquaredRadius, TriangleNormal, TriangleTest, Weights,
};

misconceptions! {
    SHAPES:
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
    sphere_discriminant_without_four, 14, "sphere.rs intersect_sphere",
        sphere_roots = SphereRoots::FourMissing,
        "the discriminant is b² − ac with b = 2 (f·d): the 4 before ac is missing, or the 2 is too \
            much";
    sphere_radius_one, 14, "sphere.rs intersect_sphere", squared_radius = SquaredRadius::One,
        "every sphere has the radius 1";
    radius_as_diameter, 14, "sphere.rs intersect_sphere", squared_radius = SquaredRadius::Halved,
        "the radius is taken for the diameter";
    radius_not_squared, 14, "sphere.rs intersect_sphere",
        squared_radius = SquaredRadius::NotSquared,
        "the radius is not squared";
    sphere_normal_not_unit, 14, "sphere.rs intersect_sphere", sphere_normal = SphereNormal::NotUnit,
        "the sphere's normal is as long as the radius";
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
    plane_through_origin, 15, "plane.rs intersect_plane", plane = PlaneSide::ThroughOrigin,
        "every plane goes through the origin: k is left out";
    square_from_zero, 15, "plane.rs intersect_square", square = SquareSize::FromZero,
        "the square goes from 0 to 1; it goes from −0.5 to 0.5";
    square_normal_reversed, 15, "plane.rs intersect_square", square_faces_z = false,
        "the square's normal points along −z";
    box_exit_first, 15, "cuboid.rs intersect_box", box_roots = BoxRoots::FarFirst,
        "the exit from the box is taken before the entry";
    box_normal_inwards, 15, "cuboid.rs intersect_box", box_normal = BoxNormal::Inwards,
        "the box's normal points inwards";
    box_normal_from_origin, 15, "cuboid.rs intersect_box", box_normal = BoxNormal::FromOrigin,
        "the face of the box is found by the greatest coordinate of the point, as only in a cube \
            about the origin";
    lids_forgotten, 15, "round.rs intersect_cylinder", lids = Lids::Never,
        "no cylinder and no cone is closed";
    lids_everywhere, 15, "round.rs intersect_cylinder", lids = Lids::Always,
        "every cylinder and every cone is closed";
    round_without_ends, 15, "round.rs intersect_cylinder", round_side = RoundSide::Endless,
        "the sides of cylinders and cones go on beyond their ends";
    round_near_side_only, 15, "round.rs intersect_cylinder", round_side = RoundSide::NearOnly,
        "the inner sides of cylinders and cones are not seen: the far root is ignored";
    cone_normal_horizontal, 15, "round.rs intersect_cone", cone_normal = ConeNormal::Horizontal,
        "a cone's normal is perpendicular to its axis, as only a cylinder's is";
    triangle_culled, 16, "triangle.rs intersect_triangle", triangle = TriangleTest::FrontOnly,
        "triangles are not seen from behind";
    triangle_without_third_edge, 16, "triangle.rs intersect_triangle",
        triangle = TriangleTest::TwoEdges,
        "the edge from B to C is not tested";
    triangle_normal_reversed, 16, "triangle.rs intersect_triangle",
        triangle_normal = TriangleNormal::Left,
        "the triangle's normal points the other way: it is along (B − A) × (C − A)";
    triangle_without_first_edge, 16, "triangle.rs intersect_triangle",
        triangle = TriangleTest::WithoutAb,
        "the edge from A to B is not tested";
    triangle_is_a_plane, 16, "triangle.rs intersect_triangle", triangle = TriangleTest::WholePlane,
        "no edge is tested: a triangle is its whole plane";
    triangle_normal_not_unit, 16, "triangle.rs intersect_triangle",
        triangle_normal = TriangleNormal::NotUnit,
        "the triangle's normal is not normalised";
    weights_swapped, 17, "smooth.rs barycentric", weights = Weights::Swapped,
        "β and γ are exchanged";
    weights_rotated, 17, "smooth.rs barycentric", weights = Weights::Rotated,
        "each vertex gets the weight of its neighbour";
    weights_of_ab_swapped, 17, "smooth.rs barycentric", weights = Weights::FirstSwapped,
        "α and β are exchanged";
    weights_equal, 17, "smooth.rs barycentric", weights = Weights::Equal,
        "all vertices have the same weight";
}
