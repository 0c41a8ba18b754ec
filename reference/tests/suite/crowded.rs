//! Tests of many triangles in one place: a triangle that repeats an earlier one costs nothing, and
//! changes nothing.

use crate::common::{Random, globe, lone};
use cases::{Mesh, Shape};
use glam::{DAffine3, DVec3};
use reference::numbers::real::Real;
use reference::rays::camera::Lens;
use reference::rays::ray::Ray;
use reference::rules::Lecture;
use reference::watch::work::Amounts;
use reference::world::packet::MOST;
use reference::world::{Search, World};

const CORNERS: [DVec3; 3] =
    [DVec3::new(-1.0, -1.0, -1.0), DVec3::new(1.0, -1.0, 0.5), DVec3::new(-0.5, 1.0, 1.0)];

/// Returns a mesh in which every triangle has vertices of its own.
fn mesh(triangles: impl Iterator<Item = [DVec3; 3]>) -> Mesh {
    let vertices: Vec<DVec3> = triangles.flatten().collect();
    let triangles = (0..vertices.len() as u32 / 3).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    Mesh { vertices, triangles, normals: None }
}

/// Returns a mesh of `n` equal triangles.
fn repeated(n: usize) -> Mesh {
    mesh((0..n).map(|_| CORNERS))
}

/// Returns a mesh of `n` triangles with equal corners, in all of their orders in turn.
fn turned(n: usize) -> Mesh {
    let [a, b, c] = CORNERS;
    let orders = [[a, b, c], [b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]];
    mesh((0..n).map(|k| orders[k % 6]))
}

/// Returns a part of a globe with `n` equal triangles, and bigger triangles before and after them.
fn among_others(n: usize) -> Mesh {
    let around = globe(20, || 2.0);
    let others =
        around.triangles.iter().map(|corners| corners.map(|i| around.vertices[i as usize]));
    let others: Vec<_> = others.filter(|corners| corners.iter().all(|v| v.z < 1.0)).collect();
    let bigger = [1.5, 1.25].map(|size| CORNERS.map(|v| v * size));
    mesh(bigger.into_iter().chain(others).chain((0..n).map(|_| CORNERS)).chain(bigger))
}

/// Returns `n` triangles of different sizes about one centre, in random order. No two lie in one
/// plane.
fn nested(n: usize) -> Mesh {
    let mut random = Random(7);
    let mut sizes: Vec<f64> = (1..=n).map(|k| k as f64 / n as f64).collect();
    (1..n).rev().for_each(|k| sizes.swap(k, (random.share() * (k + 1) as f64) as usize));
    mesh(sizes.into_iter().map(|size| CORNERS.map(|v| v * size)))
}

fn world<T: Real>(mesh: &Mesh, search: Search) -> World<T> {
    World::with_search(
        &lone(Shape::Mesh { mesh: 0 }, vec![mesh.clone()], DAffine3::IDENTITY),
        search,
    )
}

/// Returns the hits of the rays of the scene's camera as text, and the work that they take. Checks
/// that occlusion and packets agree with the hits.
fn seen<T: Real>(world: &World<T>) -> (Vec<String>, Amounts) {
    let lens = Lens::<T>::new(Lecture, &world.camera, 24, 18);
    let pixels = (0..18).flat_map(|j| (0..24).map(move |i| (i, j)));
    let rays: Vec<Ray<T>> =
        pixels.map(|pixel| lens.eye_ray(Lecture, pixel, (T::HALF, T::HALF))).collect();
    let mut work = Amounts::default();
    let alone: Vec<String> = rays
        .iter()
        .map(|ray| {
            let hit = world.nearest(Lecture, ray, &mut work);
            assert_eq!(world.occluded(Lecture, ray, &mut work), hit.is_some());
            format!("{hit:?}")
        })
        .collect();
    for (rays, alone) in rays.chunks(MOST).zip(alone.chunks(MOST)) {
        let together = rays.iter().zip(world.first_of_packet(rays, &mut work));
        let hits = together
            .map(|(ray, found)| found.map(|found| world.hit(Lecture, ray, found, true, &mut ())));
        assert!(hits.map(|hit| format!("{hit:?}")).eq(alone.iter().cloned()));
    }
    (alone, work)
}

/// Checks that a mesh has the same hits and the same cost however often its triangles are repeated.
fn check_growth(name: &str, mesh: fn(usize) -> Mesh) {
    let (hits, work) = seen(&world::<f64>(&mesh(6), Search::Tree));
    let n_hits = hits.iter().filter(|hit| *hit != "None").count();
    assert!(n_hits > 20, "{name}: only {n_hits} rays hit the mesh");
    for n in [1_000, 10_000, 100_000] {
        let many = seen(&world::<f64>(&mesh(n), Search::Tree));
        assert!(many.0 == hits, "{name}: {n} triangles look different");
        assert_eq!(many.1, work, "{name}: {n} triangles");
    }
}

#[test]
fn repeated_triangles_cost_nothing() {
    check_growth("repeated", repeated);
    check_growth("turned", turned);
    check_growth("among others", among_others);
}

/// Checks that of equal triangles the first one is hit, with its own normals.
fn trees_find_what_lists_find<T: Real>() {
    let mut random = Random(0xc0_ffee);
    for mesh in [repeated(300), turned(300), among_others(300), nested(300)] {
        let normals = (0..mesh.vertices.len()).map(|_| random.unit()).collect();
        for normals in [None, Some(normals)] {
            let mesh = Mesh { normals, ..mesh.clone() };
            let (by_list, _) = seen(&world::<T>(&mesh, Search::Scan));
            assert!(seen(&world::<T>(&mesh, Search::Tree)).0 == by_list);
        }
    }
}

#[test]
fn trees_find_what_lists_find_in_a_crowd() {
    trees_find_what_lists_find::<f64>();
    trees_find_what_lists_find::<f32>();
}
