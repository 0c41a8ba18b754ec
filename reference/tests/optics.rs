//! What holds for every mirrored and every transmitted ray. [rule 7] [rule 8] [rule 10]

mod common;

use common::Random;
use glam::DVec3;
use reference::optics::{reflect, refract};
use reference::rules::Lecture;
use reference::vec3::Vec3;

const N_DRAWS: usize = 20_000;

/// A direction, a normal turned against it, and two indices.
fn draw(random: &mut Random) -> (DVec3, DVec3, f64, f64) {
    let (d, n) = (random.unit(), random.unit());
    let n = if d.dot(n) > 0.0 { -n } else { n };
    (d, n, 1.0 + random.share(), 1.0 + random.share())
}

#[test]
fn a_mirrored_ray_is_of_unit_length_in_the_plane_of_incidence_at_the_same_angle() {
    let mut random = Random(0x1234_5678_9abc_def1);
    for _ in 0..N_DRAWS {
        let (d, n, ..) = draw(&mut random);
        let r = reflect::<f64, _>(Lecture, Vec3::of(d), Vec3::of(n)).f64();
        assert!((r.length() - 1.0).abs() < 1e-14);
        assert!(r.dot(d.cross(n)).abs() < 1e-14);
        assert!((r.dot(n) + d.dot(n)).abs() < 1e-14);
    }
}

#[test]
fn a_transmitted_ray_obeys_snell_and_none_is_lost_below_the_critical_angle() {
    let mut random = Random(0xfeed_5678_9abc_def1);
    for _ in 0..N_DRAWS {
        let (d, n, eta_i, eta_t) = draw(&mut random);
        let sin_t = eta_i * d.cross(n).length() / eta_t;
        match refract::<f64, _>(Lecture, Vec3::of(d), Vec3::of(n), eta_i, eta_t).map(Vec3::f64) {
            None => assert!(sin_t > 1.0 - 1e-14, "lost at sin θ_t = {sin_t}"),
            Some(t) => {
                assert!((t.length() - 1.0).abs() < 1e-14, "length {}", t.length());
                assert!((t.cross(n) * eta_t - d.cross(n) * eta_i).length() < 1e-13, "Snell, as vectors: co-planar too");
                assert!(t.dot(n) <= 0.0, "goes to the other side");
            }
        }
    }
}
