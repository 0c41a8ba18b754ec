//! Tests of the families of hard questions in both precisions: no decision is wrong, and errors are
//! within the bound of each family.
//!
//! A million draws: `reference cost --functions --formulas robust --draws 1000000 --rounds 1`.

use reference::hard::families::Bound;
use reference::hard::oracle::right;
use reference::hard::question::Line;
use reference::hard::survey::{Comparison, compare};
use reference::hard::{FAMILIES, Family, Question, SurveyCounts, evaluate, survey};
use reference::numbers::real::Real;
use reference::rules::{
    Lecture, PlaneFormula, Quadratic, Robustness, Rules, Snell, Style, TriangleFormula,
};

const N_DRAWS: u64 = 100_000;
const SEED: u64 = 1;

/// Surveys a family and prints the tally as a line of a table. Returns what is wrong with it, if
/// anything.
fn wrong<T: Real>(
    family: &Family,
    precision: &str,
    [most_t, most_vector]: Bound,
) -> Option<String> {
    let tally = survey::<T, _>(family, Lecture, N_DRAWS, SEED);
    println!(
        "{:32} {precision}  hits {:6}  wrong {}  doubtful {}  t {:8.1e}  vector {:8.1e}  {:8.1} \
            ulp",
        family.name,
        tally.n_hits,
        tally.wrong(),
        tally.doubtful,
        tally.max_t,
        tally.max_vector,
        tally.ulps::<T>(),
    );
    let is_right = tally.wrong() == 0 && tally.max_t <= most_t && tally.max_vector <= most_vector;
    let is_complete = tally.n == N_DRAWS && (N_DRAWS / 10..=N_DRAWS).contains(&tally.n_hits);
    let of = |what, question| format!("{}, {precision}: {what}: {question:?}", family.name);
    match (is_right && is_complete, tally.first_wrong, tally.worst) {
        (true, ..) => None,
        (false, Some(first), _) => Some(of("wrong", Some(first))),
        (false, None, worst) => Some(of("an error beyond the bound, or too few hits", worst)),
    }
}

#[test]
fn no_family_is_decided_wrongly() {
    let of = |family: &Family| {
        [wrong::<f64>(family, "f64", family.double), wrong::<f32>(family, "f32", family.single)]
    };
    let wrong: Vec<String> = FAMILIES.iter().flat_map(of).flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Returns the tally of a family by the formulas of `style`, without repeating a decision in two
/// words.
fn plain<T: Real>(name: &str, style: Style) -> SurveyCounts {
    let family = FAMILIES
        .iter()
        .find(|family| family.name == name)
        .unwrap_or_else(|| panic!("no family `{name}`"));
    let rules = Rules { style: Style { robustness: Robustness::Plain, ..style }, ..Rules::LECTURE };
    survey::<T, _>(family, &rules, 20_000, SEED)
}

#[test]
fn textbook_formulas_decide_wrongly_where_they_are_known_to() {
    let style = Style::REFERENCE;
    let textbook = Style { quadratic: Quadratic::Textbook, plane: PlaneFormula::Textbook, ..style };
    let moller_trumbore = Style { triangle: TriangleFormula::MollerTrumbore, ..style };
    let edges = Style { triangle: TriangleFormula::Edges, ..style };
    let snell = Style { snell: Snell::Textbook, ..style };
    for (name, tally) in [
        ("far spheres", plain::<f64>("sphere, far", textbook)),
        ("spheres of mixed coordinates", plain::<f64>("sphere, mixed coordinates", textbook)),
        ("grounds", plain::<f32>("sphere, as a ground", textbook)),
        ("planes near parallel", plain::<f32>("plane, near parallel", textbook)),
        ("edges by Möller and Trumbore", plain::<f64>("triangle, at an edge", moller_trumbore)),
        ("corners by Möller and Trumbore", plain::<f32>("triangle, at a corner", moller_trumbore)),
        ("edges by cross products", plain::<f64>("triangle, at an edge", edges)),
        ("the critical angle", plain::<f32>("refract, near critical", snell)),
        ("edges of boxes", plain::<f64>("box, at an edge", style)),
        ("rims", plain::<f64>("cylinder, at a rim", style)),
        ("lines along a cone", plain::<f64>("cone, on its side", style)),
        ("moved silhouettes", plain::<f64>("transformed sphere, silhouette", style)),
        ("moved planes", plain::<f64>("transformed plane, near parallel", style)),
        ("moved squares", plain::<f64>("transformed square, at its border", style)),
        ("moved boxes", plain::<f64>("transformed box, at an edge", style)),
        ("moved cylinders", plain::<f64>("transformed cylinder, touching", style)),
        ("moved tips", plain::<f64>("transformed cone, at its tip", style)),
    ] {
        assert!(tally.wrong() > 0, "{name} mislead no formula");
        assert!(tally.first_wrong.is_some());
    }
    let generic = plain::<f64>("sphere, generic", textbook);
    assert_eq!(
        (generic.wrong(), generic.doubtful),
        (0, 0),
        "the textbook formula is good enough for generic questions"
    );
}

#[test]
fn a_tally_is_the_same_each_time_and_other_seeds_draw_other_questions() {
    let of = |seed| survey::<f64, _>(&FAMILIES[0], Lecture, 2_500, seed);
    assert_eq!(of(1), of(1));
    assert_eq!(of(1).n, 2_500);
    assert_ne!(of(1).max_t, of(2).max_t);
}

/// A million draws found this question. The product of area, depth and 1/d_z leaves the range of
/// single precision, although each factor and t are within it.
#[test]
fn a_huge_triangle_is_hit_by_a_short_direction() {
    let line = Line {
        origin: [-122_906_255_360.0, -1_810_572_115_968.0, 106_111_336_448.0],
        direction: [
            5.165_996_117_284_521_5e-5,
            1.676_740_503_171_458_8e-4,
            -1.023_024_833_557_428_8e-5,
        ],
    };
    let corners = [
        [359_960_838_144.0, 175_454_715_904.0, -30_798_911_488.0],
        [520_371_437_568.0, -142_615_068_672.0, 140_272_189_440.0],
        [454_219_431_936.0, -199_003_324_416.0, -62_933_307_392.0],
    ];
    let question = Question::Triangle { line, corners };
    let comparison = compare::<f32>(&right(&question), &evaluate::<f32, _>(Lecture, &question));
    assert!(matches!(comparison, Comparison::Same { t, .. } if t < 1e-6), "{comparison:?}");
}
