//! Tests of rays that start on surfaces: a convex object does not shadow itself, and no surface is
//! missed or hit twice.

use std::fmt::Write;

use crate::common::{SCALES, globe, lone, moved, picture, scene};
use cases::ray_tree::{self, RayNode};
use cases::scene::Attenuation;
use cases::{Effect, Light, Scene, Shape};
use glam::{DAffine3, DVec3};
use reference::numbers::real::Real;
use reference::numbers::vec3::Vec3;
use reference::rays::ray::Ray;
use reference::rules::{Lecture, Rules};
use reference::trace::kernel::{Kernel, Path as RayPath};
use reference::trace::render::{Options, render};
use reference::watch::{Counts, Recorder};
use reference::world::World;
use reference::world::search::Crossings;

/// Returns a scene of a convex object with lights that graze it from many sides. A second object,
/// which no ray hits, keeps the proof from applying that nothing is left to hit.
fn grazed(shape: Shape, meshes: Vec<cases::Mesh>, scale: f64) -> Scene {
    let mut scene = lone(shape, meshes, DAffine3::IDENTITY);
    let mut aside = scene.objects[0].clone();
    aside.shape = Shape::Sphere { center: DVec3::Z * 1e3 * scale, radius: 0.01 * scale };
    scene.objects.push(aside);
    scene.camera.eye *= scale;
    (scene.render.width, scene.render.height) = (64, 48);
    for direction in
        [DVec3::new(0.3, 1.0, 0.1), DVec3::new(1.0, 0.2, -0.05), DVec3::new(-0.7, 0.3, 0.02)]
    {
        scene.lights.push(Light::Directional {
            direction: direction.normalize(),
            colour: DVec3::new(0.5, 0.3, 0.2),
            ambient: DVec3::ZERO,
        });
    }
    let attenuation = Attenuation { quadratic: 0.0, linear: 0.0, constant: 1.0 };
    let position = DVec3::new(1.3, 0.4, -0.1) * scale;
    scene.lights.push(Light::Point {
        position,
        colour: DVec3::splat(0.5),
        ambient: DVec3::ZERO,
        attenuation,
    });
    scene
}

/// A single convex object shadows only surfaces that face away from the light, which are dark
/// anyway. Shadows must change no bit.
#[test]
fn no_convex_object_shadows_itself_up_to_the_terminator() {
    fn check<T: Real>(name: &str, scene: &Scene) {
        let world = World::<T>::new(scene);
        let effects = scene.effects.with(Effect::Shadows);
        let (with, stats) =
            render(&world, Lecture, &Options { effects, ..Options::of(&world) }, |_| {});
        let (without, _) = render(
            &world,
            Lecture,
            &Options { effects: effects.without(Effect::Shadows), ..Options::of(&world) },
            |_| {},
        );
        assert!(stats.rays.shadow > 400, "{name}: {:?}: the test is vacuous", stats.rays);
        let n_wrong = with.pixels().iter().zip(without.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(n_wrong, 0, "{name}");
    }
    for scale in SCALES {
        let sphere = grazed(Shape::Sphere { center: DVec3::ZERO, radius: scale }, vec![], scale);
        let flat = grazed(Shape::Mesh { mesh: 0 }, vec![globe(12, || scale)], scale);
        let round = Shape::Cylinder {
            radius: 0.7 * scale,
            z_min: -scale,
            z_max: 0.3 * scale,
            capped: true,
        };
        for (name, scene) in
            [("sphere", sphere), ("mesh", flat), ("cylinder", grazed(round, vec![], scale))]
        {
            for by in [DVec3::ZERO, DVec3::new(10.0, -3.0, 7.0) * scale] {
                check::<f64>(
                    &format!("{name}, scale {scale:e}, moved by {by}"),
                    &moved(&scene, by),
                );
                check::<f32>(
                    &format!("{name} in f32, scale {scale:e}, moved by {by}"),
                    &moved(&scene, by),
                );
            }
        }
    }
}

/// A smooth mesh is in shadow exactly where its triangles face away from the light.
#[test]
fn a_smooth_mesh_is_dark_exactly_where_its_triangles_face_away() {
    for scale in SCALES {
        let mut mesh = globe(12, || scale);
        mesh.normals = Some(mesh.vertices.iter().map(|v| v.normalize()).collect());
        let mut scene = grazed(Shape::Mesh { mesh: 0 }, vec![mesh], scale);
        scene.lights.truncate(1);
        let Light::Directional { direction, .. } = scene.lights[0] else {
            panic!("the first light is directional")
        };
        let world = World::<f64>::new(&scene);
        let effects = scene.effects.with(Effect::Shadows).with(Effect::SmoothNormals);
        let kernel = Kernel::new(&world, Lecture, effects);
        let mut n_dark = 0;
        for (i, j) in (0..64).flat_map(|i| (0..48).map(move |j| (i, j))) {
            let colour = kernel.eye((i, j), (0.5, 0.5), &mut Counts::default());
            let lens = reference::rays::camera::Lens::new(Lecture, &scene.camera, 64, 48);
            let Some(hit) =
                world.nearest(Lecture, &lens.eye_ray(Lecture, (i, j), (0.5, 0.5)), &mut ())
            else {
                continue;
            };
            let shades = |n: Vec3<f64>| n.f64().dot(-direction);
            if shades(hit.n_shading) > 0.0 {
                assert_eq!(
                    colour == Vec3::ZERO,
                    shades(hit.n_geom) < 0.0,
                    "pixel ({i}, {j}) at scale {scale:e}"
                );
                n_dark += usize::from(colour == Vec3::ZERO);
            }
        }
        assert!(
            n_dark > 0,
            "no triangle faces away where its vertex normals do not: the mesh is too fine"
        );
    }
}

fn tree(scene: &Scene, from: DVec3, direction: DVec3) -> RayNode {
    let world = World::<f64>::new(scene);
    let kernel = Kernel::new(&world, Lecture, scene.effects);
    let ray = Ray::of(&cases::Ray::new(from, direction));
    ray_tree::record(|| {
        kernel.trace(&ray, RayPath::eye(0), &mut Recorder);
    })
    .expect("a ray was traced")
}

/// A ray through the middle of a shell of glass, however thin, crosses four surfaces. A shadow ray
/// is tinted as often.
#[test]
fn glass_in_glass_has_all_its_surfaces() {
    for scale in SCALES {
        for thickness in [0.5, 1e-3, 1e-9, 1e-12] {
            let text = format!(
                "[scene.materials.glass]\nkt = [0.5, 0.5, 0.5]\nindex = 1.5\n\
                 [[scene.lights]]\npoint = {{ position = [0, 0, {}], colour = [1, 1, 1] }}\n\
                 [[scene.objects]]\nsphere = {{ radius = {scale} }}\nmaterial = \"glass\"\n\
                 [[scene.objects]]\nsphere = {{ radius = {} }}\nmaterial = \"glass\"\n",
                7.0 * scale,
                scale * (1.0 - thickness)
            );
            let mut scene = scene(&text);
            scene.render.max_depth = 9;
            let direction = DVec3::new(0.3, 0.2, -1.0).normalize();
            let mut node = &tree(&scene, -direction * 4.0 * scale, direction);
            let mut places = Vec::new();
            while let Some(next) = node.children.first() {
                places.push(next.origin.dot(direction) / scale);
                node = next;
            }
            let paper = [-1.0, thickness - 1.0, 1.0 - thickness, 1.0];
            let is_right =
                places.iter().zip(paper).all(|(place, right)| (place - right).abs() < 1e-14);
            assert!(
                places.len() == 4 && is_right,
                "scale {scale:e}, {thickness:e} thick: {places:?}"
            );
            let world = World::<f64>::new(&scene);
            let ray =
                Ray::leaving(Lecture, Vec3::of(-direction * 4.0 * scale), Vec3::of(direction));
            let mut crossings = Crossings::none();
            assert!(
                world.crossings(Lecture, &ray, |_| false, &mut crossings, &mut ()),
                "no surface blocks the ray"
            );
            assert_eq!(crossings.len(), 4, "scale {scale:e}, {thickness:e} thick");
        }
    }
}

/// Boxes under a light, whose tops are in one plane up to rounding. No pixel is dark.
#[test]
fn faces_in_one_plane_do_not_shadow_one_another() {
    for scale in SCALES {
        for axis in [DVec3::Y, DVec3::new(1.0, 2.0, 3.0).normalize()] {
            let turn = DAffine3::from_axis_angle(axis, 0.7);
            let mut text = String::from("[scene.materials.m]\nkd = [1, 1, 1]\n");
            for _ in 0..6 {
                write!(text, "[[scene.objects]]\nbox = {{}}\nmaterial = \"m\"\n").unwrap();
            }
            let mut scene = scene(&text);
            (scene.render.width, scene.render.height) = (64, 48);
            for (n, object) in scene.objects.iter_mut().enumerate() {
                let at = DVec3::new(0.4 * n as f64 - 1.0, 0.1 + 0.2, 0.13 * n as f64);
                let size = DVec3::new(1.0, 0.1 * (n + 1) as f64, 2.0);
                let down = DVec3::new(0.0, -0.5, 0.0);
                let map = DAffine3::from_translation(at)
                    * DAffine3::from_scale(size)
                    * DAffine3::from_translation(down);
                let map =
                    DAffine3 { matrix3: map.matrix3 * scale, translation: map.translation * scale };
                object.world_from_object = turn * map;
                object.object_from_world = object.world_from_object.inverse();
            }
            let up = turn.transform_vector3(DVec3::Y);
            let side = turn.transform_vector3(DVec3::X);
            let light = (up + side * 3.0).normalize();
            scene.lights.push(Light::Directional {
                direction: -light,
                colour: DVec3::ONE,
                ambient: DVec3::ZERO,
            });
            scene.camera.eye = turn.transform_point3(DVec3::new(0.1, 3.0, 0.3) * scale);
            (scene.camera.forward, scene.camera.up, scene.camera.right) =
                (-up, turn.transform_vector3(DVec3::NEG_Z), side);
            let image = picture::<f64>(&scene);
            let wanted = up.dot(light);
            let wrong = image
                .pixels()
                .iter()
                .filter(|c| **c != DVec3::ZERO && (c.x - wanted).abs() > 1e-9)
                .count();
            let lit = image.pixels().iter().filter(|c| (c.x - wanted).abs() < 1e-9).count();
            let hit = n_hits(&scene);
            assert_eq!(
                (wrong, lit),
                (0, hit),
                "scale {scale:e} about {axis}: of {hit} pixels {lit} are lit"
            );
            assert!(hit > 500, "the camera misses the boxes");
        }
    }
}

fn n_hits(scene: &Scene) -> usize {
    let world = World::<f64>::new(scene);
    let lens = reference::rays::camera::Lens::new(
        Lecture,
        &scene.camera,
        scene.render.width,
        scene.render.height,
    );
    let pixels =
        (0..scene.render.width).flat_map(|i| (0..scene.render.height).map(move |j| (i, j)));
    pixels
        .filter(|at| {
            world.first(Lecture, &lens.eye_ray(Lecture, *at, (0.5, 0.5)), &mut ()).is_some()
        })
        .count()
}

/// A light on a surface is not occluded by it; a light just behind the surface is.
#[test]
fn a_light_on_a_surface_is_not_hidden_by_it() {
    let mut random = crate::common::Random(0x11_6475);
    let (mut n_lit, mut n_dark) = (0, 0);
    for n in 0..2000 {
        let scale = SCALES[n % SCALES.len()];
        let far = DVec3::new(random.signed(), random.signed(), random.signed()) * scale;
        let center = far + random.unit() * scale * 3.0;
        let towards = random.unit();
        let shape = Shape::Sphere { center, radius: 0.5 * scale };
        let scene = lone(shape, vec![], DAffine3::IDENTITY);
        let world = World::<f64>::new(&scene);
        let kernel = Kernel::new(&world, Lecture, scene.effects.with(Effect::Shadows));
        // The normal at the point faces the ball. The light is on the ball or just inside it.
        let start = center + towards * scale * 4.0;
        let hit_point = reference::rays::ray::HitPoint {
            point: Vec3::of(start),
            error: Vec3::ZERO,
            n_geom: Vec3::of(-towards),
        };
        let lit = |light: DVec3| {
            let (way, r) = ((light - start).normalize(), (light - start).length());
            kernel.shadow(&hit_point, Vec3::of(way), r, &mut Counts::default()) == Vec3::ONE
        };
        n_lit += usize::from(lit(center + towards * 0.5 * scale));
        n_dark += usize::from(!lit(center + towards * (0.5 - 1e-12) * scale));
    }
    assert_eq!((n_lit, n_dark), (2000, 2000));
}

/// The pictures above use the reference's own start of rays. With RAY_EPSILON some of them are
/// wrong.
#[test]
fn an_epsilon_fails_where_the_bound_holds() {
    let plain = Rules::LECTURE.plain();
    let sphere = grazed(Shape::Sphere { center: DVec3::ZERO, radius: 1e6 }, vec![], 1e6);
    let world = World::<f32>::new(&sphere);
    let effects = sphere.effects.with(Effect::Shadows);
    let (with, _) = render(&world, &plain, &Options { effects, ..Options::of(&world) }, |_| {});
    let (without, _) = render(
        &world,
        &plain,
        &Options { effects: effects.without(Effect::Shadows), ..Options::of(&world) },
        |_| {},
    );
    assert!(with != without, "no acne at all in f32 at a scale of a million");
}
