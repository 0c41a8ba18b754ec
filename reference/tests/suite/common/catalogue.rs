//! Reads the catalogue of hard cases, `data/hard-cases.json`.

use reference::hard::Question;
use reference::hard::exact::Exact;
use reference::hard::question::{Form, Line};
use serde_json::Value;

/// A case that is one call of a function of a shape or of optics.
pub(crate) struct Hard {
    pub(crate) id: String,
    pub(crate) question: Question,
    /// Whether the answer is a hit: the ray hits, is transmitted, or the matrix is invertible.
    pub(crate) is_hit: bool,
    /// Whether the answer is a hit for inputs that are rounded to single precision.
    pub(crate) is_hit_in_single: bool,
    pub(crate) t: Option<f64>,
    pub(crate) vector: Option<[f64; 3]>,
    pub(crate) weights: Option<[f64; 3]>,
    /// The relative condition number. `None` if only the decision counts.
    pub(crate) kappa: Option<f64>,
    /// The id of the case on the other side of a shared edge.
    pub(crate) pair: Option<String>,
}

/// Returns all cases of the file.
pub(crate) fn all() -> Vec<Value> {
    let text = include_str!("../../data/hard-cases.json");
    let file: Value = serde_json::from_str(text).expect("the catalogue is JSON");
    file["cases"].as_array().expect("a list of cases").clone()
}

/// Returns the cases of one function.
pub(crate) fn of(function: &str) -> Vec<Value> {
    all().into_iter().filter(|case| case["function"] == function).collect()
}

/// Returns the cases that are one call of one function.
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
    let function = case["function"].as_str().expect("a function");
    match function.strip_prefix("transformed_") {
        Some("sphere") => Some(transformed(case, Form::SPHERE, 2.0)),
        Some(of) => Some(transformed(case, Form::of(untransformed(case, of)?).1, 1.0)),
        None => untransformed(case, function),
    }
}

/// Returns the question about a shape that the matrix of the case transforms, times `scale`: the
/// unit sphere of the catalogue has twice the radius of rule 14's.
fn transformed(case: &Value, form: Form, scale: f64) -> Question {
    let given = |name: &str| &case["inputs"][format!("{name}_dec")];
    let m: Vec<f64> =
        given("M_row_major").as_array().expect("a matrix").iter().map(number).collect();
    let rows = [[m[0], m[1], m[2]], [m[3], m[4], m[5]], [m[6], m[7], m[8]]];
    Question::Transformed {
        line: Line { origin: three(given("O")), direction: three(given("D")) },
        form,
        rows: rows.map(|row| row.map(|x| scale * x)),
        translation: three(given("translate")),
    }
}

/// Returns the call of `function`, with the inputs of the case.
fn untransformed(case: &Value, function: &str) -> Option<Question> {
    let given = |name: &str| &case["inputs"][format!("{name}_dec")];
    let line = || Line { origin: three(given("O")), direction: three(given("D")) };
    let rows = || {
        let m: Vec<f64> =
            given("M_row_major").as_array().expect("a matrix").iter().map(number).collect();
        [[m[0], m[1], m[2]], [m[3], m[4], m[5]], [m[6], m[7], m[8]]]
    };
    let round = |radii| Question::Round { line: line(), radii, ends: [0.0, 1.0], is_capped: false };
    Some(match function {
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
        "square" => Question::Square { line: line() },
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
        _ => return None,
    })
}

/// Returns P − Q, and checks that it is exact. The catalogue gives planes by a point, and a
/// question by k = N·Q, which would be rounded.
fn moved(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|n| {
        let off = p[n] - q[n];
        assert_eq!(&Exact::of(p[n]) - &Exact::of(q[n]), Exact::of(off), "{p:?} − {q:?} is rounded");
        off
    })
}

/// Returns the id of a case.
pub(crate) fn id(case: &Value) -> String {
    case["id"].as_str().expect("an id").to_owned()
}

/// Parses a number: a decimal, `a/b`, or a hex float.
pub(crate) fn number(value: &Value) -> f64 {
    let text = value.as_str().unwrap_or_else(|| panic!("{value} is not a text with a number"));
    if let Some((above, below)) = text.split_once('/') {
        return decimal(above) / decimal(below);
    }
    let (sign, digits) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    digits.strip_prefix("0x").map_or_else(|| decimal(text), |hex| sign * hexadecimal(hex))
}

fn decimal(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is not a number"))
}

/// Parses a hex float without its `0x`, such as `1.8p+1`. The standard library has no parser for
/// these.
fn hexadecimal(text: &str) -> f64 {
    let (digits, exponent) = text.split_once('p').expect("an exponent");
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let mantissa = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hex digits");
    let exponent: i32 = exponent.parse().expect("a power of two");
    reference::numbers::real::scaled(mantissa as f64, exponent - 4 * fraction.len() as i32)
}

/// Parses a list of three numbers.
pub(crate) fn three(value: &Value) -> [f64; 3] {
    let list = value.as_array().unwrap_or_else(|| panic!("{value} is not a list"));
    [0, 1, 2].map(|n| number(&list[n]))
}
