//! Tests of the rays and the work of one eye ray, counted on paper: the general kernel does no work
//! that cannot matter.

use std::path::Path;

use cases::{Effects, scene};
use reference::rules::Rules;
use reference::trace::render::{Options, count_by};
use reference::world::{Search, World};

/// The head of a scene with one eye ray, from (0, 0, 4) along −z, that is followed to depth 10.
const HEAD: &str = "[render]\nsize = [1, 1]\nmax_depth = 10\n[scene]\n\
    camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }\n";

/// The materials and lights of the scenes below.
const MATERIALS: &str = "materials = { chalk = { kd = [0.5, 0.5, 0.5] }, gloss = { kd = [0.5, \
    0.5, 0.5], ks = [0.5, 0.5, 0.5], kr = [0, 0, 0], ns = 8 }, ember = { ke = [1, 0, 0] }, red = \
    { kr = [1, 0, 0] }, green = { kr = [0, 1, 0] }, glass = { kt = [0.5, 1, 1], kr = [0, 0, 0], \
    index = 1.0003 } }\n";
const LAMP: &str = "point = { position = [3, 0, 3], colour = [1, 1, 1] }";
const FAR_LAMP: &str =
    "point = { position = [0, 0, 3], colour = [1, 1, 1], attenuation = { quadratic = 1 } }";
const BEHIND: &str =
    "point = { position = [3, 0, -3], colour = [1, 1, 1], attenuation = { linear = 1 } }";
const BLACK: &str = "point = { position = [3, 0, 3], colour = [0, 0, 0], ambient = [1, 1, 1] }";

/// Checks the counts of a scene, by keys of `Counts` and `Amounts`. The scene has no tree, so each
/// ray is tested against all objects in order. Returns the light that was skipped as too faint, in
/// the first channel.
#[track_caller]
fn check(
    what: &str,
    lights: &[&str],
    objects: &[&str],
    light_cutoff: f64,
    figures: &[(&str, u64)],
) -> f64 {
    let list = |items: &[&str]| {
        items.iter().map(|item| format!("{{ {item} }}")).collect::<Vec<_>>().join(", ")
    };
    let text =
        format!("{HEAD}{MATERIALS}lights = [{}]\nobjects = [{}]\n", list(lights), list(objects));
    let scene = scene::parse(what, &text, Path::new(""), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let world = World::<f64>::with_search(&scene, Search::Scan);
    let options = Options { effects: Effects::ALL, light_cutoff, ..Options::of(&world) };
    let (_, stats, work) = count_by(&world, &Rules::LECTURE, &options, |_| {});
    let (rays, work) =
        (serde_json::to_value(stats.rays).unwrap(), serde_json::to_value(work).unwrap());
    for (key, n) in figures {
        let found = rays.get(key).or(work.get(key)).and_then(serde_json::Value::as_u64);
        assert_eq!(found, Some(*n), "{what}: {key} of {rays} {work}");
    }
    stats.faint_light[0]
}

fn square(material: &str) -> String {
    format!("square = {{}}, material = \"{material}\"")
}

fn square_at(place: [i32; 3], material: &str) -> String {
    format!("{}, transforms = [{{ translate = {place:?} }}]", square(material))
}

/// Returns an object that no ray hits. Without a second object, no ray that leaves the first one
/// is cast, because it can only miss.
fn aside() -> String {
    square_at([9, 0, 0], "chalk")
}

#[test]
fn a_lamp_that_adds_nothing_casts_no_shadow_ray() {
    let (chalk, gloss, ember) = (square("chalk"), square("gloss"), square("ember"));
    for (what, lamp, object, shadow, powers, attenuations) in [
        ("a glossy square", LAMP, &gloss, 1, 1, 0),
        ("no highlight", LAMP, &chalk, 1, 0, 0),
        ("light that weakens", FAR_LAMP, &gloss, 1, 1, 1),
        ("a lamp behind the surface", BEHIND, &gloss, 0, 0, 0),
        ("neither kd nor ks", LAMP, &ember, 0, 0, 0),
        ("a black lamp", BLACK, &gloss, 0, 0, 0),
    ] {
        let figures =
            [("eye", 1), ("shadow", shadow), ("powers", powers), ("attenuations", attenuations)];
        check(what, &[lamp], &[object, &aside()], 0.0, &figures);
        // Once more, in another order: each lamp counts for itself.
        check(what, &[BLACK, lamp, BLACK], &[object, &aside()], 0.0, &figures);
    }
}

#[test]
fn a_shadow_ray_ends_at_the_first_opaque_object() {
    let [near, far] = [[1, 0, 1], [2, 0, 2]].map(|place| square_at(place, "chalk"));
    let [pane, other] = [[1, 0, 1], [2, 0, 2]].map(|place| square_at(place, "glass"));
    let gloss = square("gloss");
    // The eye ray is tested against all three squares. The shadow ray is tested against the square
    // that it leaves and the first one that it hits.
    let hidden =
        [("objects", 3 + 2), ("moved_rays", 2 + 1), ("tinted_crossings", 0), ("powers", 0)];
    check("two opaque squares", &[LAMP], &[&gloss, &near, &far], 0.0, &hidden);
    check("the other way round", &[LAMP], &[&gloss, &far, &near], 0.0, &hidden);
    // A shadow ray goes through glass: it hits each pane, which is flat, once.
    let tinted =
        [("objects", 3 + 3), ("moved_rays", 2 + 2), ("tinted_crossings", 2), ("powers", 1)];
    check("two panes", &[LAMP], &[&gloss, &pane, &other], 0.0, &tinted);
    check(
        "a pane, then a wall",
        &[LAMP],
        &[&gloss, &pane, &far],
        0.0,
        &[("tinted_crossings", 1), ("powers", 0)],
    );
}

#[test]
fn a_path_that_counts_for_nothing_ends() {
    let [red, green] = ["red", "green"].map(|material| square_at([0, 0, 8], material));
    let mirror = square("red");
    for (what, other, reflected) in
        [("two red mirrors", &red, 10), ("red light on a green mirror", &green, 1)]
    {
        check(
            what,
            &[],
            &[&mirror, other],
            0.0,
            &[("eye", 1), ("reflected", reflected), ("shadow", 0)],
        );
    }
    check("no mirror", &[], &[&square("gloss"), &red], 0.0, &[("reflected", 0), ("refracted", 0)]);
    // Through one pane, into the background. The ray is cast only if there is something to hit.
    let pane = square("glass");
    check("a pane", &[], &[&pane, &aside()], 0.0, &[("reflected", 0), ("refracted", 1)]);
    let ball = "sphere = {}, material = \"red\"";
    for (what, lone) in [("a lone pane", &*pane), ("a lone mirroring ball", ball)] {
        let figures = [("refracted", 0), ("reflected", 0), ("sure_misses", 1)];
        check(what, &[], &[lone], 0.0, &figures);
    }
}

#[test]
fn an_identity_transform_moves_no_ray() {
    let by = |step: &str| format!("{}, transforms = [{{ {step} }}]", square("chalk"));
    // Once to find the hit, once to compute its point, and once for the shadow ray.
    check("made twice as large", &[LAMP], &[&by("scale = 2")], 0.0, &[("moved_rays", 3)]);
    check("made as large as it is", &[LAMP], &[&by("scale = 1")], 0.0, &[("moved_rays", 0)]);
    check("moved nowhere", &[LAMP], &[&by("translate = [0, 0, 0]")], 0.0, &[("moved_rays", 0)]);
}

/// N·V < 0 < N·L and N·H < 0. This needs a shading normal that faces away from the eye.
#[test]
fn a_highlight_beyond_the_edge_is_raised_to_no_power() {
    let mesh = |normal: &str| {
        format!(
            "mesh = {{ vertices = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]], triangles = [[0, 1, 2]], \
                normals = [{normal}, {normal}, {normal}] }}, \
             material = \"gloss\""
        )
    };
    let lamp = "directional = { direction = [-2, 0, -1], colour = [1, 1, 1] }";
    for (what, normal, powers) in [("away", "[0.6, 0, -0.8]", 0), ("towards", "[0.6, 0, 0.8]", 1)] {
        let figures = [("shadow", 1), ("powers", powers), ("smooth_normals", 1)];
        check(what, &[lamp], &[&mesh(normal), &aside()], 0.0, &figures);
    }
}

#[test]
fn faint_light_is_not_followed_and_what_that_matters_is_known() {
    let chalk = square("chalk");
    // At most 1/9 of the light, half of which is reflected: 0.0556.
    let faint = |cutoff, shadow, skipped| {
        check(
            "a lamp",
            &[FAR_LAMP],
            &[&chalk, &aside()],
            cutoff,
            &[("shadow", shadow), ("faint_lights", skipped)],
        )
    };
    assert_eq!(faint(0.0, 1, 0), 0.0);
    assert_eq!(faint(0.05, 1, 0), 0.0);
    assert_eq!(faint(0.06, 0, 1), 0.5 / 9.0);
    let two = check(
        "two lamps",
        &[FAR_LAMP, FAR_LAMP],
        &[&chalk, &aside()],
        0.06,
        &[("shadow", 0), ("faint_lights", 2)],
    );
    assert_eq!(two, 1.0 / 9.0);
}
