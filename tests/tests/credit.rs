//! Tests of the points for what is right in spite of a known mistake: two bugs never earn more than
//! one of them, and nobody gains by a picture that shows nothing of its case.

use std::path::Path;

use cases::answer::ImageAnswer;
use cases::film::{self, Image};
use cases::glam::DVec3;
use cases::stage::Case;
use cases::{Effects, effects};
use grader::grade::{Bench, Options, images};
use grader::record::{CheckRecord, Record};
use reference::expect::students_picture;
use reference::rules::Rules;
use tests::diagnosis::{combinations, in_bytes, parts};
use tests::public_stages;

fn bench() -> Bench {
    Bench::open(&public_stages()).unwrap_or_else(|why| panic!("{why}"))
}

/// Returns the cases with the effects that their stages are the first to allow, in order.
fn cases(bench: &Bench) -> Vec<(&Case, &ImageAnswer, Effects)> {
    let mut before = Effects::NONE;
    let mut all = vec![];
    for one in &bench.exam.stages {
        let cases = one.stage.cases.iter();
        all.extend(cases.map(|case| (case, &one.images[&case.id], before)));
        before = before.union(one.stage.allows);
    }
    all
}

/// Judges a program with these pictures.
fn judged(bench: &Bench, picture: &dyn Fn(usize) -> Image) -> Record {
    let folder = tempfile::tempdir().unwrap();
    for (at, (case, ..)) in cases(bench).into_iter().enumerate() {
        let path = folder.path().join(format!("{}.png", case.id));
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).unwrap();
        let bytes = film::encode(film::Kind::Png, &picture(at)).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    images(bench, folder.path(), &Options::new(folder.path())).unwrap().record
}

fn checks(record: &Record) -> impl Iterator<Item = &CheckRecord> {
    record.stages.iter().flat_map(|stage| &stage.checks)
}

/// Returns the record of a program that follows these rules.
fn by_rules(bench: &Bench, rules: &Rules) -> Record {
    let cases = cases(bench);
    judged(bench, &|at| in_bytes(&students_picture(&cases[at].0.scene, rules)))
}

/// One pair by default; `PAIRS=N` tests N.
#[test]
fn two_mistakes_never_earn_more_than_one_of_them() {
    let n = std::env::var("PAIRS").map_or(Ok(1), |n| n.parse()).expect("PAIRS is a number");
    let bench = bench();
    for pair in combinations(31, n, 2) {
        let both = by_rules(&bench, &parts(&pair)).score.earned;
        for one in &pair {
            let alone = by_rules(&bench, &parts(&[*one])).score.earned;
            let names: Vec<&str> = pair.iter().map(|one| one.id).collect();
            assert!(both <= alone, "{names:?} earn {both}, {} alone {alone}", one.id);
        }
    }
}

#[test]
fn a_mistake_of_every_picture_is_paid_for_where_its_rule_is_taught() {
    let bench = bench();
    let no_ambient = combinations(1, 400, 1).concat();
    let no_ambient = no_ambient.into_iter().find(|one| one.id == "no_ambient").expect("a mistake");
    let record = by_rules(&bench, &parts(&[no_ambient]));
    for check in checks(&record) {
        let is_elsewhere = !check.id.starts_with("01_") && !check.rules.contains(&no_ambient.rule);
        let share = check.earned as f64 / check.possible as f64;
        assert_eq!(check.credit.is_some(), is_elsewhere && share < 1.0, "{}", check.id);
        assert!(check.credit.is_none() || share <= 0.8, "{}: {share}", check.id);
    }
    let credit: u64 = checks(&record).filter_map(|check| Some(check.credit.as_ref()?.points)).sum();
    assert!(credit > 40_000, "{credit}");
}

#[test]
fn pictures_that_show_nothing_of_their_case_gain_nothing() {
    let bench = bench();
    let cases = cases(&bench);
    let next = |at: usize| {
        let size = |at: usize| (cases[at].1.expected.width(), cases[at].1.expected.height());
        let mut others = (at + 1..cases.len()).chain(0..at);
        others.find(|other| size(*other) == size(at)).unwrap_or(at)
    };
    let uniform = |at: usize| {
        let size = cases[at].0.scene.render;
        Image::from_fn(size.width, size.height, |_, _| DVec3::splat(0.4))
    };
    let stolen = |at: usize| in_bytes(&cases[next(at)].1.expected);
    for (name, record) in
        [("uniform", judged(&bench, &uniform)), ("stolen", judged(&bench, &stolen))]
    {
        let credited: Vec<&str> = checks(&record)
            .filter(|check| check.credit.is_some())
            .map(|check| check.id.as_str())
            .collect();
        assert!(credited.is_empty(), "{name}: {credited:?}");
    }
}

#[test]
fn the_pictures_of_an_earlier_stage_gain_nothing() {
    let bench = bench();
    let cases = cases(&bench);
    let with = |at: usize, effects: Effects| {
        let mut scene = cases[at].0.scene.clone();
        let effects = scene.effects.intersection(effects);
        effects::simulate_only(&mut scene, effects);
        in_bytes(&students_picture(&scene, &Rules::LECTURE.plain()))
    };
    let before = judged(&bench, &|at| with(at, cases[at].2));
    let credited = |record: &Record, first: &str| -> Vec<String> {
        let later = checks(record).filter(|check| check.id.as_str() >= first);
        later.filter(|check| check.credit.is_some()).map(|check| check.id.clone()).collect()
    };
    assert_eq!(credited(&before, "02"), [""; 0], "pictures of the stage before");
    let mut effects = Effects::NONE;
    for pair in bench.exam.stages.windows(2) {
        effects = effects.union(pair[0].stage.allows);
        let record = judged(&bench, &|at| with(at, effects));
        let next = &pair[1].stage.id;
        assert_eq!(credited(&record, next), [""; 0], "pictures of a program before {next}");
    }
}
