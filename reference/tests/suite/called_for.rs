//! Tests that effects which a scene does not call for under its course change no bit of its
//! picture: `auto` gives the picture of `all`.

use crate::common::{Random, random};
use cases::course::{self, Course, TwoSided};
use cases::effects::{self, Effect, Effects};
use cases::film::Image;
use cases::{Scene, scene};
use rayon::prelude::*;
use reference::rules::Rules;
use reference::trace::render::{Options, render_by};
use reference::world::World;

fn picture(scene: &Scene, course: &Course) -> Image {
    let world = World::<f64>::new(scene);
    render_by(&world, &Rules::of(course), &Options::of(&world), |_| {}).0
}

/// Returns the number of pixels that differ in a bit.
fn n_different(one: &Image, other: &Image) -> usize {
    let bits = |light: &glam::DVec3| light.to_array().map(f64::to_bits);
    one.pixels().iter().zip(other.pixels()).filter(|(a, b)| bits(a) != bits(b)).count()
}

#[test]
fn auto_is_all_in_1000_scenes_under_1000_courses() {
    let found: Vec<(Effects, TwoSided, Option<String>)> = (1..=1000u64)
        .into_par_iter()
        .map(|seed| {
            let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            let course = random::course(&mut random);
            let scene = random::scene(&mut random, &course);
            let all = random::with(&scene, Effects::ALL);
            let n = n_different(&picture(&scene, &course), &picture(&all, &course));
            let wrong =
                (n > 0).then(|| format!("seed {seed}: {n} pixels under {:?}", course.written()));
            (scene.effects, course.two_sided, wrong)
        })
        .collect();
    let wrong: Vec<&String> = found.iter().filter_map(|(.., wrong)| wrong.as_ref()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    // Each effect is called for in some scenes and not in others. Otherwise the test is vacuous.
    for effect in Effect::ALL {
        let n = found.iter().filter(|(effects, ..)| effects.has(effect)).count();
        assert!((60..=940).contains(&n), "{effect} is called for in {n} of 1000 scenes");
    }
    // So is each answer to which side of a surface is lit, which decides about lone solids.
    for answer in [TwoSided::Never, TwoSided::Transmissive, TwoSided::Always] {
        let n = found.iter().filter(|(_, two_sided, _)| *two_sided == answer).count();
        assert!(n >= 200, "{answer:?} is drawn in {n} of 1000 courses");
    }
}

const BALL: &str = "[render]\nsize = [64, 64]\n\
    [scene.camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 20\n\
    [scene.materials]\nchalk = { kd = [0.8, 0.8, 0.8] }\n\
    glass = { kd = [0.1, 0.1, 0.1], kt = [0.5, 0.9, 0.5], index = 1.5 }\n\
    [[scene.lights]]\ndirectional = { direction = [-1, -1, 0.5], colour = [1, 1, 1] }\n\
    [[scene.objects]]\nMATERIAL\nSHAPE\n";

fn ball(shape: &str, material: &str, course: &Course) -> Scene {
    let text =
        BALL.replace("MATERIAL", &format!("material = \"{material}\"")).replace("SHAPE", shape);
    scene::parse("ball", &text, std::path::Path::new(""), course)
        .unwrap_or_else(|problems| panic!("{problems}"))
}

/// A convex solid that is lit from behind occludes the light for its own far side. The course
/// decides whether this shows; the scene alone does not.
#[test]
fn a_lone_solid_that_is_lit_from_behind_calls_for_shadows() {
    for shape in ["sphere = {}", "box = {}"] {
        for (line, called_for) in
            [("two_sided = \"never\"", false), ("two_sided = \"always\"", true)]
        {
            let course = course::parse("course", line).unwrap();
            let scene = ball(shape, "chalk", &course);
            assert_eq!(scene.effects.has(Effect::Shadows), called_for, "{shape}, {line}");
            let without = random::with(&scene, scene.effects.without(Effect::Shadows));
            let n = n_different(&picture(&scene, &course), &picture(&without, &course));
            assert_eq!(n > 100, called_for, "{shape}, {line}: {n} pixels");
        }
    }
}

const SMOOTH: &str = "[render]\nsize = [8, 6]\nmax_depth = 3\nthreshold = 0.1\n\
    [scene.camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 20\n\
    [scene.materials]\nm = { MATERIAL }\n\
    [[scene.lights]]\npoint = { position = [0, 0, 9], colour = [1, 0, 0], attenuation = { \
    constant = CONSTANT } }\n\
    [[scene.objects]]\nsquare = {}\nmaterial = \"m\"\n\
    [[scene.objects]]\nmaterial = \"m\"\nmesh = { vertices = [[-1, -1, 0], [1, -1, 0], [0, 1, \
    0.5]], triangles = [[0, 1, 2]], normals = [[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1]] }\n";

/// What no pixel can show is not called for: shadows and normals without kd and ks in the colour of
/// a light, a threshold where nothing is spawned, attenuation that is clamped to 1.
#[test]
fn what_nothing_can_show_is_not_called_for() {
    use Effect::{AdaptiveDepth, Attenuation, Reflection, Shadows, SmoothNormals};
    let lit = Effects::NONE.with(Shadows).with(SmoothNormals);
    let table = [
        ("kd = [1, 1, 1]", "0.5", "", lit),
        ("kd = [1, 1, 1]", "2", "", lit.with(Attenuation)),
        ("kd = [1, 1, 1]", "0.5", "attenuation = \"unclamped\"", lit.with(Attenuation)),
        ("ke = [1, 1, 1], kd = [0, 0, 0]", "1", "", Effects::NONE),
        ("kd = [0, 1, 1]", "1", "", Effects::NONE),
        ("kd = [0, 1, 1]", "1", "highlight = \"phong\"", lit),
        ("kd = [0, 1, 1]", "1", "inside_by = \"interpolated\"", Effects::NONE.with(SmoothNormals)),
        (
            "kd = [0, 1, 1], kr = [0, 0, 1]",
            "1",
            "",
            Effects::NONE.with(Reflection).with(SmoothNormals).with(AdaptiveDepth),
        ),
    ];
    for (material, constant, line, expected) in table {
        let course = course::parse("course", &format!("bytes = \"rounded\"\n{line}")).unwrap();
        let text = SMOOTH.replace("MATERIAL", material).replace("CONSTANT", constant);
        let scene = scene::parse("smooth", &text, std::path::Path::new(""), &course)
            .unwrap_or_else(|problems| panic!("{problems}"));
        let found: Vec<Effect> = effects::called_for(&scene, &course).iter().collect();
        assert_eq!(found, expected.iter().collect::<Vec<_>>(), "{material}, {constant}, {line}");
    }
}

#[test]
fn what_a_course_does_to_glass_decides_about_its_shadows() {
    let table = [
        (
            "tint = \"per_crossing\"",
            [Some("objects[0] can shadow itself"), Some("material \"glass\" has kt > 0")],
        ),
        ("tint = \"opaque\"", [Some("objects[0] can shadow itself"), None]),
        ("tint = \"none\"", [None, None]),
    ];
    for (line, expected) in table {
        let course = course::parse("course", line).unwrap();
        let scene = ball("sphere = {}", "glass", &course);
        let reasons = effects::reasons(&scene, &course);
        let why = |effect: Effect| {
            let reason = reasons.iter().find(|reason| reason.effect == effect).unwrap();
            reason.called_for.then_some(reason.because.as_str())
        };
        assert_eq!([why(Effect::Shadows), why(Effect::TintedShadows)], expected, "{line}");
    }
}
