//! The page `docs/accuracy.md` on the cost of accuracy, rendered from measurements.

use std::collections::BTreeMap;

use cases::Scene;
use pages::page::{Serde, Value, context, text};
use serde::Serialize;

use super::bench::Bench;
use super::error::Error;
use super::functions_report::FunctionsReport;
use super::report::{Choice, Report, SettingRow};
use super::scaled::scaled;
use super::setting::{Formula, Setting};
use crate::expect::variations::Precision;
use crate::rules::{Epsilon, Rules};

/// The scenes of the page. They show facing mirrors, glass, transformed spheres and smooth meshes.
pub const SCENES: [&str; 4] = [
    "03_reflection/hall_of_mirrors",
    "04_refraction/crystal_ball",
    "05_transforms/pebbles",
    "06_smooth_normals/soap",
];
/// The scene that is rendered in many sizes.
pub const SIZED: &str = SCENES[1];
/// The exponents of the sizes, which are powers of ten.
const SIZES: [i32; 9] = [-8, -6, -4, -2, 0, 2, 4, 6, 8];
/// The values of RAY_EPSILON in the table.
const EPSILONS: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

/// The wrong pixels of a scene in every size, for one way in which new rays leave surfaces.
#[derive(Clone, Debug, Serialize)]
pub struct StartRow {
    /// The way in words.
    pub name: String,
    /// The share of the pixels with a wrong 8-bit colour, for each size.
    pub changed: Vec<f64>,
}

impl StartRow {
    /// Returns the sentence on the sizes at which no pixel is wrong.
    fn safe_sizes(&self) -> String {
        let all = SIZES.iter().zip(&self.changed);
        let safe: Vec<String> = all
            .filter(|(_, share)| **share == 0.0)
            .map(|(power, _)| format!("10^{power}"))
            .collect();
        let name = &self.name;
        match safe.len() {
            0 => format!("{name}: no size is free of wrong pixels."),
            n if n == SIZES.len() => format!("{name}: no pixel is wrong at any size."),
            _ => format!("{name}: no pixel is wrong at {}.", safe.join(", ")),
        }
    }
}

/// Returns a row for the reference's own start and for each RAY_EPSILON, in both precisions. The
/// correct picture is the reference's f64 picture of the scene in its own size.
pub fn starts(scene: &Scene, rules: &Rules) -> Vec<StartRow> {
    let own = Setting::of(scene);
    let (truth, _) = Bench::new(scene, rules).render(&own);
    let changed = |rules: &Rules, setting: Setting| {
        let at = |power: &i32| {
            let scene = scaled(scene, cases::maths::pow(10.0, f64::from(*power)));
            let (image, _) = Bench::new(&scene, rules).render(&setting);
            Error::of(&truth, &image, rules.quantiser).changed
        };
        SIZES.iter().map(at).collect()
    };
    let of = |precision: Precision| {
        let setting = Setting { precision, ..own };
        let bound = StartRow {
            name: format!("{}, by the bound on the hit's error", precision.says()),
            changed: changed(rules, setting),
        };
        let fixed = EPSILONS.iter().map(move |epsilon| StartRow {
            name: format!("{}, t > {epsilon:e}", precision.says()),
            changed: changed(
                &Rules { epsilon: Epsilon::Fixed(*epsilon), ..*rules },
                Setting { formula: Formula::Stable, ..setting },
            ),
        });
        std::iter::once(bound).chain(fixed).collect::<Vec<_>>()
    };
    [Precision::F64, Precision::F32].into_iter().flat_map(of).collect()
}

/// The measurements that the page shows.
#[derive(Clone, Debug, Serialize)]
pub struct Document {
    /// The digest of the code and cases that were measured, if the sources were at hand.
    pub measured_on: Option<String>,
    /// The single functions.
    pub functions: FunctionsReport,
    /// The whole pictures, of [`SCENES`].
    pub scenes: Vec<Report>,
    /// The starts of new rays, in many sizes.
    pub starts: Vec<StartRow>,
}

/// Returns the file name of the picture of the scene `scene`, which lies beside the page with the
/// stem `stem`. Characters that are not ASCII letters or digits become `_`.
pub fn picture_name(stem: &str, scene: &str) -> String {
    let tame: String =
        scene.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    format!("{stem}-{tame}.svg")
}

/// Returns the page in Markdown. `stem` is the stem of its file.
pub fn markdown(document: &Document, stem: &str) -> String {
    let pictures: Vec<String> =
        document.scenes.iter().map(|report| picture_name(stem, &report.scene)).collect();
    let page = Value::from(Serde(document));
    let titles: BTreeMap<&str, &str> =
        Choice::ALL.into_iter().map(|about| (about.word(), about.title())).collect();
    let safe_sizes: Vec<String> = document.starts.iter().map(StartRow::safe_sizes).collect();
    let sizes = SIZES.to_vec();
    let exact = Setting::by_exact_numbers;
    let is_bounded = |row: &&SettingRow| {
        let has_bound = row.left_out_at_most.is_some_and(|most| most < 1.0);
        has_bound && row.depth.is_some() && row.setting == exact(&row.setting)
    };
    let scene = document.scenes.first();
    let bounded: Vec<&SettingRow> =
        scene.map_or_else(Vec::new, |scene| scene.rows.iter().filter(is_bounded).collect());
    let bounded = Value::from(Serde(&bounded));
    let values = context! { page, pictures, titles, safe_sizes, sizes, sized => SIZED, bounded };
    text(include_str!("accuracy.md.in"), &values)
}
