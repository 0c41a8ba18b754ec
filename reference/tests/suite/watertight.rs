//! Tests that closed meshes are watertight: no ray from inside escapes between two triangles, even
//! if it is aimed at a vertex or an edge.

use crate::common::{Random, globe, lone};
use cases::{Mesh, Shape};
use glam::{DAffine3, DVec3};
use reference::numbers::real::Real;
use reference::numbers::vec3::Vec3;
use reference::rays::ray::Ray;
use reference::rules::{Lecture, Robustness, RuleSource, Rules, Start, Style, TriangleFormula};
use reference::world::{Search, World};

/// The number of rays at vertices, and of rays at edges, per precision and place.
const N_RAYS: usize = 50_000;
const FAR_AWAY: DVec3 = DVec3::new(148_376.0, 1234.0, -223_423.0);

/// The target of a ray.
#[derive(Clone, Copy, Debug)]
enum Aim {
    Vertex,
    Edge,
}

/// Returns a vertex or a point of an edge of the mesh, whose vertices are first rounded to `T`.
fn aim<T: Real>(at: Aim, mesh: &Mesh, random: &mut Random) -> DVec3 {
    let corner = |v: DVec3| Vec3::<T>::of(v).f64();
    let pick = |random: &mut Random, n: usize| ((random.share() * n as f64) as usize).min(n - 1);
    let triangle = mesh.triangles[pick(random, mesh.triangles.len())];
    let from = pick(random, 3);
    let [a, b] =
        [triangle[from], triangle[(from + 1) % 3]].map(|i| corner(mesh.vertices[i as usize]));
    match at {
        Aim::Vertex => a,
        Aim::Edge => a + (b - a) * random.share(),
    }
}

/// Returns how many of `n` rays from inside a jittered globe around `center` miss it, or are not
/// occluded by it.
fn n_lost<T: Real, R: RuleSource>(
    rules: R,
    center: DVec3,
    in_frame: bool,
    at: Aim,
    n: usize,
) -> usize {
    let mut random = Random(0xc105_ed00_7001 + center.x.to_bits());
    let mut lost = 0;
    let n_meshes = 20;
    for _ in 0..n_meshes {
        let mut mesh = globe(8, || 1.0 + 5.0 * random.share());
        let mut frame = DAffine3::IDENTITY;
        match in_frame {
            true => frame = DAffine3::from_translation(center),
            false => mesh.vertices.iter_mut().for_each(|v| *v += center),
        }
        let mut scene = lone(Shape::Mesh { mesh: 0 }, vec![mesh.clone()], frame);
        // Enough objects far away that the world needs a tree as well.
        for i in 0..12 {
            let mut beside = scene.objects[0].clone();
            beside.shape =
                Shape::Sphere { center: DVec3::new(1e7, 1e6 * f64::from(i), 0.0), radius: 1.0 };
            (beside.world_from_object, beside.object_from_world) =
                (DAffine3::IDENTITY, DAffine3::IDENTITY);
            scene.objects.push(beside);
        }
        let world = World::<T>::with_search(&scene, Search::Tree);
        for _ in 0..n / n_meshes {
            let from = center + random.unit() * 0.5;
            let to = aim::<T>(at, &mesh, &mut random) + if in_frame { center } else { DVec3::ZERO };
            let ray = Ray::<T>::leaving(rules, Vec3::of(from), Vec3::of((to - from).normalize()));
            let is_hit = world.nearest(rules, &ray, &mut ()).is_some_and(|hit| hit.object == 0);
            lost += usize::from(!is_hit || !world.occluded(rules, &ray, &mut ()));
        }
    }
    lost
}

fn check<T: Real>() {
    for center in [DVec3::ZERO, FAR_AWAY] {
        for in_frame in [false, true] {
            for at in [Aim::Vertex, Aim::Edge] {
                let lost = n_lost::<T, _>(Lecture, center, in_frame, at, N_RAYS);
                assert_eq!(
                    lost, 0,
                    "at {at:?} around {center}, in a frame: {in_frame}: {lost} of {N_RAYS} are lost"
                );
            }
        }
    }
}

#[test]
fn nothing_gets_out_in_double_precision() {
    check::<f64>();
}

#[test]
fn nothing_gets_out_in_single_precision() {
    check::<f32>();
}

/// The rays escape if each triangle is tested independently of its neighbours.
#[test]
fn a_formula_that_is_not_watertight_loses_some() {
    let style = Style {
        robustness: Robustness::Plain,
        start: Start::Interval,
        triangle: TriangleFormula::MollerTrumbore,
        ..Style::REFERENCE
    };
    let rules = Rules { style, ..Rules::LECTURE };
    assert!(n_lost::<f64, _>(&rules, DVec3::ZERO, false, Aim::Edge, 2000) > 20);
    assert!(n_lost::<f32, _>(&rules, DVec3::ZERO, false, Aim::Vertex, 2000) > 20);
}
