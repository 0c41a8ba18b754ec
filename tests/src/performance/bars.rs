//! The bars: the required speeds, the measured ones, and the known reasons for bars that are not
//! reached.

use serde::Serialize;

use super::effects;
use super::pictures;
use super::rays::NAMES;
use super::renderers::Renderer;
use super::report::Report;
use super::scenes::STONES;
use super::search::{self, Library, SHOWN};
use super::series::exponent;
use super::small::{self, OURS, what};

/// A required speed, and the measured one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// The requirement, in words.
    pub requirement: String,
    /// The measured value with its unit.
    pub figure: String,
    /// True if the bar is reached.
    pub is_reached: bool,
    /// The known reason why the bar is not reached; empty if it is reached or no reason is known.
    pub reason: &'static str,
}

/// The reasons why bars are not reached. Each applies to bars that contain the text on the left,
/// and the first match counts. The reasons hold no numbers: a measurement would not update these
/// texts.
const WHY: [(&str, &str); 7] = [
    (
        "building the tree",
        "splits along three axes take most of the time, and the layout of the triangles the rest",
    ),
    ("packets of 16", "triangles are decided in f64, each with a bound of the error"),
    (
        "Embree",
        "each node waits for the one before it, and triangles are decided in f64 with a bound of \
         the error",
    ),
    ("LLVM", "its kernels are f32 and shade whole wavefronts at once"),
    (
        "glass",
        "rays from a surface are traced one by one, and triangles are decided in f64 with a bound \
         of the error",
    ),
    (
        "POV-Ray",
        "all but eye rays are traced one by one, and a bound of the error is computed for every \
         answer (accuracy.md)",
    ),
    ("160×120", "most of the time is tracing, not the rest of the process"),
];

/// Returns the bars of all sections that were measured.
pub fn bars(report: &Report) -> Vec<Bar> {
    let mut all = vec![];
    if let Some(rows) = &report.pictures {
        all.extend(rendering(rows));
        all.extend(reading(rows));
    }
    if let Some(rows) = &report.search {
        all.extend(searching(rows));
        all.extend(growing(rows));
    }
    all.extend(report.small.iter().flat_map(|rows| waiting(rows)));
    all.extend(report.effects.iter().flatten().map(uncalled));
    all
}

/// Returns the bar for a ratio that must be at least `least`.
fn at_least(requirement: String, least: f64, ratio: f64) -> Bar {
    bar(format!("{requirement}: ≥ {least} times"), format!("{ratio:.2} times"), ratio >= least)
}

fn bar(requirement: String, figure: String, is_reached: bool) -> Bar {
    let known =
        WHY.iter().find(|(word, _)| requirement.contains(word)).map_or("", |(_, reason)| *reason);
    Bar { requirement, figure, is_reached, reason: if is_reached { "" } else { known } }
}

fn rendering(rows: &[pictures::Row]) -> Vec<Bar> {
    let mut bars = vec![];
    for row in rows.iter().filter(|row| row.easier.is_none()) {
        let requirement = |what: &str| format!("{}: {what} as fast as {}", row.scene, row.renderer);
        let is = |renderer: Renderer| row.renderer == renderer.name();
        let least = if is(Renderer::Pov) { 8.0 } else { 1.0 };
        let counts = is(Renderer::Pov) || is(Renderer::Tachyon) || is(Renderer::MitsubaLlvm);
        bars.extend(
            row.times
                .filter(|_| counts)
                .map(|times| at_least(requirement("rendering"), least, times)),
        );
        bars.extend(
            row.whole_times
                .filter(|_| is(Renderer::Pov))
                .map(|times| at_least(requirement("whole process"), 3.0, times)),
        );
    }
    bars
}

/// Returns the bar for reading the largest mesh. `None` unless we and a peer were measured.
fn reading(rows: &[pictures::Row]) -> Option<Bar> {
    let read = |row: &pictures::Row| row.read_s.filter(|_| row.scene == "mesh_1m");
    let ours = rows.iter().filter(|row| row.renderer == Renderer::Ours.name()).find_map(read)?;
    let peers = rows.iter().filter(|row| row.renderer != Renderer::Ours.name()).filter_map(read);
    let fastest = peers.min_by(f64::total_cmp)?;
    Some(at_least(
        "reading the mesh of 1.3 million triangles, as fast as the fastest peer".to_owned(),
        1.0,
        fastest / ours,
    ))
}

fn searching(rows: &[search::Row]) -> Vec<Bar> {
    let mut bars = vec![];
    for mesh in SHOWN {
        let find = |library| search::find(rows, library, mesh);
        let (Some(ours), Some(robust), Some(plain)) =
            (find(Library::Ours), find(Library::EmbreeRobust), find(Library::Embree))
        else {
            continue;
        };
        let (Some(together), Some(packets)) =
            (find(Library::OursPackets), find(Library::EmbreePackets))
        else {
            continue;
        };
        for (k, least) in [1.0, 1.0, 0.8, 0.8].into_iter().enumerate() {
            let requirement =
                format!("{mesh}: {} rays as fast as Embree robust, one by one", NAMES[k]);
            bars.push(at_least(requirement, least, ours.mrays[k] / robust.mrays[k]));
        }
        let requirement = format!("{mesh}: primary rays as fast as Embree's packets of 16");
        bars.push(at_least(requirement, 1.0, together.mrays[0] / packets.mrays[0]));
        let slower = ours.build_s / plain.build_s;
        let requirement = format!("{mesh}: building the tree takes ≤ 1.5 times as long as Embree");
        bars.push(bar(requirement, format!("{slower:.2} times"), slower <= 1.5));
    }
    bars
}

/// Returns the quantities that grow, each with its exponent p of n^p. The last entry is the
/// exponent of n log n over the same sizes.
pub fn exponents(rows: &[search::Row]) -> Vec<(&'static str, f64)> {
    let ours: Vec<&search::Row> = rows.iter().filter(|row| row.library == Library::Ours).collect();
    let of = |y: &dyn Fn(&search::Row) -> f64| {
        exponent(&ours.iter().map(|row| (row.n_triangles as f64, y(row))).collect::<Vec<_>>())
    };
    let n_log_n = of(&|row| row.n_triangles as f64 * cases::maths::ln(row.n_triangles as f64));
    vec![
        ("building the tree", of(&|row| row.build_s)),
        ("a primary ray", of(&|row| 1.0 / row.mrays[0])),
        ("a shadow ray", of(&|row| 1.0 / row.mrays[1])),
        ("a diffuse ray", of(&|row| 1.0 / row.mrays[2])),
        ("a random ray", of(&|row| 1.0 / row.mrays[3])),
        ("n log n", n_log_n),
    ]
}

fn growing(rows: &[search::Row]) -> Vec<Bar> {
    let all = exponents(rows);
    let Some(((_, most), grown)) = all.split_last() else { return vec![] };
    let sizes = format!("{} to {} triangles", STONES[0].1, STONES[STONES.len() - 1].1);
    let bar = |(name, p): &(&str, f64)| {
        bar(
            format!("{name}, {sizes}: grows as n log n (n^{most:.2}) or better"),
            format!("n^{p:.2}"),
            p <= most,
        )
    };
    grown.iter().map(bar).collect()
}

fn waiting(rows: &[small::Row]) -> Vec<Bar> {
    let ours = |what: &str| small::find(rows, what, OURS);
    let mut bars = vec![];
    let mut below = |what: &str, unit: &str, value: Option<f64>, most: f64| {
        bars.extend(value.map(|value| {
            bar(format!("{what}: under {most} {unit}"), format!("{value:.1} {unit}"), value < most)
        }));
    };
    below(what::CASE, "ms of CPU", ours(what::CASE).map(|row| row.cpu_s * 1e3), 5.0);
    below(what::EXPECT, "s", ours(what::EXPECT).map(|row| row.wall_s), 60.0);
    below(what::VARY, "s", ours(what::VARY).map(|row| row.wall_s), 60.0);
    below(what::PAIR, "ms of CPU", ours(what::PAIR).map(|row| row.cpu_s * 1e3), 3.0);
    for what in [what::EQUAL, what::DIFFERENT] {
        for row in
            rows.iter().filter(|row| row.what == what && row.who != OURS && row.note.is_none())
        {
            let Some(own) = ours(what) else { continue };
            bars.push(at_least(
                format!("{what}, as fast as {}", row.who),
                1.5,
                row.wall_s / own.wall_s,
            ));
        }
    }
    bars
}

fn uncalled(row: &effects::UncalledRow) -> Bar {
    let effects = row.deleted.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(", ");
    let requirement = format!("{}: within 2 % of a kernel without {effects}", row.scene);
    bar(
        requirement,
        format!("{:+.1} %", (row.chosen_ratio - 1.0) * 100.0),
        row.chosen_ratio <= 1.02,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_met_from_its_own_value_on_and_says_why_only_if_not() {
        let requirement = || "82k: random rays as fast as Embree robust".to_owned();
        assert_eq!(
            (
                at_least(requirement(), 0.8, 0.8).is_reached,
                at_least(requirement(), 0.8, 0.8).reason
            ),
            (true, "")
        );
        let missed = at_least(requirement(), 0.8, 0.79);
        assert!(
            !missed.is_reached && missed.reason.contains("f64") && missed.figure == "0.79 times",
            "{missed:?}"
        );
        assert!(!at_least(requirement(), 0.8, f64::NAN).is_reached);
    }

    #[test]
    fn an_easier_picture_counts_for_no_bar() {
        let row = |easier| pictures::Row {
            scene: "glass".to_owned(),
            renderer: Renderer::Tachyon.name(),
            precision: "f64",
            render_s: 1.0,
            read_s: None,
            whole_s: None,
            rays: None,
            is_counted: false,
            easier,
            times: Some(2.0),
            whole_times: None,
        };
        assert_eq!(rendering(&[row(Some("no refraction"))]), []);
        assert_eq!(rendering(&[row(None)]).len(), 1);
    }
}
