//! What accuracy costs: which settings are measured, what is made of them, and how it is written.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use cases::{Effect, Scene, scene};
use reference::cost::bench::Bench;
use reference::cost::error::Error;
use reference::cost::measure::{Outside, measure, work};
use reference::cost::plot::{self, Place};
use reference::cost::report::{Machine, Report};
use reference::cost::scaled::scaled;
use reference::cost::setting::{Formula, Setting};
use reference::cost::sweep::{About, Axes, Sweep};
use reference::cost::{csv, page, table};
use reference::rules::Rules;
use reference::variations::Precision;

const SCENE: &str = r#"
[render]
size = [12, 9]
max_depth = 2
[scene.camera]
eye = [0, 0.2, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 40
[scene.materials]
glass = { kd = [0.1, 0.1, 0.1], kt = [0.5, 0.5, 0.5], kr = [0.3, 0.3, 0.3], index = 1.5 }
wall = { kd = [0.6, 0.4, 0.2], kr = [0.4, 0.4, 0.4] }
[[scene.lights]]
point = { position = [2, 3, 4], colour = [1, 1, 1], ambient = [0.2, 0.2, 0.2] }
[[scene.objects]]
sphere = {}
material = "glass"
[[scene.objects]]
plane = { normal = [0, 1, 0], k = -0.7 }
material = "wall"
"#;

fn scene(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    scene::load(&path).unwrap()
}

/// Every picture takes as many seconds as it has rays a side of a pixel; the measurement is stopped before picture number `stops_before`.
struct Still {
    now_s: f64,
    n_asked: usize,
    stops_before: usize,
    work: u64,
}

impl Still {
    fn until(stops_before: usize) -> Self {
        Self { now_s: 0.0, n_asked: 0, stops_before, work: 0 }
    }
}

impl Outside for Still {
    fn now_s(&mut self) -> f64 {
        self.now_s += 0.5;
        self.now_s
    }

    fn goes_on(&mut self) -> bool {
        self.n_asked += 1;
        self.n_asked <= self.stops_before
    }

    fn done(&mut self, work: u64) {
        self.work += work;
    }
}

fn report_of(name: &str, n_rounds: usize, outside: &mut Still) -> Option<Report> {
    let scene = scene(SCENE);
    let sweep = Sweep::of(&scene, &Axes { samples: vec![1, 2], truth_samples: 3, ..Axes::of(&scene) });
    let mut bench = Bench::new(&scene, &Rules::LECTURE);
    let measured = measure(&mut bench, &sweep, n_rounds, outside)?;
    let machine =
        Machine { processor: "a <fast> one".to_owned(), threads: 1, clock: "processor time", is_optimised: true };
    Some(Report::new(name, &scene, &Rules::LECTURE, machine, &sweep, &measured, n_rounds))
}

#[test]
fn the_sweep_crosses_what_matters_and_takes_the_rest_one_by_one() {
    let scene = scene(SCENE);
    let axes = Axes::of(&scene);
    let sweep = Sweep::of(&scene, &axes);
    let own = Setting::of(&scene);
    assert_eq!((own.precision, own.formula, own.samples, own.max_depth), (Precision::F64, Formula::Robust, 1, 2));
    let accuracy: Vec<Setting> =
        sweep.subjects.iter().filter(|(_, about)| *about == About::Accuracy).map(|(setting, _)| *setting).collect();
    for samples in [1, 2, 4] {
        for precision in [Precision::F32, Precision::F64] {
            for formula in Formula::ALL {
                let wanted = Setting { samples, precision, formula, ..own };
                assert_eq!(accuracy.iter().filter(|s| **s == wanted).count(), 1, "{wanted}");
            }
        }
        assert!(accuracy.contains(&Setting { samples, max_depth: 4, ..own }), "the exact one with as many rays");
    }
    for max_depth in [0, 1, 2, 3, 4] {
        assert!(accuracy.contains(&Setting { max_depth, ..own }), "depth {max_depth}");
    }
    for threshold in [0.0, 1e-3, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0] {
        assert!(accuracy.contains(&Setting { threshold, ..own }), "threshold {threshold}");
    }
    assert_eq!(sweep.truth, Setting { samples: 8, max_depth: 4, ..own });
    // 18 crossed, 4 other depths, 4 other thresholds, and the exact ones of 2, 4 and 8
    assert_eq!(accuracy.len(), 18 + 4 + 4 + 3);
    let effects: Vec<About> =
        sweep.subjects.iter().map(|(_, about)| *about).filter(|a| *a != About::Accuracy).collect();
    let without = [Effect::Shadows, Effect::TintedShadows, Effect::Reflection, Effect::Refraction];
    assert_eq!(effects, [&without.map(About::Without)[..], &[About::Everything]].concat());
    let full = Sweep::of(&scene, &Axes { full: true, effects: false, ..axes });
    assert_eq!(full.subjects.len(), 2 * 3 * 3 * 5 * 5 + 1, "and the truth");
}

#[test]
fn nothing_that_the_scene_does_not_call_for_is_swept() {
    let plain = SCENE.replace("kr = [0.3, 0.3, 0.3], ", "").replace(", kr = [0.4, 0.4, 0.4]", "");
    let scene = scene(&plain.replace("kt = [0.5, 0.5, 0.5], ", ""));
    let sweep = Sweep::of(&scene, &Axes::of(&scene));
    assert!(sweep.subjects.iter().all(|(s, _)| s.max_depth == 2 && s.threshold == 0.0), "no ray is spawned");
    assert_eq!(sweep.subjects.len(), 18 + 1 + 2, "the truth; without shadows, and with everything");
}

#[test]
fn errors_are_taken_from_the_truth_and_times_from_the_clock() {
    let mut outside = Still::until(usize::MAX);
    let report = report_of("a", 3, &mut outside).unwrap();
    let scene = scene(SCENE);
    let sweep = Sweep::of(&scene, &Axes { samples: vec![1, 2], truth_samples: 3, ..Axes::of(&scene) });
    assert_eq!(outside.work, work(&sweep, 3), "what the bar is told comes to what it was promised");
    let row = |setting: Setting| report.row(&setting).unwrap();
    let (own, truth) = (row(report.own), row(report.truth));
    assert_eq!((truth.error.rms_levels, truth.error.max_light, truth.error.changed), (0.0, 0.0, 0.0));
    assert!(own.error.rms_levels > 0.0 && own.error.changed > 0.0);
    let exact = row(Setting { samples: 1, ..report.truth });
    assert_eq!(exact.same_rays.max_light, 0.0);
    assert!(own.same_rays.max_light > 0.0, "depth 2 is not 4");
    let depth_0 = row(Setting { max_depth: 0, ..report.own });
    assert!(depth_0.same_rays.rms_light > own.same_rays.rms_light);
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
    let plain = row(Setting { precision: Precision::F32, formula: Formula::Plain, ..report.own });
    assert!(plain.same_rays.max_light > own.same_rays.max_light * 0.999, "f32 is no better than f64");
    assert!(plain.bytes < own.bytes);
    // all take as long, so that only the most accurate can be on the front
    assert!(report.rows.iter().all(|row| row.is_on_front == (row.error.rms_levels == 0.0)));
    let shadows = report.effects.iter().find(|row| row.without == Some(Effect::Shadows)).unwrap();
    assert_eq!(shadows.rays.shadow, 0);
    assert!(shadows.error.changed > 0.0);
    let all = report.effects.iter().find(|row| row.without.is_none()).unwrap();
    assert_eq!((all.error.max_light, all.more_ms), (0.0, 0.0), "what is not called for changes nothing");
}

#[test]
fn what_is_stopped_keeps_the_rounds_that_are_done() {
    let mut count = Still::until(usize::MAX);
    let whole = report_of("a", 2, &mut count).unwrap();
    let n_settings = whole.rows.len() + whole.effects.len();
    assert_eq!((whole.rounds, whole.is_cut_short, count.n_asked), (2, false, 3 * n_settings));
    for (stops_before, rounds) in [(0, None), (n_settings, None), (2 * n_settings - 1, None), (2 * n_settings, Some(1))]
    {
        let report = report_of("a", 2, &mut Still::until(stops_before));
        assert_eq!(report.as_ref().map(|report| report.rounds), rounds, "{stops_before}");
        assert!(report.is_none_or(|report| report.is_cut_short && table::text(&report).contains("Stopped before")));
    }
    let late = report_of("a", 2, &mut Still::until(3 * n_settings - 1)).unwrap();
    assert_eq!(late.rounds, 1, "a round that is not whole does not count");
}

const HOSTILE: &str = "=1+1,\"</title><script>alert('x')</script>\u{1b}[2J\u{202e}\n{{ 7*7 }}";

#[test]
fn every_form_is_well_made_whatever_the_scene_is_called() {
    let report = report_of(HOSTILE, 1, &mut Still::until(usize::MAX)).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&serde_json::to_vec(&report).unwrap()).unwrap();
    assert_eq!(json["rows"].as_array().unwrap().len(), report.rows.len());
    assert_eq!(json["rows"][0]["precision"], "f64");
    let text = csv::csv(&report).unwrap();
    let mut lines = ::csv::Reader::from_reader(&text[..]);
    let n_columns = lines.headers().unwrap().len();
    let lines: Vec<_> = lines.records().map(Result::unwrap).collect();
    assert_eq!(lines.len(), report.rows.len() + report.effects.len());
    assert!(lines.iter().all(|line| line.len() == n_columns && line[0].starts_with("'=1+1,\"")));
    let svgs = page::plots(&report).map(|plot| plot::svg(&plot, Place::File));
    let page = page::page(&report);
    for text in svgs.iter().chain([&page]) {
        assert!(!text.contains("<script") && !text.contains('\u{1b}') && !text.contains('\u{202e}'), "{text}");
        assert!(!text.contains("style=\"") && !text.contains("href") && !text.contains("src="), "{text}");
    }
    assert!(page.contains("{{ 7*7 }}") && page.contains("a &lt;fast&gt; one"));
    for svg in &svgs {
        well_formed(svg);
    }
    assert!(!table::text(&report).contains("[2J\u{1b}") && table::text(&report).contains("\\u{1b}[2J"));
}

/// Every element is closed in its order, and every `&` begins an entity.
fn well_formed(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{svg}");
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap());
        }
    }
    assert_eq!(open, Vec::<&str>::new());
    assert!(
        svg.split('&').skip(1).all(|rest| ["amp;", "lt;", "gt;", "quot;", "#39;"].iter().any(|e| rest.starts_with(e)))
    );
}

#[test]
fn a_page_needs_nothing_and_allows_nothing_but_its_style() {
    use base64::Engine;
    use sha2::Digest;
    let page = page::page(&report_of("a", 1, &mut Still::until(usize::MAX)).unwrap());
    let style = page.split("<style>").nth(1).unwrap().split("</style>").next().unwrap();
    let hash = base64::prelude::BASE64_STANDARD.encode(sha2::Sha256::digest(style));
    let policy = page.split("Content-Security-Policy\" content=\"").nth(1).unwrap().split("\">").next().unwrap();
    let policy = policy.replace("&#x2f;", "/").replace("&#x27;", "'");
    assert!(policy.starts_with(&format!("default-src 'none'; style-src 'sha256-{hash}';")), "{policy}");
    assert_eq!(page.matches("<style>").count(), 1, "the pictures bring none along");
}

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_reference")).current_dir(folder).args(args).output().unwrap()
}

fn check(folder: &Path, args: &[&str], code: i32, said: &str) -> Output {
    let output = run(folder, &[&["cost"], args].concat());
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{args:?}: {err}");
    assert!(out.contains(said) || err.contains(said), "{args:?}: {out}{err}");
    output
}

#[test]
fn the_command_prints_a_table_and_writes_every_form() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("scene.toml"), SCENE).unwrap();
    let short = ["scene.toml", "--samples", "1", "--rounds", "1", "--depths", "2"];
    let files = ["--json", "a.json", "--csv", "a.csv", "--svg", "a.svg", "--html", "a.html"];
    let table = check(folder.path(), &[&short[..], &files].concat(), 0, "Pick ");
    assert!(!table.stdout.contains(&0x1b), "no colour where no terminal is");
    for (file, begins) in [("a.json", "{"), ("a.csv", "scene,width"), ("a.svg", "<svg "), ("a.html", "<!DOCTYPE html>")]
    {
        assert!(std::fs::read_to_string(at(file)).unwrap().starts_with(begins), "{file}");
    }
    let streamed = check(folder.path(), &[&short[..], &["--json", "-"]].concat(), 0, "");
    let json: serde_json::Value = serde_json::from_slice(&streamed.stdout).unwrap();
    assert_eq!((json["rounds"].as_u64(), json["own"]["max_depth"].as_u64()), (Some(1), Some(2)));
    check(
        folder.path(),
        &[&short[..], &["--formulas", "plain", "--no-effects", "--full"]].concat(),
        0,
        "f32 plain, 1×1",
    );
    check(folder.path(), &["scene.toml", "--json", "-", "--csv", "-"], 2, "only one of");
    check(folder.path(), &["scene.toml", "--formulas", "naive"], 2, "plain, stable or robust");
    check(folder.path(), &["scene.toml", "--thresholds", "2"], 2, "from 0 to 1");
    check(folder.path(), &["none.toml"], 2, "there is no file");
    check(folder.path(), &[&short[..], &["--svg", "no/such/folder.svg"]].concat(), 3, "cannot write");
}

#[test]
fn functions_are_measured_one_by_one_and_written_in_every_form() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let files = ["--json", "f.json", "--csv", "f.csv", "--svg", "f.svg", "--html", "f.html"];
    check(
        folder.path(),
        &[&["--functions", "--draws", "40", "--rounds", "1"][..], &files].concat(),
        0,
        "Möller–Trumbore",
    );
    let json: serde_json::Value = serde_json::from_str(&at("f.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let of = |function: &str, formula: &str, precision: &str| {
        let is_it = |row: &&serde_json::Value| {
            row["function"] == function && row["formula"] == formula && row["precision"] == precision
        };
        rows.iter().find(is_it).unwrap_or_else(|| panic!("{function}, {formula}, {precision}"))
    };
    let [robust, textbook] = ["robust", "textbook quadratic"].map(|formula| of("sphere", formula, "f64"));
    assert_eq!(robust["n"], 8 * 40);
    assert_eq!(robust["wrong"], 0);
    assert!(textbook["wrong"].as_u64() > Some(0), "the textbook formula is known to fail there");
    assert!(robust["max_error"].as_f64() < of("sphere", "robust", "f32")["max_error"].as_f64());
    for row in rows {
        let families = row["families"].as_array().unwrap();
        let sum: u64 = families.iter().map(|family| family["wrong"].as_u64().unwrap()).sum();
        assert_eq!(row["wrong"], sum);
        assert!(row["ns"]["median"].as_f64().unwrap() > 0.0);
    }
    assert_eq!(of("cone", "robust", "f64")["precision"], "f64");
    let text = at("f.csv");
    let mut lines = ::csv::Reader::from_reader(text.as_bytes());
    let n_families: usize = rows.iter().map(|row| row["families"].as_array().unwrap().len()).sum();
    assert_eq!(lines.records().map(Result::unwrap).count(), n_families);
    well_formed(&at("f.svg"));
    assert!(at("f.html").contains("<figure><svg") && !at("f.html").contains("<script"));
    check(folder.path(), &["--functions", "scene.toml"], 2, "cannot be used with");
    check(folder.path(), &[], 2, "required");
}

#[test]
fn the_page_of_the_documentation_is_made_of_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = folder.path().join("accuracy.md");
    let short = ["--samples", "1", "--rounds", "1", "--draws", "10", "--depths", "0,2", "--size", "16x12"];
    check(&workspace, &[&["--page", page.to_str().unwrap()][..], &short].concat(), 0, "wrote");
    let text = std::fs::read_to_string(&page).unwrap();
    let mut n_pictures = 0;
    for (_, target) in
        text.match_indices("](").map(|(at, _)| text[at + 2..].split_once(')').unwrap()).map(|(t, _)| ((), t))
    {
        if target.ends_with(".svg") {
            well_formed(&std::fs::read_to_string(folder.path().join(target)).unwrap());
            n_pictures += 1;
        }
    }
    assert_eq!(n_pictures, 5);
    let mut n_columns = None;
    for line in text.lines() {
        let n = line.starts_with('|').then(|| line.matches('|').count());
        assert!(n.is_none() || n_columns.is_none() || n == n_columns, "a row has another number of cells: {line}");
        n_columns = n;
    }
    assert!(text.contains("| depth 2 |") && text.contains("| f32, t > 1e-4 |"), "{text}");
}

#[test]
fn fronts_are_stored_beside_the_stages() {
    let folder = tempfile::tempdir().unwrap();
    let stage = folder.path().join("cases/stages/01_one");
    std::fs::create_dir_all(&stage).unwrap();
    let head = "title = \"One\"\nabout = \"a\"\nneeds = []\nunit_points = 1\n";
    std::fs::write(stage.join("stage.toml"), format!("{head}allows = [\"shadows\", \"reflection\"]\n")).unwrap();
    let head = "title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n";
    std::fs::write(stage.join("ball.toml"), format!("{head}{SCENE}")).unwrap();
    check(folder.path(), &["--store", "--rounds", "1"], 0, "1 cases");
    let stages = folder.path().join("cases/stages");
    let text = std::fs::read_to_string(cases::front::fronts_path(&stages)).unwrap();
    let fronts = cases::front::fronts_from_str(&text).unwrap();
    let points = &fronts.cases["01_one/ball"];
    assert_eq!(points.len(), 6 + 2, "two precisions by three formulas, and two lesser depths");
    assert!(points.iter().all(|point| point.time_s > 0.0));
    let named = |name: &str| points.iter().find(|point| point.setting == name).unwrap();
    assert_eq!(named("f64, robust formulas").rmse_levels, 0.0);
    assert!(named("f64, robust formulas, depth 0").rmse_levels > 0.0);
}

#[test]
fn a_scene_in_another_size_has_the_same_picture() {
    let scene = scene(
        &SCENE.replace("ambient = [0.2, 0.2, 0.2]", "attenuation = { quadratic = 0.02, linear = 0.1, constant = 0.5 }"),
    );
    let own = Setting::of(&scene);
    let (picture, _) = Bench::new(&scene, &Rules::LECTURE).render(&own);
    for factor in [1024.0, 1.0 / 1024.0, 1e3] {
        let (other, _) = Bench::new(&scaled(&scene, factor), &Rules::LECTURE).render(&own);
        let error = Error::of(&picture, &other, Default::default());
        assert!(error.max_levels < 1e-6, "{factor}: {error:?}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_measurement_ends_with_130() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_reference"))
        .current_dir(folder.path())
        .args(["cost", "scene.toml", "--rounds", "1000", "--size", "256x192", "--no-effects", "--verbose"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    errors.read_line(&mut line).unwrap(); // by now Ctrl-C is waited for
    assert!(line.starts_with("measuring "), "{line}");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let mut said = String::new();
    errors.read_to_string(&mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    assert!(said.contains("interrupted"), "{said}");
}
