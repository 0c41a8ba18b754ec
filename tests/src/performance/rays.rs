//! Precomputed rays, the same for every program that traces them, and their file format.

use std::f64::consts::TAU;

use cases::glam::DVec3;
use cases::{Light, Scene, maths};
use reference::numbers::vec3::Vec3;
use reference::rays::camera::Lens;
use reference::rays::ray::Ray;
use reference::rules::Lecture;
use reference::world::World;

use crate::dice::Dice;

/// The distance from a surface at which a new ray starts, in scene units. It is far beyond the
/// rounding of single precision.
const OFF: f64 = 1e-3;

/// Rays of one kind.
#[derive(Clone, Debug)]
pub struct Set {
    /// The name of the set.
    pub name: &'static str,
    /// True if any hit ends the search.
    pub is_any_hit: bool,
    /// The origin, direction and length of each ray, in single precision, so that all programs
    /// trace the same rays.
    pub rays: Vec<[f32; 7]>,
}

/// The names of the sets, in order.
pub const NAMES: [&str; 4] = ["primary", "shadow", "diffuse", "random"];

/// Returns the four sets for a scene of one light and one mesh. They are eye rays, row by row;
/// shadow rays from their hits; rays in random directions above the hits; and rays between random
/// points of a box about the mesh.
pub fn sets(scene: &Scene) -> [Set; 4] {
    let world = World::<f64>::new(scene);
    let eye: Vec<Ray<f64>> = eye_rays(scene).collect();
    let lamp = scene.lights.iter().find_map(|light| match light {
        Light::Point { position, .. } => Some(*position),
        Light::Directional { .. } => None,
    });
    let lamp = lamp.unwrap_or(scene.camera.eye);
    let mut dice = Dice::new(17);
    let (mut shadow, mut diffuse) = (vec![], vec![]);
    for ray in &eye {
        let Some(hit) = world.nearest(Lecture, ray, &mut ()) else { continue };
        let (point, normal) = (hit.point.f64(), hit.n_geom.f64());
        let side = if normal.dot(ray.direction.f64()) > 0.0 { -normal } else { normal };
        let from = point + side * OFF;
        shadow.push(packed(from, (lamp - from).normalize(), (lamp - from).length()));
        diffuse.push(packed(from, (side + sphere(&mut dice)).normalize(), f64::INFINITY));
    }
    let in_box = |dice: &mut Dice| DVec3::from_array([(); 3].map(|()| dice.between(-1.2, 1.2)));
    let random = (0..eye.len()).map(|_| {
        let (from, to) = (in_box(&mut dice), in_box(&mut dice));
        packed(from, (to - from).normalize(), f64::INFINITY)
    });
    let random = random.collect();
    let primary = eye
        .iter()
        .map(|ray| packed(ray.origin.f64(), ray.direction.f64(), f64::INFINITY))
        .collect();
    let set = |name, is_any_hit, rays| Set { name, is_any_hit, rays };
    let [first, second, third, fourth] = NAMES;
    [
        set(first, false, primary),
        set(second, true, shadow),
        set(third, false, diffuse),
        set(fourth, false, random),
    ]
}

/// Returns the indices of the primary rays of a picture, ordered by blocks of 4 × 4 pixels. All
/// programs with packets trace these packets of 16.
pub fn in_blocks((width, height): (u32, u32)) -> Vec<usize> {
    let blocks =
        (0..height / 4).flat_map(|row| (0..width / 4).map(move |column| (4 * column, 4 * row)));
    let place = |i: u32, j: u32| (j * width + i) as usize;
    blocks.flat_map(|(i, j)| (0..16).map(move |k| place(i + k % 4, j + k / 4))).collect()
}

/// Returns the number of eye rays of a scene that hit something.
pub fn n_hits(scene: &Scene) -> u64 {
    let world = World::<f64>::new(scene);
    eye_rays(scene).filter(|ray| world.first(Lecture, ray, &mut ()).is_some()).count() as u64
}

/// Returns a ray through the centre of every pixel, row by row. [rule 1]
fn eye_rays(scene: &Scene) -> impl Iterator<Item = Ray<f64>> {
    let (width, height) = (scene.render.width, scene.render.height);
    let lens = Lens::<f64>::new(Lecture, &scene.camera, width, height);
    let pixels = (0..height).flat_map(move |j| (0..width).map(move |i| (i, j)));
    pixels.map(move |pixel| lens.eye_ray(Lecture, pixel, (0.5, 0.5)))
}

fn packed(from: DVec3, direction: DVec3, length: f64) -> [f32; 7] {
    [from.x, from.y, from.z, direction.x, direction.y, direction.z, length].map(|x| x as f32)
}

/// Returns a uniformly distributed point on the unit sphere.
fn sphere(dice: &mut Dice) -> DVec3 {
    let (z, angle) = (dice.between(-1.0, 1.0), dice.between(0.0, TAU));
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * maths::cos(angle), r * maths::sin(angle), z)
}

/// Returns the ray as the reference takes it.
pub fn ray(packed: &[f32; 7]) -> Ray<f64> {
    let [x, y, z, dx, dy, dz, length] = packed.map(f64::from);
    let v = |x, y, z| Vec3::of(DVec3::new(x, y, z));
    Ray { t_max: length, ..Ray::all_of(v(x, y, z), v(dx, dy, dz)) }
}

/// Returns the bytes of the file. Each set has two 32-bit numbers (1 if it is any-hit, else 0, and
/// the number of rays), then its rays. All numbers are little-endian.
pub fn encode(sets: &[Set]) -> Vec<u8> {
    let mut out = vec![];
    for set in sets {
        out.extend(u32::from(set.is_any_hit).to_le_bytes());
        out.extend((set.rays.len() as u32).to_le_bytes());
        set.rays.iter().flatten().for_each(|x| out.extend(x.to_le_bytes()));
    }
    out
}

/// Returns the sets of a file, with the names in [`NAMES`]. `None` if the file is cut, or has more
/// or fewer sets.
pub fn decode(mut bytes: &[u8]) -> Option<Vec<Set>> {
    let mut sets = vec![];
    for name in NAMES {
        let is_any_hit = u32::from_le_bytes(*bytes.first_chunk()?) == 1;
        let n = u32::from_le_bytes(*bytes.get(4..)?.first_chunk()?) as usize;
        let body = bytes.get(8..8 + 28 * n)?;
        bytes = &bytes[8 + 28 * n..];
        let float =
            |chunk: &[u8]| chunk.first_chunk().map_or(f32::NAN, |four| f32::from_le_bytes(*four));
        let rays = body
            .chunks_exact(28)
            .map(|ray| std::array::from_fn(|k| float(&ray[4 * k..])))
            .collect();
        sets.push(Set { name, is_any_hit, rays });
    }
    bytes.is_empty().then_some(sets)
}

/// Returns the number of answers that differ between two programs: a hit against a miss, or
/// distances that differ by more than a thousandth. A miss is infinite; in an any-hit set every
/// finite value is a hit.
pub fn n_different(set: &Set, ours: &[f32], theirs: &[f32]) -> usize {
    let differ = |(a, b): (&f32, &f32)| {
        a.is_finite() != b.is_finite()
            || (!set.is_any_hit && a.is_finite() && (a - b).abs() > 1e-3 * a.abs().max(1.0))
    };
    ours.iter().zip(theirs).filter(|pair| differ(*pair)).count() + ours.len().abs_diff(theirs.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Vec<Set> {
        let set = |name, is_any_hit, n| Set {
            name,
            is_any_hit,
            rays: vec![[1.0, 2.0, 3.0, 0.0, 0.0, 1.0, f32::INFINITY]; n],
        };
        vec![
            set(NAMES[0], false, 2),
            set(NAMES[1], true, 1),
            set(NAMES[2], false, 0),
            set(NAMES[3], false, 3),
        ]
    }

    #[test]
    fn a_file_of_rays_is_read_as_written_and_never_half() {
        let bytes = encode(&some());
        let read = decode(&bytes).expect("it is whole");
        assert_eq!(format!("{read:?}"), format!("{:?}", some()));
        assert!(
            decode(&bytes[..bytes.len() - 1]).is_none()
                && decode(&[&bytes[..], &[0]].concat()).is_none()
        );
    }

    #[test]
    fn blocks_hold_every_pixel_once() {
        let places = in_blocks((12, 8));
        assert_eq!(places[..6], [0, 1, 2, 3, 12, 13]);
        assert_eq!(places[16..18], [4, 5]);
        assert!((0..96).all(|place| places.contains(&place)) && places.len() == 96);
    }

    #[test]
    fn answers_differ_in_meeting_and_in_distance() {
        let (far, [nearest, any, ..]) =
            (f32::INFINITY, <[Set; 4]>::try_from(some()).expect("four"));
        for (ours, theirs, n, n_any) in [
            (1.0, 1.0005, 0, 0),
            (1.0, 1.1, 1, 0),
            (far, far, 0, 0),
            (1.0, far, 1, 1),
            (far, 0.0, 1, 1),
        ] {
            assert_eq!(n_different(&nearest, &[ours], &[theirs]), n, "{ours} {theirs}");
            assert_eq!(n_different(&any, &[ours], &[theirs]), n_any, "{ours} {theirs}");
        }
        assert_eq!(n_different(&nearest, &[1.0], &[]), 1);
    }
}
