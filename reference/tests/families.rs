//! The families of hard questions: no wrong decision, and errors within each family's bound, in both precisions.
//!
//! The same at a million draws: `reference cost --functions --draws 1000000`.

use reference::hard::families::Bound;
use reference::hard::{FAMILIES, Family, Tally, survey};
use reference::real::Real;
use reference::rules::{Lecture, PlaneFormula, Quadratic, Robustness, Rules, Snell, Style, TriangleFormula};

const N_DRAWS: u64 = 100_000;
const SEED: u64 = 1;

/// What is wrong with a tally, if anything; prints it as a line of a table.
fn wrong<T: Real>(family: &Family, precision: &str, [most_t, most_vector]: Bound) -> Option<String> {
    let tally = survey::<T, _>(family, Lecture, N_DRAWS, SEED);
    println!(
        "{:32} {precision}  hits {:6}  wrong {}  doubtful {}  t {:8.1e}  vector {:8.1e}  {:8.1} ulp",
        family.name,
        tally.n_hits,
        tally.wrong(),
        tally.doubtful,
        tally.max_t,
        tally.max_vector,
        tally.ulps::<T>(),
    );
    let is_right = tally.wrong() == 0 && tally.max_t <= most_t && tally.max_vector <= most_vector;
    let is_asked = tally.n == N_DRAWS && (N_DRAWS / 10..=N_DRAWS).contains(&tally.n_hits);
    let of = |what, question| format!("{}, {precision}: {what}: {question:?}", family.name);
    match (is_right && is_asked, tally.first_wrong, tally.worst) {
        (true, ..) => None,
        (false, Some(first), _) => Some(of("wrong", Some(first))),
        (false, None, worst) => Some(of("an error beyond the bound, or too few hits", worst)),
    }
}

#[test]
fn no_family_is_decided_wrongly() {
    let of = |family: &Family| {
        let single = family.single.and_then(|bound| wrong::<f32>(family, "f32", bound));
        [wrong::<f64>(family, "f64", family.double), single]
    };
    let wrong: Vec<String> = FAMILIES.iter().flat_map(of).flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The tally of a family by the formulas of `style` without a second step.
fn plain<T: Real>(name: &str, style: Style) -> Tally {
    let family = FAMILIES.iter().find(|family| family.name == name).unwrap_or_else(|| panic!("no family `{name}`"));
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
    ] {
        assert!(tally.wrong() > 0, "{name} are no trap");
        assert!(tally.first_wrong.is_some());
    }
    let generic = plain::<f64>("sphere, generic", textbook);
    assert_eq!((generic.wrong(), generic.doubtful), (0, 0), "the textbook does where nothing is hard");
}

#[test]
fn a_tally_is_the_same_each_time_and_other_seeds_ask_other_questions() {
    let of = |seed| survey::<f64, _>(&FAMILIES[0], Lecture, 2_500, seed);
    assert_eq!(of(1), of(1));
    assert_eq!(of(1).n, 2_500);
    assert_ne!(of(1).max_t, of(2).max_t);
}
