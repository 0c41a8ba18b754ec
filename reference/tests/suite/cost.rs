//! Tests of `cost`: the settings that are measured, the report of the measurements, and its
//! formats.

use crate::common::cost::{FakeClock, SCENE, scene, well_formed};
use cases::Effect;
use reference::cost::bench::Bench;
use reference::cost::error::Error;
use reference::cost::measure::{measure, work};
use reference::cost::plot::{self, Place};
use reference::cost::report::{Machine, Report};
use reference::cost::scaled::scaled;
use reference::cost::setting::{Formula, Setting};
use reference::cost::sweep::{About, Axes, Sweep};
use reference::cost::{csv, page, table};
use reference::expect::variations::Precision;
use reference::rules::Rules;

fn report_of(name: &str, n_rounds: usize, outside: &mut FakeClock) -> Option<Report> {
    let scene = scene(SCENE);
    let sweep =
        Sweep::of(&scene, &Axes { samples: vec![1, 2], truth_samples: 3, ..Axes::of(&scene) });
    let mut bench = Bench::new(&scene, &Rules::LECTURE);
    let measured = measure(&mut bench, &sweep, n_rounds, outside)?;
    let machine = Machine {
        processor: "a <fast> one".to_owned(),
        threads: 1,
        clock: "processor time",
        is_optimised: true,
    };
    Some(Report::new(name, &scene, &Rules::LECTURE, machine, &sweep, &measured, n_rounds))
}

#[test]
fn the_sweep_crosses_what_matters_and_takes_the_rest_one_by_one() {
    let scene = scene(SCENE);
    let axes = Axes::of(&scene);
    let sweep = Sweep::of(&scene, &axes);
    let own = Setting::of(&scene);
    assert_eq!(
        (own.precision, own.formula, own.samples, own.max_depth),
        (Precision::F64, Formula::Robust, 1, 2)
    );
    let accuracy: Vec<Setting> = sweep
        .subjects
        .iter()
        .filter(|(_, about)| *about == About::Accuracy)
        .map(|(setting, _)| *setting)
        .collect();
    let measured = |wanted: Setting| {
        assert_eq!(accuracy.iter().filter(|s| **s == wanted).count(), 1, "{wanted}");
    };
    for precision in [Precision::F32, Precision::F64] {
        for formula in Formula::ALL {
            measured(Setting { precision, formula, alike: true, ..own });
        }
    }
    for samples in [1, 2, 4] {
        measured(Setting { samples, ..own });
    }
    for samples in [2, 4] {
        measured(Setting { samples, adaptive: true, ..own });
    }
    for max_depth in [0, 1, 2, 3, 4] {
        assert!(accuracy.contains(&Setting { max_depth, ..own }), "depth {max_depth}");
    }
    for threshold in [0.0, 1e-3, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0] {
        assert!(accuracy.contains(&Setting { threshold, ..own }), "threshold {threshold}");
    }
    assert_eq!(sweep.truth, Setting { samples: 8, ..own }, "the scene keeps its depth");
    assert_eq!(sweep.deepest, Setting { max_depth: 4, ..own });
    // 6 are crossed in kernels compiled alike, the scene's own is first, 4 have other grids, 4
    // other depths, 4 other thresholds, and the truth has 8 rays a side. No light weakens with
    // distance, so that there is no light cut-off.
    assert_eq!(accuracy.len(), 6 + 1 + 4 + 4 + 4 + 1);
    let effects: Vec<About> =
        sweep.subjects.iter().map(|(_, about)| *about).filter(|a| *a != About::Accuracy).collect();
    let without = [Effect::Shadows, Effect::TintedShadows, Effect::Reflection, Effect::Refraction];
    assert_eq!(
        effects,
        [&without.map(About::Without)[..], &[About::Everything, About::WithoutTrees]].concat()
    );
    let full = Sweep::of(&scene, &Axes { full: true, effects: false, ..axes });
    let one_by_one = 1 + 4 + 4 + 4; // the scene's own, grids, depths, thresholds
    assert_eq!(full.subjects.len(), 2 * 3 * 3 * 5 * 5 + one_by_one + 1, "and the truth");
}

#[test]
fn nothing_that_the_scene_does_not_call_for_is_swept() {
    let plain = SCENE.replace("kr = [0.3, 0.3, 0.3], ", "").replace(", kr = [0.4, 0.4, 0.4]", "");
    let scene = scene(&plain.replace("kt = [0.5, 0.5, 0.5], ", ""));
    let sweep = Sweep::of(&scene, &Axes::of(&scene));
    assert!(
        sweep.subjects.iter().all(|(s, _)| s.max_depth == 2 && s.threshold == 0.0),
        "depth and threshold vary, but no ray is spawned"
    );
    // precision and formulas, own, grids, truth; without shadows, with everything, without trees
    assert_eq!(sweep.subjects.len(), 6 + 1 + 4 + 1 + 3);
}

#[test]
fn matrices_and_attenuation_are_left_out_one_by_one_too() {
    let lamp = SCENE.replace("point = {", "point = { attenuation = { linear = 0.1 },");
    let scene = scene(&lamp.replace("sphere = {}", "sphere = {}\ntransforms = [{ scale = 0.5 }]"));
    let sweep = Sweep::of(&scene, &Axes::of(&scene));
    let mut bench = Bench::new(&scene, &Rules::LECTURE);
    let own = bench.render(&sweep.own);
    for effect in [Effect::Transforms, Effect::Attenuation] {
        let (setting, _) = sweep
            .subjects
            .iter()
            .find(|(_, about)| *about == About::Without(effect))
            .expect("it is swept");
        assert_ne!(bench.render(setting).0, own.0, "without {effect}");
    }
    assert_eq!(bench.render(&sweep.own), own, "the scene is as it was");
}

#[test]
fn lights_that_weaken_are_cut_off_at_several_strengths() {
    let weak = scene(&SCENE.replace("point = {", "point = { attenuation = { linear = 0.1 },"));
    let sweep = Sweep::of(&weak, &Axes::of(&weak));
    let cutoffs: Vec<f64> = sweep
        .subjects
        .iter()
        .map(|(setting, _)| setting.light_cutoff)
        .filter(|cutoff| *cutoff > 0.0)
        .collect();
    assert_eq!(cutoffs, [1e-3, 1.0 / 256.0, 1.0 / 64.0]);
    let mut bench = Bench::new(&weak, &Rules::LECTURE);
    let all = bench.render(&sweep.own).1.rays.shadow;
    // No light source is stronger than 10.
    let none = bench.render(&Setting { light_cutoff: 10.0, ..sweep.own }).1.rays.shadow;
    assert!(all > 0 && none == 0, "{all} and {none} shadow rays");
    let strong = Sweep::of(&scene(SCENE), &Axes::of(&scene(SCENE)));
    assert!(strong.subjects.iter().all(|(setting, _)| setting.light_cutoff == 0.0));
}

#[test]
fn errors_are_taken_from_the_truth_and_times_from_the_clock() {
    let mut outside = FakeClock::until(usize::MAX);
    let report = report_of("a", 3, &mut outside).unwrap();
    let scene = scene(SCENE);
    let sweep =
        Sweep::of(&scene, &Axes { samples: vec![1, 2], truth_samples: 3, ..Axes::of(&scene) });
    assert_eq!(outside.work, work(&sweep, 3), "the reported work is the work that was announced");
    let row = |setting: Setting| report.row(&setting).unwrap();
    let (own, truth, deepest) = (row(report.own), row(sweep.truth), row(sweep.deepest));
    let none = |error: Option<Error>| error.unwrap().max_light == 0.0;
    assert!(none(truth.sampling) && none(deepest.depth) && none(own.rounding));
    assert!(own.sampling.unwrap().rms_levels > 0.0 && own.sampling.unwrap().changed > 0.0);
    assert!(own.depth.unwrap().max_light > 0.0, "depth 2 is not 4");
    assert!(deepest.sampling.is_none() && truth.depth.is_none(), "one error is not the other");
    let depth_0 = row(Setting { max_depth: 0, ..report.own });
    assert!(depth_0.depth.unwrap().rms_light > own.depth.unwrap().rms_light);
    assert_eq!((depth_0.rays.reflected, depth_0.rays.eye), (0, 12 * 9));
    assert_eq!(truth.rays.eye, 12 * 9 * 9);
    for row in &report.rows {
        assert_eq!(
            (row.time_ms.median, row.time_ms.least, row.time_ms.greatest),
            (500.0, 500.0, 500.0),
            "{}",
            row.name
        );
        assert!(row.bytes > 12 * 9 * 12, "{}", row.name);
    }
    let alike = Setting { alike: true, ..report.own };
    let plain = row(Setting { precision: Precision::F32, formula: Formula::Plain, ..alike });
    assert!(plain.bytes < own.bytes);
    let rounding = plain.rounding.unwrap();
    assert!(
        rounding.max_light > 0.0 && rounding.max_light < own.depth.unwrap().max_light,
        "rounding alone, not depth: {rounding:?}"
    );
    assert!(
        report.rows.iter().all(|row| row.rounding.is_some()),
        "every setting has its exact sibling"
    );
    // All take equally long, so only the most accurate settings can be on a front, and none is
    // picked instead of the scene's own.
    assert_eq!(report.questions.len(), 3);
    for question in &report.questions {
        for row in &question.rows {
            assert_eq!(row.is_on_front, row.error.rms_levels == 0.0, "{}", row.name);
            let as_rendered = Setting { alike: false, ..row.setting };
            assert_eq!((row.is_own, row.is_pick), (as_rendered == report.own, row.is_own));
            assert_eq!(row.picture.is_some(), row.error.changed > 0.0, "{}", row.name);
            assert_eq!(row.of_own, 1.0);
        }
    }
    let [rounding, depth, sampling] = &report.questions[..] else { panic!("three questions") };
    assert_eq!([rounding, depth, sampling].map(|question| question.rows.len()), [6, 9, 4]);
    let shadows = report.effects.iter().find(|row| row.without == Some(Effect::Shadows)).unwrap();
    assert_eq!(shadows.rays.shadow, 0);
    assert!(shadows.error.changed > 0.0);
    let all = report.effects.iter().find(|row| row.without.is_none()).unwrap();
    assert_eq!(
        (all.error.max_light, all.more_ms),
        (0.0, 0.0),
        "an effect that is not called for changes nothing"
    );
}

#[test]
fn what_is_stopped_keeps_the_rounds_that_are_done() {
    let mut count = FakeClock::until(usize::MAX);
    let whole = report_of("a", 2, &mut count).unwrap();
    let n_settings = whole.rows.len() + whole.effects.len();
    assert_eq!((whole.rounds, whole.is_cut_short, count.n_calls), (2, false, 3 * n_settings));
    for (stops_before, rounds) in
        [(0, None), (n_settings, None), (2 * n_settings - 1, None), (2 * n_settings, Some(1))]
    {
        let report = report_of("a", 2, &mut FakeClock::until(stops_before));
        assert_eq!(report.as_ref().map(|report| report.rounds), rounds, "{stops_before}");
        assert!(report.is_none_or(
            |report| report.is_cut_short && table::text(&report).contains("Stopped before")
        ));
    }
    let late = report_of("a", 2, &mut FakeClock::until(3 * n_settings - 1)).unwrap();
    assert_eq!(late.rounds, 1, "an incomplete round does not count");
}

const HOSTILE: &str = "=1+1,\"</title><script>alert('x')</script>\u{1b}[2J\u{202e}\n{{ 7*7 }}";

#[test]
fn every_form_is_well_made_whatever_the_scene_is_called() {
    let report = report_of(HOSTILE, 1, &mut FakeClock::until(usize::MAX)).unwrap();
    let json: serde_json::Value =
        serde_json::from_slice(&serde_json::to_vec(&report).unwrap()).unwrap();
    assert_eq!(json["rows"].as_array().unwrap().len(), report.rows.len());
    assert_eq!(json["rows"][0]["precision"], "f64");
    let text = csv::csv(&report).unwrap();
    let mut lines = ::csv::Reader::from_reader(&text[..]);
    let n_columns = lines.headers().unwrap().len();
    let lines: Vec<_> = lines.records().map(Result::unwrap).collect();
    let n_asked: usize = report.questions.iter().map(|question| question.rows.len()).sum();
    assert_eq!(lines.len(), n_asked + report.effects.len());
    assert!(lines.iter().all(|line| line.len() == n_columns && line[0].starts_with("'=1+1,\"")));
    let svgs: Vec<String> =
        page::plots(&report).iter().map(|plot| plot::svg(plot, Place::File)).collect();
    let page = page::page(&report);
    for text in svgs.iter().chain([&page]) {
        // Links lead to pictures on the page, which contains them.
        let text = &text.replace("href=\"#", "").replace("src=\"data:image/png;base64,", "");
        assert!(
            !text.contains("<script") && !text.contains('\u{1b}') && !text.contains('\u{202e}'),
            "{text}"
        );
        assert!(
            !text.contains("style=\"") && !text.contains("href") && !text.contains("src="),
            "{text}"
        );
    }
    assert!(page.contains("{{ 7*7 }}") && page.contains("a &lt;fast&gt; one"));
    for svg in &svgs {
        well_formed(svg);
    }
    assert!(
        !table::text(&report).contains("[2J\u{1b}") && table::text(&report).contains("\\u{1b}[2J")
    );
}

#[test]
fn a_page_needs_nothing_and_allows_nothing_but_its_style() {
    use base64::Engine;
    use sha2::Digest;
    let page = page::page(&report_of("a", 1, &mut FakeClock::until(usize::MAX)).unwrap());
    let style = page.split("<style>").nth(1).unwrap().split("</style>").next().unwrap();
    let hash = base64::prelude::BASE64_STANDARD.encode(sha2::Sha256::digest(style));
    let policy = page
        .split("Content-Security-Policy\" content=\"")
        .nth(1)
        .unwrap()
        .split("\">")
        .next()
        .unwrap();
    let policy = policy.replace("&#x2f;", "/").replace("&#x27;", "'");
    assert!(
        policy
            .starts_with(&format!("default-src 'none'; img-src data:; style-src 'sha256-{hash}';")),
        "{policy}"
    );
    assert_eq!(
        page.matches("<style>").count(),
        1,
        "the pictures have no style sheets of their own"
    );
}

#[test]
fn a_scene_in_another_size_has_the_same_picture() {
    let scene = scene(&SCENE.replace(
        "ambient = [0.2, 0.2, 0.2]",
        "attenuation = { quadratic = 0.02, linear = 0.1, constant = 0.5 }",
    ));
    let own = Setting::of(&scene);
    let (picture, _) = Bench::new(&scene, &Rules::LECTURE).render(&own);
    for factor in [1024.0, 1.0 / 1024.0, 1e3] {
        let (other, _) = Bench::new(&scaled(&scene, factor), &Rules::LECTURE).render(&own);
        let error = Error::of(&picture, &other, Default::default());
        assert!(error.max_levels < 1e-6, "{factor}: {error:?}");
    }
}
