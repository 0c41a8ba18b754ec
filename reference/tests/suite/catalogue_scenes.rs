//! Tests of the catalogue's cases of light: attenuation and interpolation as given, shadows and
//! mirrors as scenes built from their descriptions.

use crate::common::catalogue::{self, id, number, three};
use crate::common::scene;
use cases::probe::{Answer, Ask};
use cases::scene::Attenuation;
use cases::{Light, Ray};
use glam::DVec3;
use reference::rules::{Lecture, Rules};
use reference::trace::answers::answer_in;
use serde_json::Value;

/// Returns the answers of both precisions, each with the relative rounding error of the precision.
fn answers(rules: &Rules, ask: &Ask) -> [(Answer, f64); 2] {
    [
        (answer_in::<f64, _>(rules, ask), f64::EPSILON),
        (answer_in::<f32, _>(rules, ask), f64::from(f32::EPSILON)),
    ]
}

fn check(case: &Value, rules: &Rules, ask: &Ask, expected: [f64; 3]) {
    let ulps = case["bound"]["allowed_ulps_f64"].as_f64().expect("a bound");
    for (answer, ulp) in answers(rules, ask) {
        let found = match answer {
            Answer::Colour(found) | Answer::Vector(found) => found.to_array(),
            Answer::Value(found) => [found; 3],
            other => panic!("{}: {other:?}", id(case)),
        };
        let is_near = |n: usize| {
            (found[n] - expected[n]).abs() <= ulps * ulp * expected[n].abs().max(1e-300 / ulp)
        };
        assert!((0..3).all(is_near), "{}: {found:?} is not {expected:?} to {ulp:e}", id(case));
    }
}

#[test]
fn light_weakens_without_overflow() {
    for case in catalogue::of("attenuation") {
        let [a, b, c, r] = ["a", "b", "c", "r"].map(|name| number(&case["inputs"][name]));
        let light = Light::Point {
            position: DVec3::ZERO,
            colour: DVec3::ONE,
            ambient: DVec3::ZERO,
            // The catalogue exchanges the letters a and c of rule 4.
            attenuation: Attenuation { quadratic: c, linear: b, constant: a },
        };
        let ask = Ask::Attenuation { light, r };
        let expected = number(&case["expected"]["value"]);
        if [a, b, c, r]
            .iter()
            .all(|x| x.abs() < f64::from(f32::MAX) && (*x == 0.0 || x.abs() > 1e-38))
        {
            check(&case, &Rules::LECTURE, &ask, [expected; 3]);
            continue;
        }
        let Answer::Value(found) = answer_in::<f64, _>(Lecture, &ask) else {
            panic!("{}: no value", id(&case))
        };
        assert!((found - expected).abs() <= 1e-300, "{}: {found} is not {expected}", id(&case));
    }
}

#[test]
fn normals_are_mixed_and_of_unit_length() {
    for case in catalogue::of("barycentric") {
        let weights = DVec3::from_array(three(&case["inputs"]["bary"]));
        let normals = [0, 1, 2].map(|n| DVec3::from_array(three(&case["inputs"]["normals"][n])));
        check(
            &case,
            &Rules::LECTURE,
            &Ask::Interpolate { weights, normals },
            three(&case["expected"]["normal"]),
        );
    }
}

/// A shadow case: the light and the objects around the point `at`, and where the catalogue has S
/// there. [rule 5] [rule 6]
struct Shadow {
    id: &'static str,
    light: &'static str,
    materials: &'static str,
    objects: &'static str,
    at: [f64; 3],
    /// The field of the catalogue with S, and `power`, the power to raise it to: a closed surface
    /// is crossed twice.
    field: &'static str,
    power: u32,
}

const LAMP: &str = "point = { position = [0, 10, 0], colour = [1, 1, 1] }";
const LOW_LAMP: &str = "point = { position = [0, 4, 0], colour = [1, 1, 1] }";
const SUN: &str = "directional = { direction = [0, -1, 0], colour = [1, 1, 1] }";
const LOW_SUN: &str = "directional = { direction = [-1, -0.001, 0], colour = [1, 1, 1] }";
const PANES: &str =
    "transforms = [{ rotate = { axis = [1, 0, 0], angle_deg = 90 } }, { translate = [0, 5, 0] }]";

const SHADOWS: &[Shadow] = &[
    Shadow {
        id: "H02",
        light: LOW_LAMP,
        materials: "",
        objects: "[[scene.objects]]\nplane = { normal = [0, 1, 0], k = 4 }\nmaterial = \"chalk\"",
        at: [0.0; 3],
        field: "attenuation",
        power: 1,
    },
    Shadow {
        id: "H04",
        light: LOW_LAMP,
        materials: "",
        objects: "[[scene.objects]]\nsphere = { center = [0, 6, 0], radius = 1 }\n\
            material = \"chalk\"",
        at: [0.0; 3],
        field: "attenuation",
        power: 1,
    },
    Shadow {
        id: "H05",
        light: SUN,
        materials: "",
        objects: "[[scene.objects]]\nsphere = { center = [0, 1e8, 0], radius = 1 }\n\
            material = \"chalk\"",
        at: [0.0; 3],
        field: "attenuation",
        power: 1,
    },
    Shadow {
        id: "H06",
        light: LAMP,
        materials: "tint = { kt = [0.5, 0.25, 1], index = 1.5 }",
        objects: "[[scene.objects]]\nsphere = { center = [0, 5, 0], radius = 1 }\n\
            material = \"tint\"",
        at: [0.0; 3],
        field: "per_surface",
        power: 1,
    },
    Shadow {
        id: "H08",
        light: LAMP,
        materials: "tint = { kt = [0.5, 1, 1], index = 1.5 }\n\
            other = { kt = [1, 0.5, 0.25], index = 1.5 }",
        objects: "[[scene.objects]]\nsphere = { center = [0, 3, 0], radius = 1 }\n\
            material = \"tint\"\n\
            [[scene.objects]]\nsphere = { center = [0, 7, 0], radius = 1 }\nmaterial = \"other\"",
        at: [0.0; 3],
        field: "per_object",
        power: 2,
    },
    Shadow {
        id: "H10",
        light: LAMP,
        materials: "tint = { kt = [0.5, 0.5, 0.5], index = 1.5 }",
        objects: "[[scene.objects]]\nsphere = { center = [0, 3, 0], radius = 1 }\n\
            material = \"tint\"\n\
            [[scene.objects]]\nplane = { normal = [0, 1, 0], k = 8 }\nmaterial = \"chalk\"",
        at: [0.0; 3],
        field: "attenuation",
        power: 1,
    },
    Shadow {
        id: "H11",
        light: LAMP,
        materials: "tint = { kt = [0.5, 0.5, 0.5], index = 1.5 }",
        objects: "[[scene.objects]]\nsquare = {}\nmaterial = \"tint\"\nPANES\n[[scene.objects]]\n\
            square = {}\nmaterial = \"tint\"\nPANES",
        at: [0.0; 3],
        field: "per_object",
        power: 1,
    },
    Shadow {
        id: "H13",
        light: LAMP,
        materials: "tint = { kt = [0.5, 1, 1], index = 1.5 }",
        objects: "[[scene.objects]]\nsphere = { center = [0, 0, 0], radius = 2 }\n\
            material = \"tint\"",
        at: [0.0; 3],
        field: "per_object",
        power: 1,
    },
    Shadow {
        id: "H14",
        light: LOW_SUN,
        materials: "",
        objects: "[[scene.objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n\
            material = \"chalk\"",
        at: [0.0, 1.0, 0.0],
        field: "attenuation",
        power: 1,
    },
];

#[test]
fn shadows_are_those_of_the_paper() {
    let cases = catalogue::of("shadow");
    assert_eq!(cases.len(), SHADOWS.len() + 3, "three cases are about shading");
    for shadow in SHADOWS {
        let case = cases
            .iter()
            .find(|case| id(case) == shadow.id)
            .unwrap_or_else(|| panic!("no case {}", shadow.id));
        let text = format!(
            "[scene.materials]\nchalk = {{ kd = [0.5, 0.5, 0.5] }}\n{}\n[[scene.lights]]\n{}\n\
             [[scene.objects]]\nplane = {{ normal = [0, 1, 0], k = 0 }}\nmaterial = \"chalk\"\n{}",
            shadow.materials,
            shadow.light,
            shadow.objects.replace("PANES", PANES),
        );
        let ask = Ask::Shadow {
            scene: Box::new(scene(&text)),
            light: 0,
            point: DVec3::from_array(shadow.at),
        };
        let expected = three(&case["expected"][shadow.field])
            .map(|s| if shadow.power == 2 { s * s } else { s });
        check(case, &Rules::LECTURE, &ask, expected);
    }
}

fn shaded(id: &str, position: &str, normal: DVec3, to_viewer: DVec3) {
    let text = format!(
        "[scene.materials]\ngloss = {{ kd = [1, 1, 1], ks = [1, 1, 1], kr = [0, 0, 0], ns = 2.5 \
            }}\n\
         [[scene.lights]]\npoint = {{ position = {position}, colour = [1, 1, 1] }}\n\
         [[scene.objects]]\nplane = {{ normal = [0, 1, 0], k = 0 }}\nmaterial = \"gloss\"",
    );
    let case =
        catalogue::of("shadow").into_iter().find(|case| self::id(case) == id).expect("the case");
    let point = DVec3::ZERO;
    let ask = Ask::Shade {
        scene: Box::new(scene(&text)),
        object: 0,
        point,
        normal,
        to_viewer,
        inside: false,
    };
    check(&case, &Rules::LECTURE, &ask, [0.0; 3]);
}

#[test]
fn a_light_at_the_point_or_behind_it_gives_nothing() {
    shaded("H01", "[0, 0, 0]", DVec3::Y, DVec3::Y);
    shaded("H15", "[0, -5, 0]", DVec3::Y, DVec3::Y);
    shaded("H15", "[0, -5, 0]", DVec3::Y, DVec3::new(0.6, 0.8, 0.0));
}

/// Rule 19 shades with the interpolated normal. The light is behind the face itself, whose own
/// normal would give no light.
#[test]
fn a_light_below_the_face_is_seen_by_the_interpolated_normal() {
    let case =
        catalogue::of("shadow").into_iter().find(|case| id(case) == "H16").expect("the case");
    let text = "[scene.materials]\nchalk = { kd = [1, 1, 1] }\n[[scene.objects]]\nsphere = {}\n\
        material = \"chalk\"";
    let material = scene(text).materials[0].clone();
    let term = |normal| Ask::LightTerm {
        material: material.clone(),
        arriving: DVec3::ONE,
        normal,
        to_viewer: DVec3::Y,
        to_light: DVec3::new(0.96, -0.28, 0.0),
    };
    let by_shading = number(&case["expected"]["Ns_dot_L"]);
    check(&case, &Rules::LECTURE, &term(DVec3::new(0.6, 0.8, 0.0)), [by_shading; 3]);
    assert!(number(&case["expected"]["Ng_dot_L"]) < 0.0);
    check(&case, &Rules::LECTURE, &term(DVec3::Y), [0.0; 3]);
}

/// Returns the question for the colour along the axis between two mirrors that emit 1.
fn between_mirrors(reflectivity: f64, max_depth: u64, threshold: f64) -> Ask {
    let text = format!(
        "[scene.materials]\nmirror = {{ ke = [1, 1, 1], kr = [{reflectivity}, {reflectivity}, \
            {reflectivity}] }}\n\
         [[scene.objects]]\nplane = {{ normal = [0, 0, 1], k = 0 }}\nmaterial = \"mirror\"\n\
         [[scene.objects]]\nplane = {{ normal = [0, 0, -1], k = -1 }}\nmaterial = \"mirror\"",
    );
    let mut scene = scene(&text);
    scene.render.max_depth = u32::try_from(max_depth).expect("a depth");
    scene.render.threshold = threshold;
    scene.effects = cases::effects::called_for(&scene, &cases::Course::default());
    let ray = Ray::new(DVec3::new(0.0, 0.0, 0.5), DVec3::NEG_Z);
    Ask::Trace { scene: Box::new(scene), ray, depth: 0 }
}

#[test]
fn mirrors_give_the_geometric_series() {
    for case in catalogue::of("recursion") {
        let reflectivity = number(&case["inputs"]["reflectivity"]);
        let radiance = number(&case["expected"]["radiance"]);
        let Some(max_depth) = case["inputs"]["max_depth"].as_u64() else {
            let ask = between_mirrors(reflectivity, 400, number(&case["inputs"]["threshold"]));
            // The catalogue casts no ray below the threshold. The reference casts one, which adds
            // its own light [D16].
            let sparing = Rules { casts_faint_rays: false, ..Rules::LECTURE };
            check(&case, &sparing, &ask, [radiance; 3]);
            let n_rays = case["expected"]["rays"].as_u64().expect("a number of rays");
            let faint: f64 = (0..n_rays).map(|_| reflectivity).product();
            check(&case, &Rules::LECTURE, &ask, [radiance + faint; 3]);
            assert!(
                faint < number(&case["expected"]["error"]),
                "the last ray brings the sum nearer to its limit"
            );
            continue;
        };
        check(
            &case,
            &Rules::LECTURE,
            &between_mirrors(reflectivity, max_depth, 0.0),
            [radiance; 3],
        );
    }
}
