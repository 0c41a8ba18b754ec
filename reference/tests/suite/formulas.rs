//! Tests that the formulas that students may choose give the results of the reference's own, except
//! for rounding.

use crate::common::Random;
use glam::DVec3;
use reference::light::material::Material;
use reference::light::optics::refract;
use reference::light::shade::light_term;
use reference::numbers::vec3::Vec3;
use reference::rays::camera::Lens;
use reference::rays::ray::{HitPoint, Ray};
use reference::rules::{
    CameraFormula, Epsilon, Lecture, PlaneFormula, Power, Quadratic, Rules, Snell, Start, Style,
    ToLight, TriangleFormula,
};
use reference::shapes::{Plane, Round, ShapeHit, Shear, Solid, Sphere, Triangle};

const N_DRAWS: usize = 2_000;
/// The allowed relative difference, in double precision.
const CLOSE: f64 = 1e-12;

fn with(change: impl Fn(&mut Style)) -> Rules {
    let mut rules = Rules::LECTURE;
    change(&mut rules.style);
    rules
}

fn vec(v: DVec3) -> Vec3<f64> {
    Vec3::of(v)
}

fn check(what: &str, ours: Option<ShapeHit<f64>>, theirs: Option<ShapeHit<f64>>) {
    let is_same = match (&ours, &theirs) {
        (Some(a), Some(b)) => {
            (a.t - b.t).abs() <= CLOSE * a.t
                && (a.weights - b.weights).length() <= CLOSE
                && a.part == b.part
        }
        _ => ours == theirs,
    };
    assert!(is_same, "{what}: {theirs:?} is not the reference's {ours:?}");
}

/// Returns a ray that starts a few units away from `aim` and passes through it. Its direction is
/// not normalised, as in object space.
fn ray_through(random: &mut Random, aim: DVec3) -> Ray<f64> {
    let way = random.unit();
    Ray::leaving(
        Lecture,
        vec(aim - way * (2.0 + random.share())),
        vec(way * (0.5 + random.share())),
    )
}

fn check_solid(random: &mut Random, solid: &Solid<f64>, aim: DVec3) -> bool {
    let ray = ray_through(random, aim);
    let ours = solid.intersect(Lecture, &ray);
    for quadratic in Quadratic::ALL {
        check(
            quadratic.says(),
            ours,
            solid.intersect(&with(|style| style.quadratic = *quadratic), &ray),
        );
    }
    for plane in PlaneFormula::ALL {
        check(plane.says(), ours, solid.intersect(&with(|style| style.plane = *plane), &ray));
    }
    ours.is_some()
}

#[test]
fn spheres() {
    let mut random = Random(0x5eed_0001_2345_6789);
    for _ in 0..N_DRAWS {
        let (center, radius) = (random.unit() * random.share(), 0.1 + random.share());
        let sphere = |radius| Solid::Sphere(Sphere { center: vec(center), radius });
        let inside = center + random.unit() * (0.9 * radius * random.share());
        assert!(check_solid(&mut random, &sphere(radius), inside), "aimed at its inside");
        let out = random.unit();
        let (across, distance) = (out.any_orthonormal_vector(), radius * 1.1 + 0.1);
        let beside = Ray::leaving(Lecture, vec(center + out * distance - across), vec(across));
        let from_center = Ray::leaving(Lecture, vec(center), vec(out * 0.7));
        for quadratic in Quadratic::ALL {
            let rules = with(|style| style.quadratic = *quadratic);
            assert_eq!(
                sphere(radius).intersect(&rules, &beside),
                None,
                "{}: the ray passes by",
                quadratic.says()
            );
            assert_eq!(
                sphere(0.0).intersect(&rules, &beside),
                None,
                "{}: the sphere has no radius",
                quadratic.says()
            );
            let far = sphere(radius).intersect(Lecture, &from_center);
            check(quadratic.says(), far, sphere(radius).intersect(&rules, &from_center));
        }
    }
}

#[test]
fn cylinders_cones_and_planes() {
    let mut random = Random(0x5eed_0002_2345_6789);
    let mut n_hits = 0;
    for _ in 0..N_DRAWS {
        let (bottom_radius, top_radius) = (0.2 + random.share(), random.share());
        let is_capped = random.signed() > 0.0;
        let round =
            Solid::Round(Round { bottom_radius, top_radius, z_min: -1.0, z_max: 1.0, is_capped });
        let near_axis =
            DVec3::new(random.signed() * 0.1, random.signed() * 0.1, random.signed() * 0.5);
        n_hits += usize::from(check_solid(&mut random, &round, near_axis));
        let (normal, k) = (random.unit(), random.signed());
        let plane = Solid::Plane(Plane { normal: vec(normal), k });
        let aim = normal * k + normal.any_orthonormal_vector() * random.signed();
        assert!(check_solid(&mut random, &plane, aim));
    }
    assert!(n_hits > N_DRAWS / 2, "only {n_hits} rays hit a cylinder or a cone");
    let floor = Solid::Plane(Plane { normal: Vec3::axis(1), k: 1.0 });
    let along = Ray::leaving(Lecture, vec(DVec3::ZERO), vec(DVec3::X));
    for plane in PlaneFormula::ALL {
        assert_eq!(
            floor.intersect(&with(|style| style.plane = *plane), &along),
            None,
            "{}: parallel",
            plane.says()
        );
    }
}

fn check_triangle(corners: [DVec3; 3], ray: &Ray<f64>, is_hit: bool) {
    let triangle = Triangle { corners: corners.map(vec) };
    let ours = triangle.intersect(Lecture, ray, &Shear::of(ray), 3);
    assert_eq!(ours.is_some(), is_hit, "{corners:?} {ray:?}");
    for formula in TriangleFormula::ALL {
        let rules = with(|style| style.triangle = *formula);
        check(formula.says(), ours, triangle.intersect(&rules, ray, &Shear::of(ray), 3));
    }
}

#[test]
fn triangles() {
    let mut random = Random(0x5eed_0003_2345_6789);
    let mut n_hits = 0;
    while n_hits < N_DRAWS {
        let corners @ [a, b, c] = [random.unit(), random.unit(), random.unit()];
        let (u, v, w) = (0.05 + random.share(), 0.05 + random.share(), 0.05 + random.share());
        let inside = (a * u + b * v + c * w) / (u + v + w);
        let ray = ray_through(&mut random, inside);
        let n = (b - a).cross(c - a);
        if n.length() < 0.1 || n.normalize().dot(ray.direction.f64().normalize()).abs() < 0.1 {
            continue; // Nearly edge on, t itself is badly conditioned.
        }
        check_triangle(corners, &ray, true);
        n_hits += 1;
        for beside in [a * 1.1 - inside * 0.1, a + b - inside, b + c - inside, c + a - inside] {
            let is_outside = reference::shapes::barycentric(Lecture, corners.map(vec), vec(beside))
                .min_element()
                < -1e-3;
            assert!(is_outside);
            check_triangle(
                corners,
                &Ray { origin: ray.origin + vec(beside - inside), ..ray },
                false,
            );
        }
    }
}

#[test]
fn triangles_that_are_none_and_borders() {
    let corners = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0)];
    let down = |x, y| Ray::leaving(Lecture, vec(DVec3::new(x, y, 3.0)), vec(DVec3::NEG_Z));
    for (x, y) in [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0), (2.0, 0.0), (2.0, 2.0), (0.0, 1.0)] {
        check_triangle(corners, &down(x, y), true);
    }
    check_triangle([DVec3::ZERO, DVec3::X, DVec3::X * 2.0], &down(1.0, 0.0), false);
    check_triangle([DVec3::X; 3], &down(1.0, 0.0), false);
    let edge_on = Ray::leaving(Lecture, vec(DVec3::new(-3.0, 1.0, 0.0)), vec(DVec3::X));
    check_triangle(corners, &edge_on, false);
    check_triangle(corners, &Ray { origin: vec(DVec3::new(-3.0, 1.0, 1.0)), ..edge_on }, false);
}

#[test]
fn eye_rays() {
    let camera = crate::common::scene("").camera;
    for formula in CameraFormula::ALL {
        let rules = with(|style| style.camera = *formula);
        for pixel in [(0, 0), (23, 0), (0, 17), (12, 9), (5, 13)] {
            let ours = Lens::new(Lecture, &camera, 24, 18).eye_ray(Lecture, pixel, (0.5, 0.5));
            let theirs = Lens::new(&rules, &camera, 24, 18).eye_ray(&rules, pixel, (0.5, 0.5));
            let error = (ours.direction - theirs.direction).length();
            assert!(
                error <= CLOSE && ours.origin == theirs.origin,
                "{}: off by {error}",
                formula.says()
            );
        }
    }
    let nudged = with(|style| style.nudge = [0.25, -0.125]);
    let theirs = Lens::<f64>::new(&nudged, &camera, 24, 18).eye_ray(&nudged, (3, 4), (0.5, 0.5));
    let ours = Lens::<f64>::new(Lecture, &camera, 24, 18).eye_ray(Lecture, (3, 4), (0.75, 0.375));
    assert!(
        (ours.direction - theirs.direction).length() <= CLOSE,
        "a nudge to the right and down goes along i and j"
    );
}

#[test]
fn transmitted_directions_and_highlights() {
    let mut random = Random(0x5eed_0004_2345_6789);
    let snell = with(|style| style.snell = Snell::Textbook);
    let power = with(|style| style.power = Power::ExpLog);
    for _ in 0..N_DRAWS {
        let (d, n) = (random.unit(), random.unit());
        let n = if d.dot(n) > 0.0 { -n } else { n };
        let (eta_i, eta_t) = (1.0 + random.share(), 1.0 + random.share());
        let sine = eta_i / eta_t * d.cross(n).length();
        if (sine - 1.0).abs() > 1e-3 {
            let ours = refract(Lecture, vec(d), vec(n), eta_i, eta_t);
            let theirs = refract(&snell, vec(d), vec(n), eta_i, eta_t);
            let is_same = match (ours, theirs) {
                (Some(a), Some(b)) => (a - b).length() <= CLOSE,
                _ => ours == theirs,
            };
            assert!(is_same, "d = {d}, N = {n}, {eta_i} to {eta_t}: {theirs:?} is not {ours:?}");
        }
        let material = gloss((random.share() * 200.0).floor());
        let [normal, to_viewer, to_light] = [random.unit(), random.unit(), random.unit()].map(vec);
        let ours = light_term(Lecture, &material, Vec3::ONE, normal, to_viewer, to_light, &mut ());
        let theirs = light_term(&power, &material, Vec3::ONE, normal, to_viewer, to_light, &mut ());
        assert!((ours - theirs).length() <= CLOSE * ours.length(), "ns = {}", material.ns);
    }
    let [side, up] = [Vec3::axis(0), Vec3::axis(1)];
    let term = |ns| light_term(&power, &gloss(ns), Vec3::ONE, up, side - up, up, &mut ());
    assert_eq!(term(0.0), Vec3::ONE, "0 to the power 0 is 1");
    assert_eq!(term(1.0), Vec3::new(0.5, 0.5, 0.5));
}

fn gloss(ns: f64) -> Material<f64> {
    let (none, half) = (Vec3::ZERO, Vec3::ONE * 0.5);
    Material { ke: none, ka: none, kd: half, ks: half, kt: none, kr: none, ns, index: 1.0 }
}

#[test]
fn rays_get_away_from_surfaces() {
    let up = Vec3::axis(1);
    let hit_point = HitPoint { point: Vec3::ZERO, error: Vec3::ONE * 0.25, n_geom: up };
    let slanted = vec(DVec3::new(0.6, 0.8, 0.0));
    let spawned = |start, direction| {
        let rules = Rules { epsilon: Epsilon::Fixed(0.125), ..with(|style| style.start = start) };
        let ray = Ray::spawned(&rules, &hit_point, direction);
        (ray.origin, ray.contains(0.125), ray.contains(0.13), ray.contains(1e-9))
    };
    let off_bound = spawned(Start::OffBound, -slanted).0;
    assert!(
        (off_bound + up * 0.25).length() < 1e-15,
        "the start moves along N by the bound, to the side of the ray: {off_bound:?}"
    );
    assert_eq!(spawned(Start::Interval, slanted), (Vec3::ZERO, false, true, false));
    assert_eq!(spawned(Start::AlongNormal, slanted), (up * 0.125, true, true, true));
    assert_eq!(spawned(Start::AlongNormal, -slanted), (-up * 0.125, true, true, true));
    assert_eq!(spawned(Start::AlongRay, slanted), (slanted * 0.125, true, true, true));
    let to_light = |seen, r| {
        let style = |style: &mut Style| (style.start, style.to_light) = (Start::AlongNormal, seen);
        let rules = Rules { epsilon: Epsilon::Fixed(0.125), ..with(style) };
        let ray = Ray::to_light(&rules, &hit_point, slanted, r);
        assert!(!ray.contains(ray.t_max) && ray.contains(ray.t_max.min(1e9) * 0.99));
        ray
    };
    let end = |ray: Ray<f64>| ray.at(ray.t_max) - slanted * 5.0;
    assert!(end(to_light(ToLight::FromStart, 5.0)).length() <= CLOSE, "the ray ends at the light");
    assert!(
        (end(to_light(ToLight::FromPoint, 5.0)) - up * 0.125).length() <= CLOSE,
        "the ray is as long, and parallel to the line from the point to the light"
    );
    assert_eq!(
        to_light(ToLight::FromStart, f64::INFINITY).direction,
        slanted,
        "all rays to a far light are parallel"
    );
}
