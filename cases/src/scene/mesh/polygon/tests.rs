//! Polygons with triangles computed by hand, and random ones whose triangles are checked exactly.

use std::collections::HashMap;

use fastrand::Rng;
use glam::{DMat3, DVec3};
use robust::orient2d;

use super::plane::{Plane, Point, order};
use super::{PolygonError, sweep, triangulate};

fn flat(corners: &[[f64; 2]]) -> Vec<Point> {
    corners.iter().map(|[x, y]| Point { x: *x, y: *y }).collect()
}

fn in_space(corners: &[[f64; 2]]) -> Vec<DVec3> {
    corners.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect()
}

/// Turns each triangle so that its least corner comes first, and sorts the triangles.
fn sorted(triangles: &[[usize; 3]]) -> Vec<[usize; 3]> {
    let turned = |[a, b, c]: [usize; 3]| {
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or_default()
    };
    let mut all: Vec<_> = triangles.iter().copied().map(turned).collect();
    all.sort_unstable();
    all
}

const CONVEX: &[[f64; 2]] = &[[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [2.0, 2.0], [0.0, 2.0]];
const DART: &[[f64; 2]] = &[[0.0, 0.0], [4.0, -2.0], [1.0, 0.0], [4.0, 2.0]];
const DART_TURNED: &[[f64; 2]] = &[[4.0, -2.0], [1.0, 0.0], [4.0, 2.0], [0.0, 0.0]];
const ROW: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
const REPEATED: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]];
const SPIKE: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [5.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
/// A triangle with a hole in it, and a bridge from corner 0 to the hole's corner 4.
const KEYHOLE: &[[f64; 2]] = &[
    [0.0, 0.0],
    [8.0, 0.0],
    [0.0, 8.0],
    [0.0, 0.0],
    [1.0, 1.0],
    [1.0, 3.0],
    [3.0, 1.0],
    [1.0, 1.0],
];

#[test]
fn triangles_are_those_on_paper() {
    for (name, corners, expected) in [
        ("a fan, in this order", CONVEX, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]][..]),
        ("a dart", DART, &[[0, 1, 2], [0, 2, 3]]),
        ("the dart from another corner", DART_TURNED, &[[0, 1, 3], [1, 2, 3]]),
        ("three corners in a row: none is lost", ROW, &[[0, 1, 3], [1, 2, 3]]),
        ("repeated corners", REPEATED, &[[0, 1, 3]]),
        ("a spike without area", SPIKE, &[[0, 1, 4]]),
    ] {
        let found = triangulate(&in_space(corners)).unwrap();
        assert_eq!(sorted(&found), expected, "{name}");
        if name.starts_with("a fan") {
            assert_eq!(found, expected);
        }
    }
    let hole = triangulate(&in_space(KEYHOLE)).unwrap();
    let area = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|n| in_space(KEYHOLE)[n]);
        (b - a).cross(c - a).z / 2.0
    };
    assert_eq!(hole.iter().map(|abc| area(*abc)).sum::<f64>(), 32.0 - 2.0);
    assert_eq!(hole.len(), 6);
}

#[test]
fn what_is_no_surface_is_refused() {
    let height = |z: f64| [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, z), DVec3::Y];
    let star: Vec<DVec3> = [0, 2, 4, 1, 3].map(|n| in_space(CONVEX)[n]).to_vec();
    let fold =
        [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.1), DVec3::new(0.0, 0.0, 0.2), DVec3::Y];
    let bow_tie = |flip: fn(DVec3) -> DVec3| {
        [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]].map(|[x, y]| flip(DVec3::new(x, y, 0.0)))
    };
    for (name, corners, is_right) in [
        ("a bow tie", &bow_tie(|v| v)[..], false),
        ("a bow tie in the plane x = 0", &bow_tie(|v| DVec3::new(0.0, v.x, v.y)), false),
        ("a star of five points", &star, false),
        ("two corners above one another", &fold, false),
        (
            "an edge through a corner",
            &in_space(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]]),
            false,
        ),
        (
            "a way walked twice",
            &in_space(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
            false,
        ),
        (
            "two triangles that share a corner, run opposite ways",
            &in_space(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [-1.0, 0.0], [-1.0, 1.0]]),
            false,
        ),
        ("a square bent by a little", &height(0.5), true),
        ("a square bent by a lot", &height(0.8), false),
        (
            "a line there and back",
            &[DVec3::ZERO, DVec3::ONE, DVec3::splat(0.3), DVec3::splat(0.7)],
            true,
        ),
        (
            "a line up to rounding",
            &[
                DVec3::ZERO,
                DVec3::new(0.1, 0.3, 0.0),
                DVec3::new(0.2, 0.6, 0.0),
                DVec3::new(0.05, 0.15, 0.0),
            ],
            true,
        ),
        ("one point", &[DVec3::ONE; 5], true),
    ] {
        assert_eq!(triangulate(corners).is_ok(), is_right, "{name}: {:?}", triangulate(corners));
    }
    // The corners lie z/4 above or below the mean plane, along a normal with z = 2/√(4 + 2z²).
    let Err(PolygonError::Bent(share)) = triangulate(&height(0.8)) else { panic!("bent") };
    assert!((share - 0.2 * 2.0 / (4.0_f64 + 1.28).sqrt() / 2.64_f64.sqrt()).abs() < 1e-12);
}

/// Returns twice the area, which is exact for small whole numbers.
fn double_area(corners: &[Point]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.x * b.y - a.y * b.x).sum()
}

/// Returns whether the triangles are a triangulation.
///
/// Each must have the polygon's orientation, and every edge must belong to the polygon or to two
/// triangles that run along it in opposite directions.
fn is_triangulation(corners: &[Point], triangles: &[[usize; 3]]) -> bool {
    let side = double_area(corners).signum();
    let mut edges: HashMap<(usize, usize), i32> = HashMap::new();
    let mut walk = |from: usize, to: usize, by: i32| {
        *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { by } else { -by };
    };
    (0..corners.len()).for_each(|n| walk(n, (n + 1) % corners.len(), -1));
    for [a, b, c] in triangles {
        [(a, b), (b, c), (c, a)].into_iter().for_each(|(from, to)| walk(*from, *to, 1));
    }
    let turns_right =
        |[a, b, c]: &[usize; 3]| orient2d(corners[*a], corners[*b], corners[*c]) * side > 0.0;
    triangles.len() == corners.len() - 2
        && triangles.iter().all(turns_right)
        && edges.values().all(|sum| *sum == 0)
}

/// Returns how often the closed path goes around the point, which lies on no edge.
fn winding(corners: &[Point], point: Point) -> i32 {
    let next = corners.iter().cycle().skip(1);
    let crossing = |(a, b): (&Point, &Point)| match (a.y <= point.y, b.y <= point.y) {
        (true, false) if orient2d(*a, *b, point) > 0.0 => 1,
        (false, true) if orient2d(*a, *b, point) < 0.0 => -1,
        _ => 0,
    };
    corners.iter().zip(next).map(crossing).sum()
}

/// Returns whether no two edges have a point in common except the corner between neighbours.
fn is_simple(corners: &[Point]) -> bool {
    let n = corners.len();
    let at = |n: usize| corners[n % corners.len()];
    let side = |a, b, c| orient2d(a, b, c).partial_cmp(&0.0).map_or(0, |order| order as i32);
    let is_within = |a: Point, b: Point, p: Point| {
        let (low, high) = if order(a, b).is_lt() { (a, b) } else { (b, a) };
        side(a, b, p) == 0 && order(low, p).is_le() && order(p, high).is_le()
    };
    let intersect = |i: usize, j: usize| {
        let (a, b, c, d) = (at(i), at(i + 1), at(j), at(j + 1));
        let cross = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
        match (j == i + 1, (j + 1) % n == i) {
            (true, true) => false,
            (true, _) => order(a, b).is_eq() || is_within(a, b, d) || is_within(b, d, a),
            (_, true) => order(a, b).is_eq() || is_within(c, a, b) || is_within(a, b, c),
            _ => {
                cross
                    || is_within(a, b, c)
                    || is_within(a, b, d)
                    || is_within(c, d, a)
                    || is_within(c, d, b)
            }
        }
    };
    (0..n).all(|i| (i + 1..n).all(|j| !intersect(i, j)))
}

#[test]
fn small_polygons_are_triangulated_exactly_or_refused() {
    let mut dice = Rng::with_seed(7);
    let (mut n_simple, mut n_weak, mut n_refused) = (0, 0, 0);
    for _ in 0..200_000 {
        let (n, size) = (3 + dice.usize(..7), 2 + dice.usize(..6));
        let corners: Vec<Point> = (0..n)
            .map(|_| Point { x: dice.usize(..size) as f64, y: dice.usize(..size) as f64 })
            .collect();
        let found = sweep::triangles(&Plane::of(&corners));
        if is_simple(&corners) {
            n_simple += 1;
            assert!(
                is_triangulation(&corners, &found.clone().expect("refused")),
                "{corners:?}: {found:?}"
            );
        } else if let Some(found) = found {
            n_weak += 1;
            let point = Point { x: dice.f64() * size as f64, y: dice.f64() * size as f64 };
            let covers = |abc: &&[usize; 3]| winding(&abc.map(|n| corners[n]), point) != 0;
            let n_covers = found.iter().filter(covers).count();
            assert_eq!(
                n_covers,
                winding(&corners, point).unsigned_abs() as usize,
                "{corners:?}: {found:?}"
            );
        } else {
            n_refused += 1;
        }
    }
    assert!(
        n_simple > 20_000 && n_weak > 20_000 && n_refused > 20_000,
        "{n_simple}, {n_weak}, {n_refused}"
    );
}

/// Returns polygons of `n` corners whose shapes are hard for other algorithms.
fn large(n: usize) -> [(&'static str, Vec<Point>); 4] {
    let polar = |n_turns: f64, radius: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        let point = |i: usize| {
            let angle = n_turns * std::f64::consts::TAU * i as f64 / n as f64;
            [radius(i) * crate::maths::cos(angle), radius(i) * crate::maths::sin(angle)]
        };
        (0..n).map(point).collect()
    };
    let comb = (0..n - 2).rev().map(|i| [i as f64, if i % 2 == 0 { 0.0 } else { 1e6 }]);
    let comb: Vec<[f64; 2]> = [[0.0, -1.0], [n as f64, -1.0]].into_iter().chain(comb).collect();
    let chain = |lift: f64| (0..n / 2).map(move |i| [i as f64, (i * i) as f64 + lift]);
    let crescent: Vec<[f64; 2]> = chain(0.0).chain(chain(0.5).rev()).collect();
    [
        ("a star", flat(&polar(1.0, &|i| if i % 2 == 0 { 1.0 } else { 1e-3 }))),
        ("a comb", flat(&comb)),
        ("a crescent", flat(&crescent)),
        (
            "a circle of rough radius",
            flat(&polar(1.0, &|i| 1.0 + 1e-5 * ((i * 7919) % 101) as f64)),
        ),
    ]
}

#[test]
fn large_polygons_are_triangulated_exactly() {
    for (name, corners) in large(20_000) {
        let found = sweep::triangles(&Plane::of(&corners));
        assert!(is_triangulation(&corners, &found.expect(name)), "{name}");
    }
}

#[test]
fn a_plane_in_any_place_gives_the_same_triangles() {
    let mut dice = Rng::with_seed(11);
    let expected = sorted(&triangulate(&in_space(DART)).unwrap());
    for n in 0..1000 {
        let axis = DVec3::new(dice.f64() - 0.5, dice.f64() - 0.5, dice.f64() - 0.5).normalize();
        let turn = DMat3::from_axis_angle(axis, dice.f64() * 6.0);
        let size = [1e-290, 1e-9, 1.0, 1e9, 1e17][n % 5];
        let beside = DVec3::splat(size * dice.f64());
        let corners: Vec<DVec3> =
            in_space(DART).iter().map(|corner| turn * *corner * size + beside).collect();
        assert_eq!(
            sorted(&triangulate(&corners).unwrap()),
            expected,
            "turned by {turn:?}, size {size:e}"
        );
    }
}
