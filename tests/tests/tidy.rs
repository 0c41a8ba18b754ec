//! The rules of the house, as tests: ARCHITECTURE.md, "What never happens".

use std::collections::BTreeSet;
use std::process::Command;

use tests::{code_lines, files, name, workspace};

/// The names of our crates that `crate_folder/Cargo.toml` depends on, for builds and for tests.
fn dependencies(crate_folder: &str) -> BTreeSet<String> {
    let text = std::fs::read_to_string(workspace().join(crate_folder).join("Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = text.parse().expect("TOML");
    let ours = ["cases", "reference", "student_template", "grader", "tests", "solution"];
    ["dependencies", "dev-dependencies", "build-dependencies"]
        .iter()
        .filter_map(|table| manifest.get(*table)?.as_table())
        .flat_map(|table| table.keys().cloned())
        .filter(|dependency| ours.contains(&dependency.as_str()))
        .collect()
}

#[test]
fn crates_know_only_whom_they_may() {
    for (crate_folder, may_know) in [
        ("cases", &[][..]),
        ("reference", &["cases"]),
        ("student_template", &["cases"]),
        ("tests/solution", &["cases"]),
        ("grader", &["cases"]),
    ] {
        let knows = dependencies(crate_folder);
        assert!(knows.iter().all(|d| may_know.contains(&d.as_str())), "{crate_folder} depends on {knows:?}");
    }
    assert!(dependencies("tests").contains("reference"), "the search finds no dependency at all");
}

/// A word that must not stand in the code below `folder`, except in files whose names begin as listed.
struct Ban {
    folder: &'static str,
    words: &'static [&'static str],
    except: &'static [&'static str],
    because: &'static str,
}

const BANS: &[Ban] = &[
    Ban {
        folder: "cases/src",
        words: &["std::time", "Instant::", "SystemTime", "std::env", "env::var", "env::args"],
        except: &["cases/src/program.rs"],
        because: "only a main reads the clock or the environment",
    },
    Ban {
        folder: "cases/src",
        words: &["std::fs", "File::", "fs::"],
        except: FILES_IN_CASES,
        because: "files are read and written in the modules that exist for it",
    },
    Ban {
        folder: "reference/src",
        words: &["std::time", "Instant::", "SystemTime", "std::env", "env::var", "env::args", "std::fs", "File::", "fs::"],
        except: SHELL_OF_REFERENCE,
        because: "the tracer does no input or output; the commands around it do",
    },
    Ban {
        folder: "grader/src/sandbox",
        words: &["cases::", "image::", "crate::judge", "crate::score", "crate::record", "crate::exam", "crate::grade"],
        except: &[],
        because: "the sandbox knows nothing of cases, images or scores",
    },
    Ban {
        folder: "grader/src",
        words: &["pixel", "Image", "film::"],
        except: &[
            "grader/src/judge",
            "grader/src/report",
            "grader/src/exercise",
            "grader/src/grade",
            "grader/src/exam",
            "grader/src/record",
            "grader/src/lint",
            "grader/src/compare",
            "grader/src/images",
            "grader/src/command",
            "grader/src/cli",
            "grader/src/main.rs",
        ],
        because: "scores, batches, builds and the sandbox never see pixels",
    },
    Ban {
        folder: "grader/src/report",
        words: &["crate::judge", "crate::score", "crate::sandbox", "crate::build"],
        except: &[],
        because: "a report decides nothing",
    },
    Ban {
        folder: "reference/src/shape",
        words: &["aterial", "Light", "trace("],
        except: &[],
        because: "shapes know no materials and no light",
    },
    Ban {
        folder: "grader/src",
        words: &["to_exr", "CheckAnswer {"],
        except: &[],
        because: "only `reference expect` writes answers",
    },
];

const FILES_IN_CASES: &[&str] = &["cases/src/film/files.rs", "cases/src/program.rs"];

const SHELL_OF_REFERENCE: &[&str] = &["reference/src/main.rs"];

#[test]
fn what_is_banned_stands_nowhere() {
    let mut broken = Vec::new();
    for ban in BANS {
        let sources = files(ban.folder, "rs");
        assert!(!sources.is_empty(), "{} holds no source file", ban.folder);
        for path in sources.iter().filter(|path| !ban.except.iter().any(|start| name(path).starts_with(start))) {
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
        assert!(files(folder, "rs").iter().any(|path| name(path).starts_with(start)), "{start} excuses nothing");
    }
}

#[test]
fn every_rule_is_cited_in_the_reference_and_in_the_solution() {
    for folder in ["reference/src", "tests/solution/src"] {
        let text: String =
            files(folder, "rs").iter().map(|path| std::fs::read_to_string(path).expect("a source file")).collect();
        for rule in 1..=21 {
            assert!(text.contains(&format!("[rule {rule}]")), "{folder} never cites [rule {rule}]");
        }
    }
}

#[test]
fn source_files_open_with_what_they_are_and_stay_small() {
    const MOST_LINES: usize = 400;
    for folder in ["cases", "reference", "grader", "tests/src", "tests/tests"] {
        for path in files(folder, "rs") {
            let text = std::fs::read_to_string(&path).expect("a source file");
            assert!(text.starts_with("//! "), "{} does not open with `//!`", name(&path));
            let n_lines = text.lines().count();
            assert!(n_lines <= MOST_LINES, "{} has {n_lines} lines: does it still tell one story?", name(&path));
        }
    }
}

#[test]
fn no_test_is_skipped() {
    for folder in ["cases", "reference", "grader", "tests", "student_template"] {
        for path in files(folder, "rs") {
            for (number, line) in code_lines(&path) {
                assert!(!line.trim().starts_with("#[ignore"), "{}:{number} skips a test", name(&path));
            }
        }
    }
}

/// The files that git tracks.
fn tracked() -> Vec<String> {
    let listed = Command::new("git").args(["ls-files", "-z"]).current_dir(workspace()).output().expect("git");
    assert!(listed.status.success(), "git cannot list the files");
    String::from_utf8_lossy(&listed.stdout).split('\0').filter(|path| !path.is_empty()).map(str::to_owned).collect()
}

#[test]
fn tracked_files_are_small_and_name_no_machine() {
    const MOST_BYTES: u64 = 400_000;
    let places = ["/home/", "/Users/", "/tmp/wt", concat!("/ro", "ot/"), concat!("/wo", "rk/")];
    for path in tracked() {
        let full = workspace().join(&path);
        let Ok(bytes) = std::fs::read(&full) else { continue };
        assert!(bytes.len() as u64 <= MOST_BYTES, "{path} has {} bytes", bytes.len());
        let Ok(text) = String::from_utf8(bytes) else { continue };
        if path != "tests/tests/tidy.rs" {
            let found = places.iter().find(|place| text.contains(**place));
            assert_eq!(found, None, "{path} names a place on somebody's machine");
        }
    }
}

#[test]
fn links_between_documents_lead_somewhere() {
    for path in tracked().into_iter().filter(|path| path.ends_with(".md")) {
        let full = workspace().join(&path);
        let text = std::fs::read_to_string(&full).expect("a tracked file");
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = target.split('#').next().unwrap_or_default();
            if !file.is_empty() && !file.contains("://") {
                assert!(full.with_file_name("").join(file).exists(), "{path} links to {target}, which is not there");
            }
        }
    }
}
