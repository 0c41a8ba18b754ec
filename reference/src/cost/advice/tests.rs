//! Tests of `advice.rs` and `answers.rs`.

use cases::Effects;

use super::*;
use crate::cost::error::Error;
use crate::cost::report::{Machine, SettingRow};
use crate::cost::setting::{Formula, Setting};
use crate::cost::times::Times;
use crate::watch::Counts;

const OWN: Setting = Setting {
    precision: Precision::F64,
    formula: Formula::Robust,
    samples: 1,
    adaptive: false,
    max_depth: 2,
    threshold: 0.0,
    light_cutoff: 0.0,
    alike: false,
    trees: true,
    effects: Effects::NONE,
};

/// A setting that takes `ms` ± 1 ms, with the share `changed` of changed pixels, of which the worst
/// is off by 100 times as many levels, and with the RMS error `rms`.
struct Row(Setting, f64, f64, f64);

fn question(about: Choice, rows: &[Row]) -> Question {
    let own_ms = rows.iter().find(|row| row.0 == OWN).map_or(f64::NAN, |row| row.1);
    let row = |(n, Row(setting, ms, changed, rms)): (usize, &Row)| QuestionRow {
        name: about.name(setting),
        setting: *setting,
        row: n,
        time_ms: Times { median: *ms, least: ms - 1.0, greatest: ms + 1.0 },
        of_own: ms / own_ms,
        error: Error {
            changed: *changed,
            max_levels: 100.0 * changed,
            rms_levels: *rms,
            ..Error::default()
        },
        changed_from_own: *changed,
        is_on_front: true,
        is_own: *setting == OWN,
        is_pick: false,
        picture: None,
    };
    let mut rows: Vec<QuestionRow> = rows.iter().enumerate().map(row).collect();
    rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    Question { about, against: String::new(), answer: String::new(), facts: Vec::new(), rows }
}

/// Returns the report with advice. What the scene leaves out darkens a pixel by at most `bound`.
fn advised(questions: Vec<Question>, rounds: usize, varies_depth: bool, bound: f64) -> Report {
    let machine = Machine { processor: String::new(), threads: 1, clock: "", is_optimised: true };
    let own = SettingRow {
        name: String::new(),
        setting: OWN,
        time_ms: Times::default(),
        rays: Counts { reflected: 1, ..Counts::default() },
        bytes: 0,
        left_out_at_most: Some(bound),
        rounding: None,
        depth: None,
        sampling: None,
    };
    let mut report = Report {
        schema: 2,
        scene: String::new(),
        width: 1,
        height: 1,
        machine,
        rounds,
        own: OWN,
        is_cut_short: false,
        headline: String::new(),
        questions,
        rows: vec![own],
        effects: Vec::new(),
        facts: Vec::new(),
    };
    advise(&mut report, varies_depth);
    report
}

fn said(question: Question, varies_depth: bool) -> Report {
    advised(vec![question], 2, varies_depth, 10.0)
}

fn numbers(precision: Precision, formula: Formula) -> Setting {
    Setting { precision, formula, ..OWN }
}

fn depth(max_depth: u32) -> Setting {
    Setting { max_depth, ..OWN }
}

fn samples(samples: u32) -> Setting {
    Setting { samples, ..OWN }
}

const F32: Precision = Precision::F32;
const F64: Precision = Precision::F64;

#[test]
fn a_faster_formula_with_the_same_picture_is_picked_with_its_risk() {
    let report = said(
        question(
            Choice::Rounding,
            &[
                Row(OWN, 40.0, 0.0, 0.0),
                Row(numbers(F64, Formula::Stable), 20.0, 0.0, 0.0),
                Row(numbers(F64, Formula::Plain), 19.0, 0.0, 0.0),
                Row(numbers(F32, Formula::Plain), 10.0, 0.25, 3.0),
            ],
        ),
        false,
    );
    let answer = &report.questions[0].answer;
    assert!(
        answer.starts_with("Pick f64 stable: it takes 50.0 % less time than f64 robust"),
        "the times of plain and stable overlap, and stable is more reliable: {answer}"
    );
    assert!(answer.contains("at another scale its fixed RAY_EPSILON"), "{answer}");
    assert_eq!(
        report.headline,
        "Pick f64 stable, 1×1, depth 2: f64 stable gives the same picture at this scale in 50.0 % \
            of the time."
    );
    let formulas = &report.questions[0].facts[0];
    assert!(formulas.starts_with("Formulas: plain takes 19.0 ms and changes no pixel;"));
    assert!(formulas.ends_with("so none of them is named the fastest."), "{formulas}");
}

#[test]
fn where_times_overlap_the_scene_stays_as_it_is() {
    let equals = [
        Row(OWN, 20.0, 0.0, 0.0),
        Row(numbers(F64, Formula::Plain), 18.5, 0.0, 0.0),
        Row(numbers(F32, Formula::Robust), 19.0, 0.5, 1.0),
    ];
    let report = said(question(Choice::Rounding, &equals), false);
    assert!(report.questions[0].pick().unwrap().is_own);
    assert_eq!(
        report.headline,
        "Keep the scene as it stands (f64 robust, 1×1, depth 2): exact rounding costs no \
            measurable time."
    );
    assert_eq!(
        report.questions[0].facts[0],
        "Precision: f32 robust takes as long as f64 robust within the spread of the times \
            (19.0 against 20.0 ms) and changes 50.0 % of the pixels, the worst by 50.0 levels."
    );
    let cheap = Row(numbers(F64, Formula::Plain), 16.0, 0.25, 0.0);
    let report = said(question(Choice::Rounding, &[Row(OWN, 20.0, 0.0, 0.0), cheap]), false);
    assert_eq!(
        report.questions[0].answer,
        "Keep f64 robust: f64 plain takes 20.0 % less time than f64 robust, but changes 25.0 % of \
            the pixels, the worst by 25.0 levels."
    );
    assert!(report.headline.ends_with(": exact rounding costs 25.0 % more time."));
}

#[test]
fn the_scene_keeps_its_depth_unless_another_may_be_picked() {
    let enough = || {
        question(
            Choice::Depth,
            &[
                Row(OWN, 40.0, 0.0, 0.0),
                Row(depth(1), 20.0, 0.0, 0.0),
                Row(depth(0), 10.0, 0.5, 9.0),
                Row(depth(6), 41.0, 0.0, 0.0),
                Row(Setting { threshold: 1.0 / 64.0, ..OWN }, 30.0, 0.0, 0.0),
                Row(Setting { threshold: 1.0 / 16.0, ..OWN }, 20.0, 0.125, 1.0),
            ],
        )
    };
    let report = said(enough(), false);
    assert_eq!(report.questions[0].answer, "Keep depth 2: more changes no pixel.");
    assert_eq!(
        report.questions[0].facts,
        [
            "Depth: 0 to 6 takes 10.0 to 41.0 ms; 1 is enough.",
            "Threshold: up to 1/64 changes no pixel and takes 25.0 % less time than depth 2.",
        ]
    );
    let report = said(enough(), true);
    assert!(
        report.questions[0].answer.starts_with("Pick depth 1: it gives the same picture and takes"),
        "{}",
        report.questions[0].answer
    );
    let shallow =
        || question(Choice::Depth, &[Row(OWN, 40.0, 0.125, 4.0), Row(depth(4), 50.0, 0.0, 0.0)]);
    let report = said(shallow(), false);
    assert_eq!(
        report.questions[0].answer,
        "Depth 2 leaves out light, which changes 12.5 % of the pixels, the worst by 12.5 levels; \
            depth 4 changes none and takes 25.0 % longer than depth 2."
    );
    assert!(report.questions[0].pick().unwrap().is_own);
    assert_eq!(said(shallow(), true).questions[0].pick().unwrap().setting, depth(4));
}

#[test]
fn no_pick_costs_more_for_the_same_picture() {
    let rows = [Row(OWN, 40.0, 0.0, 0.0), Row(depth(4), 60.0, 0.0, 0.0)];
    assert!(said(question(Choice::Depth, &rows), true).questions[0].pick().unwrap().is_own);
}

#[test]
fn a_bound_is_given_only_if_it_is_less_than_the_whole_range() {
    let proven = |bound| {
        let rows = [Row(OWN, 40.0, 0.0, 0.0), Row(depth(1), 20.0, 0.5, 1.0)];
        let report = advised(vec![question(Choice::Depth, &rows)], 2, false, bound);
        report.questions[0].facts.iter().find(|fact| fact.starts_with("Proven")).cloned()
    };
    assert_eq!(
        proven(0.01).unwrap(),
        "Proven: what depth 2 leaves out darkens no pixel by more than 2.55 levels."
    );
    assert_eq!(proven(0.0).unwrap(), "Proven: depth 2 leaves out no light.");
    assert_eq!([proven(1.0), proven(2.6), proven(f64::INFINITY)], [None, None, None]);
}

#[test]
fn the_gain_of_samples_is_a_power() {
    let rows = [
        Row(OWN, 10.0, 0.5, 8.0),
        Row(samples(2), 40.0, 0.5, 4.0),
        Row(samples(4), 160.0, 0.5, 2.0),
        Row(samples(8), 640.0, 0.0, 0.0),
    ];
    let report = said(question(Choice::Sampling, &rows), false);
    assert_eq!(
        report.questions[0].answer,
        "Keep 1×1, or lower the error from 8.00 to 4.00 levels: 2×2 takes 4.00 times as long as \
            1×1."
    );
    assert_eq!(
        report.questions[0].facts,
        ["Samples: 1×1 has 8.00 levels in 10.0 ms, 2×2 has 4.00 levels in 40.0 ms, 4×4 has 2.00 \
            levels in 160 ms (root mean square); the error falls as the rays a side to the power \
            −1.00."]
    );
    assert!(report.headline.ends_with(": sampling at 2×2 costs 4.00 times the time."));
}

#[test]
fn one_round_gives_no_advice() {
    let rows = [Row(OWN, 40.0, 0.0, 0.0), Row(numbers(F64, Formula::Plain), 10.0, 0.0, 0.0)];
    let report = advised(vec![question(Choice::Rounding, &rows)], 1, false, 0.0);
    assert_eq!(report.headline, "Figures without advice: the times of one round have no spread.");
    let question = &report.questions[0];
    assert!(question.pick().is_none() && question.answer.is_empty() && question.facts.is_empty());
}
