//! Tests of scenes that are scaled by a power of two: t scales by that power. It does so bit for
//! bit while the exponents leave room for the formulas, and otherwise to a few last places.

use crate::common::Random;
use glam::DVec3;
use reference::numbers::real::scaled;
use reference::numbers::vec3::Vec3;
use reference::rays::ray::Ray;
use reference::rules::Lecture;
use reference::shapes::{Cuboid, Plane, Round, Shear, Solid, Sphere, Triangle};

const N_DRAWS: usize = 300;

/// Returns shapes in a scene of the scale 2^e. Some of them are hit from nearby, along a border, or
/// not at all.
fn shapes(random: &mut Random, e: i32) -> Vec<Solid<f64>> {
    let (at, size) = (random.unit() * 0.7, 0.1 + random.share());
    let (point, length) = (|v: DVec3| Vec3::of(v).map(|x| scaled(x, e)), |x: f64| scaled(x, e));
    let half = DVec3::splat(size / 2.0);
    let round = Round {
        bottom_radius: length(size),
        top_radius: length(size * random.share()),
        z_min: length(-0.5),
        z_max: length(size),
        is_capped: random.share() < 0.5,
    };
    vec![
        Solid::Sphere(Sphere { center: point(at), radius: length(size) }),
        Solid::Sphere(Sphere { center: point(DVec3::Y * -1e6), radius: length(1e6) }),
        Solid::Plane(Plane { normal: Vec3::of(random.unit()), k: length(at.x) }),
        Solid::Cuboid(Cuboid { min: point(at - half), max: point(at + half) }),
        Solid::Round(round),
        Solid::Round(Round { top_radius: round.bottom_radius, ..round }),
    ]
}

/// Returns the t of every shape and of a triangle, in a scene of the scale 2^e, divided by the
/// scale. A miss is `None`.
fn ts(seed: u64, e: i32) -> Vec<Option<f64>> {
    let mut random = Random(seed);
    let length = |v: DVec3| Vec3::of(v).map(|x| scaled(x, e));
    let (origin, aim) = (random.unit() * 3.0, random.unit() * random.share());
    let ray = Ray::all_of(length(origin), Vec3::of((aim - origin).normalize()));
    let corners =
        [random.unit(), random.unit(), if random.share() < 0.3 { aim } else { random.unit() }]
            .map(length);
    let triangle = Triangle { corners }.intersect(Lecture, &ray, &Shear::of(&ray), 0);
    let solids = shapes(&mut random, e).into_iter().map(|solid| solid.intersect(Lecture, &ray));
    solids.chain([triangle]).map(|hit| hit.map(|hit| scaled(hit.t, -e))).collect()
}

#[test]
fn a_scene_times_a_power_of_two_has_scaled_hits() {
    let (mut n_hits, mut n_missed) = (0, 0);
    for draw in 1..=N_DRAWS as u64 {
        let seed = draw.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let here = ts(seed, 0);
        for e in [-60, -20, 1, 20, 60] {
            assert_eq!(ts(seed, e), here, "draw {draw}, times 2^{e}");
        }
        for e in [-900, -400, 400, 900] {
            for (n, (t, there)) in here.iter().zip(ts(seed, e)).enumerate() {
                assert_eq!(t.is_some(), there.is_some(), "draw {draw}, shape {n}, times 2^{e}");
                let (t, there) = (t.unwrap_or(0.0), there.unwrap_or(0.0));
                assert!(
                    (t - there).abs() <= 1e-11 * t,
                    "draw {draw}, shape {n}, times 2^{e}: {there} is not {t}"
                );
            }
        }
        n_hits += here.iter().flatten().count();
        n_missed += here.iter().filter(|t| t.is_none()).count();
    }
    assert!(n_hits > N_DRAWS && n_missed > N_DRAWS, "{n_hits} hits, {n_missed} misses");
}

#[test]
fn what_is_degenerate_is_a_number_or_a_miss() {
    let sphere = Solid::Sphere(Sphere { center: Vec3::ZERO, radius: 0.0 });
    let through = Ray::all_of(Vec3::new(0.0, 0.0, -5.0), Vec3::new(0.0, 0.0, 1.0));
    let hit = sphere
        .intersect(Lecture, &through)
        .expect("a ray through the centre hits a sphere without radius");
    assert_eq!(
        (hit.t, sphere.normal_at_hit(Lecture, &through, &hit)),
        (5.0, Vec3::new(0.0, 0.0, -1.0))
    );
    let mut random = Random(0x1111_2222_3333_4444);
    for direction in [Vec3::ZERO, Vec3::new(f64::NAN, 0.0, 1.0), Vec3::new(f64::INFINITY, 0.0, 1.0)]
    {
        let ray = Ray::all_of(Vec3::new(0.1, 0.2, 0.3), direction);
        for solid in shapes(&mut random, 0) {
            assert!(
                solid.intersect(Lecture, &ray).is_none_or(|hit| !hit.t.is_nan()),
                "{solid:?} along {direction:?}"
            );
        }
    }
}
