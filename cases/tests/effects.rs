//! For each effect, scenes that call for it and scenes that do not, with the reason that is given.

use std::path::Path;

use cases::effects::{self, Effect};
use cases::scene;

const HEAD: &str = "[scene]\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], \
    fov_y_deg = 40 }\n\
    materials = { chalk = { kd = [1, 1, 1] }, glass = { kt = [0, 1, 0], index = 1.5 }, \
    opal = { kd = [1, 1, 1], kt = [0, 1, 0], index = 1.5 }, tin = { kr = [0, 0, 0.1] } }\n";
const LAMP: &str = "lights = [{ point = { position = [0, 3, 0], colour = [1, 1, 1] } }]";
const BALL: &str = "objects = [{ sphere = {}, material = \"chalk\" }]";

fn check(effect: Effect, render: &str, body: &str, called_for: bool, because: &str) {
    let text = format!("render = {{ size = [1, 1]{render} }}\n{HEAD}{body}\n");
    let scene = scene::parse("test", &text, Path::new(""), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let reason = effects::reasons(&scene, &cases::Course::default())
        .into_iter()
        .find(|reason| reason.effect == effect)
        .unwrap();
    assert_eq!(
        (reason.called_for, reason.because.as_str()),
        (called_for, because),
        "{effect}: {body}"
    );
    assert_eq!(scene.effects.has(effect), called_for, "{effect}: {body}");
}

#[test]
fn every_effect_is_called_for_with_its_reason() {
    use Effect::*;
    let object = |object: &str| format!("{LAMP}\nobjects = [{object}]");
    let two =
        object("{ sphere = {}, material = \"chalk\" }, { square = {}, material = \"chalk\" }");
    let lone =
        |shape: &str, material: &str| object(&format!("{{ {shape}, material = \"{material}\" }}"));
    let triangle = "vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]]";
    let flat = lone(&format!("mesh = {{ {triangle} }}"), "chalk");
    let smooth = lone(
        &format!("mesh = {{ {triangle}, normals = [[0, 0, 1], [0, 0, 1], [0, 0, 1]] }}"),
        "chalk",
    );
    let around_eye = lone("sphere = { radius = 9 }", "chalk");
    let weak = LAMP.replace(" } }]", ", attenuation = { linear = 1 } } }]");
    let black = weak.replace("[1, 1, 1]", "[0, 0, 0], ambient = [1, 1, 1]");
    let deep = ", max_depth = 1";
    let table: &[(Effect, &str, &str, bool, &str)] = &[
        (Shadows, "", BALL, false, "no light shines"),
        (Shadows, "", LAMP, false, "there is no object"),
        (
            Shadows,
            "",
            &lone("sphere = {}", "chalk"),
            false,
            "objects[0] is alone and cannot shadow itself",
        ),
        (
            Shadows,
            "",
            &lone("plane = { normal = [0, 1, 0], k = 0 }", "opal"),
            false,
            "objects[0] is alone and cannot shadow itself",
        ),
        (
            Shadows,
            "",
            &lone("sphere = {}", "glass"),
            false,
            "no object has kd or ks in a colour in which a light shines",
        ),
        (Shadows, "", &lone("sphere = {}", "opal"), true, "objects[0] can shadow itself"),
        (Shadows, "", &around_eye, true, "objects[0] can shadow itself"),
        (Shadows, "", &lone("cylinder = {}", "chalk"), true, "objects[0] can shadow itself"),
        (Shadows, "", &flat, true, "objects[0] can shadow itself"),
        (Shadows, "", &two, true, "one object can hide a light from another"),
        (TintedShadows, "", &two, false, "no object's material has kt > 0"),
        (TintedShadows, "", BALL, false, "no light shines"),
        (
            TintedShadows,
            "",
            &two.replacen("chalk", "glass", 1),
            true,
            "material \"glass\" has kt > 0",
        ),
        (Reflection, "", &lone("sphere = {}", "tin"), false, "render.max_depth is 0"),
        (Reflection, deep, &lone("sphere = {}", "chalk"), false, "no object's material has kr > 0"),
        (Reflection, deep, &lone("sphere = {}", "tin"), true, "material \"tin\" has kr > 0"),
        (Refraction, "", &lone("sphere = {}", "glass"), false, "render.max_depth is 0"),
        (Refraction, deep, &lone("sphere = {}", "tin"), false, "no object's material has kt > 0"),
        (Refraction, deep, &lone("sphere = {}", "glass"), true, "material \"glass\" has kt > 0"),
        (SmoothNormals, "", &flat, false, "no mesh carries vertex normals"),
        (SmoothNormals, "", &smooth, true, "mesh objects[0] carries vertex normals"),
        (Transforms, "", &two, false, "every object's matrix is the identity"),
        (
            Transforms,
            "",
            &lone("transforms = [{ scale = 1 }], sphere = {}", "chalk"),
            false,
            "every object's matrix is the identity",
        ),
        (
            Transforms,
            "",
            &lone("transforms = [{ scale = 2 }], sphere = {}", "chalk"),
            true,
            "objects[0] has a matrix that is not the identity",
        ),
        (Attenuation, "", LAMP, false, "no light that shines weakens with distance"),
        (Attenuation, "", &black, false, "no light that shines weakens with distance"),
        (Attenuation, "", &weak, true, "lights[0] weakens with distance"),
        (AdaptiveDepth, "", LAMP, false, "render.threshold is 0"),
        (
            AdaptiveDepth,
            ", threshold = 0.25",
            LAMP,
            false,
            "render.threshold is 0.25, but no object spawns rays",
        ),
        (
            AdaptiveDepth,
            ", max_depth = 1, threshold = 0.25",
            &lone("sphere = {}", "tin"),
            true,
            "render.threshold is 0.25",
        ),
    ];
    for (effect, render, body, called_for, because) in table {
        check(*effect, render, body, *called_for, because);
    }
    for effect in Effect::ALL {
        for called_for in [true, false] {
            assert!(
                table.iter().any(|row| row.0 == effect && row.3 == called_for),
                "{effect} = {called_for} is not in the table"
            );
        }
    }
}

#[test]
fn names_and_sets_agree() {
    for effect in Effect::ALL {
        assert_eq!(Effect::from_name(effect.name()), Some(effect));
        assert_eq!(serde_json::to_value(effect).unwrap(), effect.name());
        let all = cases::Effects::all();
        assert!(
            all.has(effect)
                && !all.without(effect).has(effect)
                && all.without(effect).with(effect) == all
        );
    }
    assert_eq!(Effect::from_name("caustics"), None);
}
