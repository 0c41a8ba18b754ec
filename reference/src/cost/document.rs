//! The page `docs/accuracy.md` on the cost of accuracy, rendered from measurements.

use std::collections::BTreeMap;

use pages::page::{Serde, Value, context, text};
use serde::Serialize;

use super::functions_report::FunctionsReport;
use super::report::{Choice, Report, SettingRow};
use super::setting::Setting;
use super::starts::{SIZES, StartRow};
use super::threads::{self, ThreadRow};

/// The scenes of the page. They show facing mirrors, glass, transformed spheres and smooth meshes.
pub const SCENES: [&str; 4] = [
    "03_reflection/hall_of_mirrors",
    "04_refraction/crystal_ball",
    "05_transforms/pebbles",
    "06_smooth_normals/soap",
];
/// The scene that is rendered in many sizes.
pub const SIZED: &str = SCENES[1];
/// The values of RAY_EPSILON in the table.
pub const EPSILONS: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

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
    /// The time on several threads; a single row where there is one core.
    pub threads: Vec<ThreadRow>,
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
    let on_threads = threads::sentence(&document.threads);
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
    let values =
        context! { page, pictures, titles, safe_sizes, on_threads, sizes, sized => SIZED, bounded };
    text(include_str!("accuracy.md.in"), &values)
}
