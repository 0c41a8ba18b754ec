//! Random scenes and courses. They are written as text, so that they pass through the parsers like
//! any other.

use std::fmt::Write;

use cases::course::{self, Course, DECISIONS, Legal};
use cases::effects::Effects;
use cases::{Scene, scene};

use super::Random;

/// The width and the height of the pictures.
const SIZE: [u32; 2] = [16, 12];

impl Random {
    /// Returns an integer from 0 to n − 1.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((self.share() * n as f64) as usize).min(n - 1)
    }

    /// Returns one of the items, all equally likely.
    pub(crate) fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }

    /// Returns `true` with the probability `share`.
    pub(crate) fn is(&mut self, share: f64) -> bool {
        self.share() < share
    }
}

/// Returns a legal course: a value for every key. The values of a choice are equally likely.
pub(crate) fn course(random: &mut Random) -> Course {
    let mut text = String::new();
    for decision in DECISIONS {
        let value = match decision.legal {
            Legal::OneOf(values) => random.pick(values).0.to_owned(),
            Legal::Range { least, most, .. } => {
                (least * cases::maths::pow(most / least, random.share())).to_string()
            }
            // The effects that programs always simulate change the effects that a stage allows.
            // They change no scene by itself.
            Legal::Effects => continue,
        };
        let _ = writeln!(text, "{} = {value}", decision.key);
    }
    course::parse("random course", &text).unwrap_or_else(|problems| panic!("{problems}"))
}

/// Returns a scene of one to five objects, with the effects that it calls for under `course`.
/// Single objects, eyes inside objects, black lamps and black materials are frequent, because they
/// call for fewer effects.
pub(crate) fn scene(random: &mut Random, course: &Course) -> Scene {
    let text = text(random);
    let read = scene::parse("random scene", &text, std::path::Path::new(""), course);
    read.unwrap_or_else(|problems| panic!("{text}\n{problems}"))
}

/// Returns the scene with exactly `effects`.
pub(crate) fn with(scene: &Scene, effects: Effects) -> Scene {
    Scene { effects, ..scene.clone() }
}

fn text(random: &mut Random) -> String {
    let max_depth = random.below(4);
    let threshold = if random.is(0.3) { "0.05" } else { "0" };
    let eye = if random.is(0.2) { vector(random, 0.3) } else { vector(random, 4.0) };
    let [width, height] = SIZE;
    let mut text = format!(
        "[render]\nsize = [{width}, {height}]\nmax_depth = {max_depth}\nthreshold = {threshold}\n\
         [scene]\nbackground = {}\n\
         [scene.camera]\neye = {eye}\nlook_at = {}\nup = [0.1, 1, 0.05]\nfov_y_deg = 50\n\
         [scene.materials]\n",
        colour(random, 0.5),
        vector(random, 0.2),
    );
    for n in 0..3 {
        let (kd, ks, kt) = (colour(random, 0.2), colour(random, 0.5), colour(random, 0.6));
        let kr =
            if random.is(0.5) { format!(", kr = {}", colour(random, 0.5)) } else { String::new() };
        let _ =
            writeln!(text, "m{n} = {{ kd = {kd}, ks = {ks}, kt = {kt}, ns = 9, index = 1.4{kr} }}");
    }
    for _ in 0..random.below(4) {
        let _ = writeln!(text, "[[scene.lights]]\n{}", light(random));
    }
    for _ in 0..1 + random.below(5) * random.below(2) {
        let _ = writeln!(
            text,
            "[[scene.objects]]\nmaterial = \"m{}\"\n{}",
            random.below(3),
            object(random)
        );
    }
    text
}

fn vector(random: &mut Random, size: f64) -> String {
    let [x, y, z] = [0, 1, 2].map(|_| size * random.signed());
    format!("[{x}, {y}, {z}]")
}

/// Returns a colour, which is black with the probability `black`.
fn colour(random: &mut Random, black: f64) -> String {
    if random.is(black) {
        return "[0, 0, 0]".to_owned();
    }
    let [r, g, b] = [0, 1, 2].map(|_| if random.is(0.2) { 0.0 } else { 0.6 * random.share() });
    format!("[{r}, {g}, {b}]")
}

fn light(random: &mut Random) -> String {
    let (colour, ambient) = (colour(random, 0.2), colour(random, 0.5));
    if random.is(0.4) {
        return format!(
            "directional = {{ direction = [{}, -1, 0.3], colour = {colour}, ambient = {ambient} }}",
            random.signed()
        );
    }
    let position = vector(random, 4.0);
    let attenuation =
        if random.is(0.5) { ", attenuation = { quadratic = 0.3, constant = 0.2 }" } else { "" };
    format!(
        "point = {{ position = {position}, colour = {colour}, ambient = {ambient}{attenuation} }}"
    )
}

fn object(random: &mut Random) -> String {
    const SHAPES: [&str; 8] = [
        "sphere = {}",
        "sphere = { radius = 1.3 }",
        "square = {}",
        "box = {}",
        "plane = { normal = [0.1, 1, 0], k = -0.7 }",
        "cylinder = { capped = false }",
        "cone = {}",
        "mesh = { vertices = [[-1, -1, 0], [1, -1, 0], [0, 1, 0.5]], triangles = [[0, 1, 2]] }",
    ];
    const SMOOTH: &str = "mesh = { vertices = [[-1, -1, 0], [1, -1, 0], [0, 1, 0.5], [0, 0, 1]], \
        triangles = [[0, 1, 3], [1, 2, 3], [2, 0, 3]], normals = [[-1, -1, 0.5], [1, -1, 0.5], \
        [0, 1, 0.5], [0, 0, 1]] }";
    let shape = if random.is(0.15) { SMOOTH } else { random.pick(&SHAPES) };
    if random.is(0.5) {
        return shape.to_owned();
    }
    let (place, angle) = (vector(random, 1.5), 180.0 * random.signed());
    format!(
        "{shape}\ntransforms = [{{ scale = [0.7, 1.2, 1] }}, {{ rotate = {{ axis = [1, 1, 0], \
            angle_deg = {angle} }} }}, {{ translate = {place} }}]"
    )
}
