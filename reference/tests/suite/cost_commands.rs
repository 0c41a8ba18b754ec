//! Tests of `reference cost` from outside: tables, files, exit codes. No test depends on a measured
//! time.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::cost::{SCENE, well_formed};

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_reference")).current_dir(folder).args(args).output().unwrap()
}

fn check(folder: &Path, args: &[&str], code: i32, said: &str) -> Output {
    let output = run(folder, &[&["cost"], args].concat());
    let (out, err) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
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
    let table = check(folder.path(), &[&short[..], &files].concat(), 0, "without advice");
    assert!(!table.stdout.contains(&0x1b), "no colours without a terminal");
    for (file, begins) in [
        ("a.json", "{"),
        ("a.csv", "scene,width"),
        ("a.svg", "<svg "),
        ("a.html", "<!DOCTYPE html>"),
    ] {
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
    let twice = ["scene.toml", "--samples", "1", "--rounds", "2", "--html", "-"];
    let page = String::from_utf8(check(folder.path(), &twice, 0, "").stdout).unwrap();
    assert!(!page.contains("without advice") && page.contains("class=\"answer\""), "{page}");
    for (at, id) in page.match_indices("<a href=\"#") {
        let id = page[at + id.len()..].split('"').next().unwrap();
        assert!(page.contains(&format!("<figure id=\"{id}\"><img src=\"data:image/png;")), "{id}");
    }
    assert!(page.contains("<a href=\"#sampling-"), "points link to pictures of errors");
    check(folder.path(), &["scene.toml", "--json", "-", "--csv", "-"], 2, "only one of");
    check(folder.path(), &["scene.toml", "--formulas", "naive"], 2, "plain, stable or robust");
    check(folder.path(), &["scene.toml", "--thresholds", "2"], 2, "from 0 to 1");
    check(folder.path(), &["none.toml"], 2, "there is no file");
    check(
        folder.path(),
        &[&short[..], &["--svg", "no/such/folder.svg"]].concat(),
        2,
        "there is no folder `no/such`",
    );
    check(folder.path(), &[&short[..], &["--csv", "."]].concat(), 2, "it is a folder");
    check(
        folder.path(),
        &[&short[..], &["--csv", "/dev/full"]].concat(),
        3,
        "cannot write /dev/full: No space left",
    );
    check(folder.path(), &["--page", "-"], 2, "name a file");
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
            row["function"] == function
                && row["formula"] == formula
                && row["precision"] == precision
        };
        rows.iter().find(is_it).unwrap_or_else(|| panic!("{function}, {formula}, {precision}"))
    };
    let [robust, textbook] =
        ["robust", "textbook quadratic"].map(|formula| of("sphere", formula, "f64"));
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
    let digits = |formula, precision| of("sphere", formula, precision)["digits"].as_f64().unwrap();
    assert!(digits("robust", "f64") > 12.0 && (4.0..9.0).contains(&digits("robust", "f32")));
    let text = at("f.csv");
    let mut lines = ::csv::Reader::from_reader(text.as_bytes());
    let n_families: usize = rows.iter().map(|row| row["families"].as_array().unwrap().len()).sum();
    assert_eq!(lines.records().map(Result::unwrap).count(), n_families);
    well_formed(&at("f.svg"));
    assert!(at("f.html").contains("<figure><svg") && !at("f.html").contains("<script"));
    check(folder.path(), &["--functions", "scene.toml"], 2, "cannot be used with");
    check(folder.path(), &["--functions", "--samples", "2"], 2, "cannot be used with");
    let narrow = [
        "--functions",
        "--draws",
        "5",
        "--rounds",
        "1",
        "--formulas",
        "robust",
        "--precisions",
        "f64",
        "--csv",
        "-",
    ];
    let csv = String::from_utf8(check(folder.path(), &narrow, 0, "").stdout).unwrap();
    assert!(csv.contains("robust,f64"), "{csv}");
    assert!(!csv.contains("f32") && !csv.contains("textbook"), "{csv}");
    check(folder.path(), &[], 2, "required");
}

#[test]
fn the_page_of_the_documentation_is_made_of_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = folder.path().join("accuracy.md");
    let short =
        ["--samples", "1", "--rounds", "1", "--draws", "10", "--depths", "0,2", "--size", "16x12"];
    check(&workspace, &[&["--page", page.to_str().unwrap()][..], &short].concat(), 0, "wrote");
    let text = std::fs::read_to_string(&page).unwrap();
    let mut n_pictures = 0;
    for (_, target) in text
        .match_indices("](")
        .map(|(at, _)| text[at + 2..].split_once(')').unwrap())
        .map(|(t, _)| ((), t))
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
        assert!(
            n.is_none() || n_columns.is_none() || n == n_columns,
            "a row has another number of cells: {line}"
        );
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
    std::fs::write(
        stage.join("stage.toml"),
        format!("{head}allows = [\"shadows\", \"reflection\"]\n"),
    )
    .unwrap();
    let head = "title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n";
    std::fs::write(stage.join("ball.toml"), format!("{head}{SCENE}")).unwrap();
    let write = |path: &str, text: &str| {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    check(folder.path(), &["--check"], 2, "no sources of the reference");
    write("reference/src/lib.rs", "old");
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
    let digest = fronts.measured_on.unwrap();
    write("docs/accuracy.md", &format!("Code and cases: `{digest}`. More."));
    let checked = |said: &str| check(folder.path(), &["--check"], 0, said);
    checked("cases/stages/fronts.json: up to date");
    checked("docs/accuracy.md: up to date");
    checked("docs/performance.md: STALE, since it is missing or has no digest");
    write("reference/src/lib.rs", "new");
    checked(&format!("docs/accuracy.md: STALE, measured on {digest}, but the code and cases are "));
    checked("cases/stages/fronts.json: STALE, measured on ");
    write("cases/stages/fronts.json", "{}");
    check(folder.path(), &["--check"], 2, "fronts.json: ");
}

#[cfg(unix)]
#[test]
fn an_interrupted_measurement_ends_with_130() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_reference"))
        .current_dir(folder.path())
        .args([
            "cost",
            "scene.toml",
            "--rounds",
            "1000",
            "--size",
            "256x192",
            "--no-effects",
            "--verbose",
        ])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    errors.read_line(&mut line).unwrap(); // From here on the program handles Ctrl-C.
    assert!(line.starts_with("measuring "), "{line}");
    assert!(
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success()
    );
    let mut said = String::new();
    errors.read_to_string(&mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    assert!(said.contains("interrupted"), "{said}");
}
