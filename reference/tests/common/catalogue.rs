//! The catalogue of hard cases, read from `data/hard-cases.json`.

#![allow(dead_code, reason = "no test needs all of it")]

use reference::hard::Question;
use reference::hard::exact::Exact;
use reference::hard::question::Line;
use serde_json::Value;

/// A case whose answer is that of one function of a shape or of optics.
pub(crate) struct Hard {
    pub(crate) id: String,
    pub(crate) question: Question,
    /// Whether something is hit, transmitted, invertible.
    pub(crate) is_hit: bool,
    /// The same for inputs in single precision.
    pub(crate) is_hit_in_single: bool,
    pub(crate) t: Option<f64>,
    pub(crate) vector: Option<[f64; 3]>,
    pub(crate) weights: Option<[f64; 3]>,
    /// Relative condition number; none where only the decision counts.
    pub(crate) kappa: Option<f64>,
    /// The case on the other side of a shared edge.
    pub(crate) pair: Option<String>,
}

/// The whole file's cases.
pub(crate) fn all() -> Vec<Value> {
    let text = include_str!("../data/hard-cases.json");
    let file: Value = serde_json::from_str(text).expect("the catalogue is JSON");
    file["cases"].as_array().expect("a list of cases").clone()
}

/// The cases of one function.
pub(crate) fn of(function: &str) -> Vec<Value> {
    all().into_iter().filter(|case| case["function"] == function).collect()
}

/// The cases that are one question to one function.
pub(crate) fn hard() -> Vec<Hard> {
    all()
        .iter()
        .filter_map(|case| Some((case, question(case)?)))
        .map(|(case, question)| one(case, question))
        .collect()
}

fn one(case: &Value, question: Question) -> Hard {
    let expected = &case["expected"];
    let is_hit = expected["hit"].as_bool().expect("a decision");
    let vector =
        [&expected["normal"], &expected["direction"]].into_iter().find(|v| v.is_array()).map(three);
    Hard {
        id: id(case),
        question,
        is_hit,
        is_hit_in_single: expected["hit_if_inputs_rounded_to_f32"].as_bool().unwrap_or(is_hit),
        t: expected["t"].is_string().then(|| number(&expected["t"])),
        vector,
        weights: expected["bary"].is_array().then(|| three(&expected["bary"])),
        kappa: case["bound"]["kappa"].as_f64(),
        pair: case["pair"].as_str().map(str::to_owned),
    }
}

fn question(case: &Value) -> Option<Question> {
    let given = |name: &str| &case["inputs"][format!("{name}_dec")];
    let line = || Line { origin: three(given("O")), direction: three(given("D")) };
    let rows = || {
        let m: Vec<f64> =
            given("M_row_major").as_array().expect("a matrix").iter().map(number).collect();
        [[m[0], m[1], m[2]], [m[3], m[4], m[5]], [m[6], m[7], m[8]]]
    };
    let round = |radii| Question::Round { line: line(), radii, ends: [0.0, 1.0], is_capped: false };
    Some(match case["function"].as_str().expect("a function") {
        "sphere" => {
            Question::Sphere { line: line(), center: three(given("C")), radius: number(given("r")) }
        }
        "plane" => {
            let line = line();
            let origin = moved(line.origin, three(given("Q")));
            Question::Plane { line: Line { origin, ..line }, normal: three(given("N")), k: 0.0 }
        }
        "triangle" => Question::Triangle {
            line: line(),
            corners: ["A", "B", "C"].map(|name| three(given(name))),
        },
        "box" => {
            Question::Cuboid { line: line(), min: three(given("min")), max: three(given("max")) }
        }
        "cylinder" => round([1.0, 1.0]),
        "cone" => round([0.0, 1.0]),
        "reflect" => Question::Reflect { direction: three(given("D")), normal: three(given("N")) },
        "refract" => {
            let [eta_i, eta_t] = ["n1", "n2"].map(|name| number(given(name)));
            Question::Refract {
                direction: three(given("D")),
                normal: three(given("N")),
                eta_i,
                eta_t,
            }
        }
        "transform_normal" => Question::Normal { rows: rows(), normal: three(given("N")) },
        "transformed_sphere" => Question::TransformedSphere {
            line: line(),
            rows: rows().map(|row| row.map(|x| 2.0 * x)), // the unit sphere has twice our radius
            translation: three(given("translate")),
        },
        _ => return None,
    })
}

/// P − Q, which must be exact: planes are given by a point there, by k here, and N·Q would be
/// rounded.
fn moved(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|n| {
        let off = p[n] - q[n];
        assert_eq!(&Exact::of(p[n]) - &Exact::of(q[n]), Exact::of(off), "{p:?} − {q:?} is rounded");
        off
    })
}

/// The case's id.
pub(crate) fn id(case: &Value) -> String {
    case["id"].as_str().expect("an id").to_owned()
}

/// A number: decimal, `a/b`, or a hex float.
pub(crate) fn number(value: &Value) -> f64 {
    let text = value.as_str().unwrap_or_else(|| panic!("{value} is no text with a number"));
    if let Some((above, below)) = text.split_once('/') {
        return decimal(above) / decimal(below);
    }
    let (sign, digits) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    digits.strip_prefix("0x").map_or_else(|| decimal(text), |hex| sign * hexadecimal(hex))
}

fn decimal(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

/// A hex float without its `0x`, say `1.8p+1`; std reads none.
fn hexadecimal(text: &str) -> f64 {
    let (digits, exponent) = text.split_once('p').expect("an exponent");
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let mantissa = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hex digits");
    let exponent: i32 = exponent.parse().expect("a power of two");
    reference::real::scaled(mantissa as f64, exponent - 4 * fraction.len() as i32)
}

/// Three numbers.
pub(crate) fn three(value: &Value) -> [f64; 3] {
    let list = value.as_array().unwrap_or_else(|| panic!("{value} is no list"));
    [0, 1, 2].map(|n| number(&list[n]))
}
