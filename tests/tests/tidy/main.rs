//! Tests of the project's rules: ARCHITECTURE.md, "What never happens".

mod bans;

use std::collections::BTreeSet;
use std::path::Path;

use bans::BANS;
use tests::{code_lines, files, name, tracked, workspace};

/// Returns the names of our crates that `crate_folder/Cargo.toml` depends on, for builds and for
/// tests.
fn dependencies(crate_folder: &str) -> BTreeSet<String> {
    let text = std::fs::read_to_string(workspace().join(crate_folder).join("Cargo.toml"))
        .expect("a manifest");
    let manifest: toml::Table = text.parse().expect("TOML");
    let ours = [
        "cases",
        "reference",
        "student_template",
        "grader",
        "layers",
        "pages",
        "tests",
        "solution",
    ];
    ["dependencies", "dev-dependencies", "build-dependencies"]
        .iter()
        .filter_map(|table| manifest.get(*table)?.as_table())
        .flat_map(|table| table.keys().cloned())
        .filter(|dependency| ours.contains(&dependency.as_str()))
        .collect()
}

#[test]
fn crates_depend_only_on_allowed_crates() {
    for (crate_folder, may_know) in [
        ("cases", &[][..]),
        ("grader/pages", &[][..]),
        ("reference", &["cases", "pages"]),
        ("student_template", &["cases"]),
        ("tests/solution", &["cases"]),
        ("grader/layers", &["cases"]),
        ("grader", &["cases", "layers", "pages"]),
    ] {
        let knows = dependencies(crate_folder);
        assert!(
            knows.iter().all(|d| may_know.contains(&d.as_str())),
            "{crate_folder} depends on {knows:?}"
        );
    }
    assert!(dependencies("tests").contains("reference"), "the search finds no dependency at all");
}

/// Files and folders, each with words that must not occur in its code.
const KEPT_APART: &[(&str, &[&str])] = &[
    ("reference/src/light", &["World", "Kernel", "nearest("]),
    ("reference/src/rays", &["Kernel", "nearest(", "aterial"]),
    ("reference/src/bvh", &["aterial", "Light", "Sphere", "Triangle", "Mesh"]),
    ("reference/src/numbers", &["aterial", "Light"]),
    ("grader/src/score.rs", &["film", "Image", "pixels"]),
];

#[test]
fn formulas_cast_no_rays_and_trees_know_no_materials() {
    for (start, words) in KEPT_APART {
        let folder = start.split('/').next().expect("a path");
        let sources: Vec<_> =
            files(folder, "rs").into_iter().filter(|path| name(path).starts_with(start)).collect();
        assert!(!sources.is_empty(), "{start} is no source file and no folder of them");
        for path in sources {
            for (number, line) in code_lines(&path) {
                let found = words.iter().find(|word| line.contains(**word));
                assert_eq!(found, None, "{}:{number}", name(&path));
            }
        }
    }
}

#[test]
fn light_becomes_bytes_in_one_place() {
    for folder in
        ["cases/src", "reference/src", "grader/src", "student_template/src", "tests/solution/src"]
    {
        for path in
            files(folder, "rs").iter().filter(|path| name(path) != "cases/src/film/encode.rs")
        {
            for (number, line) in code_lines(path) {
                let found = ["* 255", "255.0 *", "* 65535", "65535.0 *", "as u8;"]
                    .iter()
                    .find(|word| line.contains(**word));
                assert_eq!(found, None, "{}:{number}", name(path));
            }
        }
    }
}

/// Calls that create, fill or move a file. One module makes them for every file that others read.
const WRITES: &[&str] = &["fs::write", "File::create", "fs::rename", "fs::copy", ".persist("];

/// Other files with such calls, each with its reason.
const WRITERS: &[(&str, &str)] = &[
    ("cases/src/files/write.rs", "the module that exists for it"),
    ("reference/src/vary/folder.rs", "moves a folder that is whole to its place"),
    ("grader/src/files.rs", "moves a folder that is whole to its place"),
    ("grader/src/batch/store.rs", "gives a published report a second name"),
    ("grader/src/build/rustc.rs", "fills a folder before it is published"),
    ("grader/src/build/sdk.rs", "fills a folder before it is published"),
    ("grader/src/exercise/explain.rs", "fills a folder of one run"),
    ("grader/src/exercise/pictures.rs", "fills a folder of one run"),
    ("grader/src/leftovers.rs", "marks a temporary folder"),
    ("grader/src/sandbox/launcher/nanny.rs", "tells the kernel who a user is in a namespace"),
    ("grader/src/sandbox/launcher/root.rs", "makes the root folder of a program, in memory"),
    ("grader/src/sandbox/place.rs", "fills a folder of one run"),
    ("grader/src/submission/archive/unpacking.rs", "unpacks into a fresh folder"),
];

#[test]
fn files_are_written_in_one_place() {
    let mut found = BTreeSet::new();
    for folder in ["cases/src", "reference/src", "grader/src"] {
        let is_test = |path: &Path| path.ends_with("tests.rs") || name(path).contains("/tests/");
        for path in files(folder, "rs").iter().filter(|path| !is_test(path)) {
            let writes =
                |(_, line): &(usize, String)| WRITES.iter().any(|word| line.contains(word));
            if code_lines(path).iter().any(writes) {
                found.insert(name(path));
            }
        }
    }
    let listed: BTreeSet<String> = WRITERS.iter().map(|(file, _)| (*file).to_owned()).collect();
    assert_eq!(
        found, listed,
        "use `cases::files::write`; a file that needs no exception any more leaves the list"
    );
}

/// Public functions whose error is text, each with the reason.
const TEXT_ERRORS: &[(&str, &str)] = &[
    ("explain in grader/src/exercise/explain.rs", "says to the student why there is no ray tree"),
    ("explain in grader/src/grade/mod.rs", "says to the student why there is no ray tree"),
    ("man in grader/pages/src/shell.rs", "names the page that does not exist"),
];

/// Returns the public functions of the file that return a text as their error.
fn text_errors(path: &std::path::Path) -> Vec<String> {
    let lines: Vec<String> = code_lines(path).into_iter().map(|(_, line)| line).collect();
    let starts = (0..lines.len()).filter(|n| lines[*n].trim_start().starts_with("pub fn "));
    starts
        .filter_map(|n| {
            let signature = lines[n..].join(" ");
            let (call, result) = signature.split('{').next()?.split_once("->")?;
            let name = call.trim().strip_prefix("pub fn ")?.split(['(', '<']).next()?;
            let is_text = result.contains("Result<") && result.contains(", String>");
            is_text.then(|| format!("{name} in {}", self::name(path)))
        })
        .collect()
}

#[test]
fn errors_of_public_functions_are_types() {
    let mut found = BTreeSet::new();
    for folder in
        ["cases/src", "reference/src", "grader/src", "grader/layers/src", "grader/pages/src"]
    {
        found.extend(files(folder, "rs").iter().flat_map(|path| text_errors(path)));
    }
    let listed: BTreeSet<String> = TEXT_ERRORS.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(found, listed, "give the error a type that keeps its cause as its source");
}

/// The only files with unsafe code.
const UNSAFE: &[&str] =
    &["reference/src/lanes.rs", "grader/src/sandbox/sys.rs", "tests/src/performance/child.rs"];

#[test]
fn unsafe_code_stands_in_the_files_listed() {
    let is_unsafe = |path: &std::path::PathBuf| {
        code_lines(path).iter().any(|(_, line)| line.contains("allow(unsafe_code"))
    };
    let mut found: Vec<String> = Vec::new();
    for folder in
        ["cases", "reference", "student_template", "grader", "tests/src", "tests/solution"]
    {
        found.extend(
            files(folder, "rs").iter().filter(|path| is_unsafe(path)).map(|path| name(path)),
        );
    }
    assert_eq!(found, UNSAFE);
}

#[test]
fn what_is_banned_stands_nowhere() {
    let mut broken = Vec::new();
    for ban in BANS {
        let sources = files(ban.folder, "rs");
        assert!(!sources.is_empty(), "{} holds no source file", ban.folder);
        for path in sources
            .iter()
            .filter(|path| !ban.except.iter().any(|start| name(path).starts_with(start)))
        {
            for (number, line) in code_lines(path) {
                broken.extend(
                    ban.words
                        .iter()
                        .filter(|word| line.contains(**word))
                        .map(|word| format!("{}:{number}: `{word}`: {}", name(path), ban.because)),
                );
            }
        }
    }
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

#[test]
fn exceptions_name_files_that_exist() {
    for start in BANS.iter().flat_map(|ban| ban.except) {
        let folder = start.split('/').next().expect("a path");
        assert!(
            files(folder, "rs").iter().any(|path| name(path).starts_with(start)),
            "{start} excuses nothing"
        );
    }
}

#[test]
fn every_rule_is_cited_in_the_reference_and_in_the_solution() {
    for folder in ["reference/src", "tests/solution/src"] {
        let text: String = files(folder, "rs")
            .iter()
            .map(|path| std::fs::read_to_string(path).expect("a source file"))
            .collect();
        for rule in 1..=21 {
            assert!(text.contains(&format!("[rule {rule}]")), "{folder} never cites [rule {rule}]");
        }
    }
}

const MOST_LINES: usize = 400;

/// Longer files, each with its reason.
const LONGER: &[(&str, &str)] =
    &[("cases/src/scene/raw/read.rs", "one reader, a few lines for every kind of value")];

#[test]
fn source_files_open_with_what_they_are_and_stay_small() {
    for folder in ["cases", "reference", "grader", "tests/src", "tests/tests"] {
        for path in files(folder, "rs") {
            let text = std::fs::read_to_string(&path).expect("a source file");
            assert!(text.starts_with("//! "), "{} does not open with `//!`", name(&path));
            let n_lines = text.lines().count();
            let has_reason = LONGER.iter().any(|(file, _)| *file == name(&path));
            assert_eq!(
                n_lines > MOST_LINES,
                has_reason,
                "{} has {n_lines} lines: split the file, or list it with a reason",
                name(&path)
            );
        }
    }
}

#[test]
fn no_test_is_skipped() {
    for folder in ["cases", "reference", "grader", "tests", "student_template"] {
        for path in files(folder, "rs") {
            for (number, line) in code_lines(&path) {
                assert!(
                    !line.trim().starts_with("#[ignore"),
                    "{}:{number} skips a test",
                    name(&path)
                );
            }
        }
    }
}

#[test]
fn answers_are_small_in_the_mean() {
    const MEAN_BYTES: usize = 150_000;
    let sizes: Vec<usize> = files("cases/stages", "exr")
        .iter()
        .map(|path| std::fs::read(path).expect("an answer").len())
        .collect();
    let mean = sizes.iter().sum::<usize>() / sizes.len();
    assert!(mean < MEAN_BYTES, "{} answers have {mean} bytes in the mean", sizes.len());
}

#[test]
fn tracked_files_are_small_and_name_no_machine() {
    const MOST_BYTES: u64 = 450_000;
    let places = ["/home/", "/Users/", "/tmp/wt", concat!("/ro", "ot/"), concat!("/wo", "rk/")];
    for path in tracked() {
        let full = workspace().join(&path);
        let Ok(bytes) = std::fs::read(&full) else { continue };
        assert!(bytes.len() as u64 <= MOST_BYTES, "{path} has {} bytes", bytes.len());
        let Ok(text) = String::from_utf8(bytes) else { continue };
        if path != "tests/tests/tidy/main.rs" {
            let found = places.iter().find(|place| text.contains(**place));
            assert_eq!(found, None, "{path} names a place on somebody's machine");
        }
    }
}
