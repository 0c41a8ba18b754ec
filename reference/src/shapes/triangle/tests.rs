//! Tests of `triangle.rs`.

use super::*;
use crate::rules::Lecture;

fn vec(v: [f64; 3]) -> Vec3<f64> {
    Vec3::new(v[0], v[1], v[2])
}

/// Checks a ray against the triangle (0,0,0) (4,0,0) (0,4,0).
fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<(f64, [f64; 3])>) {
    let triangle =
        Triangle { corners: [vec([0.0; 3]), vec([4.0, 0.0, 0.0]), vec([0.0, 4.0, 0.0])] };
    let ray = Ray::leaving(Lecture, vec(origin), vec(direction));
    let hit = triangle.intersect(Lecture, &ray, &Shear::of(&ray), 7);
    let found = hit.map(|m| (m.t, m.weights));
    assert_eq!(found, expected.map(|(t, w)| (t, vec(w))), "from {origin:?} along {direction:?}");
    if let Some(hit) = hit {
        assert_eq!(barycentric(Lecture, triangle.corners, ray.at(hit.t)), hit.weights);
    }
}

#[test]
fn hits_computed_on_paper() {
    check([1.0, 1.0, 3.0], [0.0, 0.0, -1.0], Some((3.0, [0.5, 0.25, 0.25])));
    // from behind, t in units of d
    check([1.0, 1.0, -3.0], [0.0, 0.0, 2.0], Some((1.5, [0.5, 0.25, 0.25])));
    check([2.0, 2.0, 3.0], [0.0, 0.0, -1.0], Some((3.0, [0.0, 0.5, 0.5]))); // the edge BC
    check([4.0, 0.0, 3.0], [0.0, 0.0, -1.0], Some((3.0, [0.0, 1.0, 0.0]))); // the corner B
    check([2.1, 2.0, 3.0], [0.0, 0.0, -1.0], None);
    check([1.0, 1.0, 3.0], [0.0, 0.0, 1.0], None); // behind
    check([-3.0, 1.0, 0.0], [1.0, 0.0, 0.0], None); // edge on
    check([-1.0, 1.0, 2.0], [1.0, 0.0, -1.0], Some((2.0, [0.5, 0.25, 0.25])));
}

#[test]
fn no_ray_slips_between_two_triangles_that_share_an_edge() {
    let (a, b) = (vec([0.1, 0.7, -0.3]), vec([1.3, -0.2, 0.4]));
    let sides = [vec([1.5, 1.1, 0.2]), vec([-0.4, -0.9, -0.6])];
    let origin = vec([0.37, 0.21, 5.0]);
    for step in 1..1000 {
        let aim = a + (b - a) * (f64::from(step) / 1000.0);
        let ray = Ray::leaving(Lecture, origin, (aim - origin).normalised());
        let intersects =
            |corners| Triangle { corners }.intersect(Lecture, &ray, &Shear::of(&ray), 0).is_some();
        assert!(
            intersects([a, b, sides[0]]) || intersects([b, a, sides[1]]),
            "lost at step {step}"
        );
    }
}

#[test]
fn a_triangle_without_area_is_never_hit() {
    let line = Triangle { corners: [vec([0.0; 3]), vec([1.0, 0.0, 0.0]), vec([2.0, 0.0, 0.0])] };
    assert!(!line.has_area());
    let ray = Ray::leaving(Lecture, vec([1.0, 0.0, 3.0]), vec([0.0, 0.0, -1.0]));
    assert_eq!(line.intersect(Lecture, &ray, &Shear::of(&ray), 0), None);
}
