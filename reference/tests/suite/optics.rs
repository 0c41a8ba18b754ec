//! Tests of invariants of all reflected and transmitted rays. [rule 7] [rule 8] [rule 10]

use crate::common::Random;
use glam::DVec3;
use reference::light::optics::{reflect, refract, smooth_reflect, smooth_refract};
use reference::numbers::vec3::Vec3;
use reference::rules::Lecture;

const N_DRAWS: usize = 20_000;

/// Returns a unit direction, a unit normal turned against it, and two indices.
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
                assert!(
                    (t.cross(n) * eta_t - d.cross(n) * eta_i).length() < 1e-13,
                    "Snell's law in vector form, so T is in the plane of incidence too"
                );
                assert!(t.dot(n) <= 0.0, "goes to the other side");
            }
        }
    }
}

/// R leaves the surface and T crosses it, to the last place. The rays include grazing ones, shading
/// normals up to edge on and beyond, and indices up to the critical angle.
#[test]
fn smooth_rays_go_to_the_side_they_should() {
    let mut random = Random(0xabcd_ef01_9abc_def1);
    let mut n_turned = 0;
    for _ in 0..N_DRAWS {
        let (d, n, eta_i, eta_t) = draw(&mut random);
        let across = random.unit().cross(n).normalize();
        let share = cases::maths::pow(10.0, -18.0 * random.share());
        let d = if random.share() < 0.5 { (across + d * share).normalize() } else { d };
        let d = if d.dot(n) > 0.0 { d - n * (2.0 * d.dot(n)) } else { d };
        let n_shading =
            if random.share() < 0.3 { n } else { (n + random.unit() * random.share()).normalize() };
        let [d, n, n_shading] = [d, n, n_shading].map(Vec3::<f64>::of);
        let r = smooth_reflect(Lecture, d, n, n_shading);
        assert!(r.dot(n) > 0.0, "R = {r:?} of {d:?} at {n:?}");
        assert!((r.length() - 1.0).abs() < 1e-14);
        let critical =
            if random.share() < 0.5 { d.cross(n_shading).length() * eta_i } else { eta_t };
        let Some(t) = smooth_refract(Lecture, d, n, n_shading, (eta_i, critical)) else { continue };
        assert!(t.dot(n) < 0.0, "T = {t:?} of {d:?} at {n:?}");
        assert!((t.length() - 1.0).abs() < 1e-14);
        n_turned += u32::from(t.dot(n) > -1e-14);
    }
    assert!(
        n_turned > 100,
        "only {n_turned} transmitted rays are as near to the surface as possible"
    );
}
