//! Tests of hidden sets: every public case can be varied within its bounds, the solution earns
//! everything, and the public pictures earn nothing.

use std::path::Path;
use std::sync::LazyLock;

use cases::answer::ImageAnswer;
use cases::course::course_of;
use cases::glam::DVec3;
use cases::stage::{self, Bounds, Case, Stage};
use grader::exam::Exam;
use grader::grade::{self, Bench, Options, grade};
use grader::judge;
use grader::record::{CheckRecord, Verdict};
use pages::say;
use reference::expect::{self, Expected, Progress, Set};
use reference::vary::folder::{self, Draft};
use reference::vary::{Care, Original, Varied};
use tempfile::TempDir;
use tests::{public_stages, workspace};
use toml::Value;

/// The seeds. Each case is graded under one of them.
const SEEDS: [u64; 3] = [1, 2026, u64::MAX];
/// The thousandths of its points that a picture may earn on another case by chance.
const NEXT_TO_NOTHING: u32 = 50;

static PUBLIC: LazyLock<Set> = LazyLock::new(|| {
    let course = course_of(&public_stages()).unwrap_or_else(|problems| panic!("{problems}"));
    Set::new(stages(&public_stages()), &course)
});

fn stages(folder: &Path) -> Vec<Stage> {
    stage::load_all(folder, &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

static ORIGINALS: LazyLock<Vec<Original>> = LazyLock::new(|| {
    let originals = folder::originals(&public_stages(), &PUBLIC, || {})
        .unwrap_or_else(|wrong| panic!("{}", say::paragraphs(&wrong)));
    assert_eq!(originals.constant, Vec::<String>::new(), "a public case has no `[vary]`");
    originals.varying
});

/// Returns the case under `seed`. Only two correct programs check that it is fair.
fn varied(original: &Original, seed: u64) -> Varied {
    original
        .vary(&PUBLIC, seed, Care::Quick)
        .unwrap_or_else(|wrong| panic!("{}", say::chain(&wrong)))
}

fn public_cases() -> impl Iterator<Item = &'static Case> {
    PUBLIC.stages.iter().flat_map(|stage| &stage.cases)
}

fn case(id: &str) -> &'static Case {
    public_cases().find(|case| case.id == id).unwrap_or_else(|| panic!("there is no case {id}"))
}

fn bounds(case: &Case) -> &Bounds {
    case.bounds.as_ref().unwrap_or_else(|| panic!("{} has no `[vary]`", case.id))
}

/// Returns a folder with a third of the cases under a seed, with answers. Every case is in the
/// folder of one seed.
fn hidden(n: usize) -> TempDir {
    let third = ORIGINALS.iter().enumerate().filter(|(at, _)| at % SEEDS.len() == n);
    let third: Vec<Varied> = third.map(|(_, original)| varied(original, SEEDS[n])).collect();
    let place = tempfile::tempdir().expect("a temporary folder");
    let draft = Draft::write(&public_stages(), &PUBLIC, &third, &[], place.path())
        .unwrap_or_else(|why| panic!("{why}"));
    let set = Set::new(stages(&draft.stages()), &PUBLIC.course);
    let answers = expect::of_set(&draft.stages(), &set, |_| true, &Silent)
        .unwrap_or_else(|why| panic!("{why}"));
    cases::files::write_all(answers.files().map(Expected::as_output))
        .unwrap_or_else(|why| panic!("{why}"));
    draft.publish(place.path()).unwrap_or_else(|why| panic!("{why}"));
    place
}

/// A progress receiver that ignores reports and never stops the work.
struct Silent;

impl Progress for Silent {
    fn step(&self) {}

    fn is_stopped(&self) -> bool {
        false
    }
}

#[test]
fn every_number_stays_within_its_bound_and_all_else_stays() {
    for (case, original) in public_cases().zip(ORIGINALS.iter()) {
        let path = public_stages().join(format!("{}.toml", case.id));
        let before: Value = toml_of(&std::fs::read_to_string(path).expect("a case"));
        let texts = [1, 2].map(|seed| varied(original, seed).text);
        let mut wrong = Vec::new();
        for after in texts.iter().map(|text| toml_of(text)) {
            for key in KEYS {
                compare(&before[key], &after[key], key, bounds(case), &mut wrong);
            }
            assert_eq!(after.as_table().expect("a table").len(), KEYS.len(), "{}", case.id);
        }
        assert!(wrong.is_empty(), "{}:\n{}", case.id, wrong.join("\n"));
        let [one, other] = texts.map(|text| toml_of(&text));
        assert_ne!(one, other, "{}: two seeds give the same case", case.id);
        assert_eq!(
            toml_of(&varied(original, 1).text),
            one,
            "{}: one seed gives two cases",
            case.id
        );
    }
}

/// The keys of a varied case: all except its bounds.
const KEYS: [&str; 6] = ["title", "about", "rules", "points", "render", "scene"];

fn toml_of(text: &str) -> Value {
    Value::Table(text.parse().unwrap_or_else(|why| panic!("{why}")))
}

/// Adds to `wrong` every number of `moved` that is farther from that of `original` than its key
/// allows, and every other difference.
fn compare(original: &Value, moved: &Value, path: &str, bounds: &Bounds, wrong: &mut Vec<String>) {
    match (original, moved) {
        (Value::Table(one), Value::Table(other)) if one.keys().eq(other.keys()) => {
            for (key, value) in one {
                compare(value, &other[key], &format!("{path}.{key}"), bounds, wrong);
            }
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            for (at, (value, moved)) in one.iter().zip(other).enumerate() {
                compare(value, moved, &format!("{path}.{at}"), bounds, wrong);
            }
        }
        _ => match (number(original), number(moved)) {
            (Some(was), Some(is)) => {
                let most = bound(path, was, bounds);
                if (is - was).abs() > most * (1.0 + 1e-12) {
                    wrong.push(format!("{path}: {was} became {is}, at most {most} away"));
                }
            }
            _ if original == moved => {}
            _ => wrong.push(format!("{path}: {original} became {moved}")),
        },
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}

/// Returns the distance by which the number at `path` may move, from the key that it belongs to.
fn bound(path: &str, was: f64, bounds: &Bounds) -> f64 {
    let parts: Vec<&str> = path.split('.').filter(|part| part.parse::<usize>().is_err()).collect();
    let axis: usize = path.rsplit('.').next().and_then(|last| last.parse().ok()).unwrap_or(0);
    let each = |bound: DVec3| bound.to_array().get(axis).copied().unwrap_or(0.0);
    match parts.last().copied().unwrap_or_default() {
        "eye" => each(bounds.eye),
        "look_at" => each(bounds.look_at),
        "fov_y_deg" => bounds.fov_y_deg,
        "position" => each(bounds.lights),
        "direction" => bounds.directions, // no public light has a component longer than 1
        "center" | "min" | "max" | "vertices" => each(bounds.objects),
        "k" => 2.0 * bounds.objects.max_element(), // the longest normal has length 1.7
        "radius" | "bottom_radius" | "top_radius" => bounds.radii * was,
        "translate" => each(bounds.translate),
        "angle_deg" => bounds.angle_deg,
        "scale" => bounds.scale * was.abs(),
        "xy" | "xz" | "yx" | "yz" | "zx" | "zy" => bounds.scale * was.abs(),
        "colour" | "ambient" | "background" | "ke" | "ka" | "kd" | "ks" | "kt" | "kr" => {
            bounds.colours.min(was / 2.0)
        }
        "index" => bounds.indices,
        _ => 0.0,
    }
}

#[test]
fn on_hidden_sets_the_solution_earns_everything_and_public_pictures_nothing() {
    let mut bench =
        Bench::open(&public_stages()).unwrap_or_else(|why| panic!("{}", say::chain(&why)));
    for (n, seed) in SEEDS.iter().enumerate() {
        let place = hidden(n);
        bench.exam = Exam::load(place.path()).unwrap_or_else(|why| panic!("{why}"));
        let lost = lost_by_the_solution(&bench);
        assert!(lost.is_empty(), "seed {seed}:\n{}", lost.join("\n"));
        for (id, answer) in bench.exam.stages.iter().flat_map(|questions| &questions.images) {
            check_answer(id, answer);
        }
    }
}

fn lost_by_the_solution(bench: &Bench) -> Vec<String> {
    let options = Options::new(workspace().join("tests/solution"));
    let graded = grade(bench, &options, &grade::Silent).unwrap_or_else(|why| panic!("{why}"));
    let checks = graded.record.stages.iter().flat_map(|stage| &stage.checks);
    let said = |check: &CheckRecord| check.finding.as_ref().map(|finding| finding.message.clone());
    let lost = checks.filter(|check| check.earned != check.possible);
    lost.map(|check| format!("{}: {:?}", check.id, said(check))).collect()
}

/// Checks that correct tracers agree on a hidden case. The public picture of the case may earn only
/// what two pictures have in common by chance.
fn check_answer(id: &str, answer: &ImageAnswer) {
    let contested = answer.contested_share();
    assert!(contested < 0.03, "{id}: {:.1} % of the pixels are contested", 100.0 * contested);
    let judged = judge::picture(&PUBLIC.picture(case(id)), answer);
    assert!(
        judged.verdict != Verdict::Pass && judged.share <= NEXT_TO_NOTHING,
        "{id}: the public picture earns {} ‰",
        judged.share
    );
}
