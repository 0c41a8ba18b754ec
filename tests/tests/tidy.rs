//! The rules of the house, as tests: ARCHITECTURE.md, "What never happens".

use std::collections::BTreeSet;

use tests::{code_lines, files, name, tracked, workspace};

/// The names of our crates that `crate_folder/Cargo.toml` depends on, for builds and for tests.
fn dependencies(crate_folder: &str) -> BTreeSet<String> {
    let text = std::fs::read_to_string(workspace().join(crate_folder).join("Cargo.toml"))
        .expect("a manifest");
    let manifest: toml::Table = text.parse().expect("TOML");
    let ours = ["cases", "reference", "student_template", "grader", "pages", "tests", "solution"];
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
        ("grader/pages", &[][..]),
        ("reference", &["cases", "pages"]),
        ("student_template", &["cases"]),
        ("tests/solution", &["cases"]),
        ("grader", &["cases", "pages"]),
    ] {
        let knows = dependencies(crate_folder);
        assert!(
            knows.iter().all(|d| may_know.contains(&d.as_str())),
            "{crate_folder} depends on {knows:?}"
        );
    }
    assert!(dependencies("tests").contains("reference"), "the search finds no dependency at all");
}

/// A word that must not stand in the code below `folder`, except in files whose names begin as
/// listed.
struct Ban {
    folder: &'static str,
    words: &'static [&'static str],
    except: &'static [&'static str],
    because: &'static str,
}

const CLOCK: &[&str] =
    &["std::time", "Instant::", "SystemTime", "std::env", "env::var", "env::args"];
const FILES: &[&str] = &["std::fs", "File::", "fs::"];

/// Each of them panics where its reader has gone away, and prints what it is given unguarded.
const PRINTS: &[&str] =
    &["println!", "print!", "eprintln!", "eprint!", "io::stdout()", "io::stderr()"];
const PRINTS_BECAUSE: &str = "only `pages::say` prints: it guards text and outlives its reader";

const BANS: &[Ban] = &[
    Ban {
        folder: "grader/src",
        words: PRINTS,
        // A bar draws on the error stream by itself, where that is a terminal.
        except: &["grader/src/commands/compare.rs", "grader/src/progress.rs"],
        because: PRINTS_BECAUSE,
    },
    Ban { folder: "reference/src", words: PRINTS, except: &[], because: PRINTS_BECAUSE },
    Ban {
        folder: "grader/pages/src",
        words: CLOCK,
        // A bar shows the time that is left.
        except: &["grader/pages/src/bar.rs"],
        because: "what is printed depends on no clock and no environment",
    },
    Ban {
        folder: "grader/pages/src",
        words: FILES,
        except: &[],
        because: "what is printed is handed on; programs write files",
    },
    Ban {
        folder: "cases/src",
        words: CLOCK,
        except: &["cases/src/program.rs"],
        because: "only a main reads the clock or the environment",
    },
    Ban {
        folder: "cases/src",
        words: FILES,
        except: &[
            "cases/src/files",
            "cases/src/program.rs",
            "cases/src/scene/raw/objects.rs",
            "cases/src/stage/folder.rs",
        ],
        because: "files are read and written in the modules that exist for it",
    },
    Ban {
        folder: "reference/src",
        words: CLOCK,
        except: &["reference/src/cli/render.rs", "reference/src/cli/cost_session.rs"],
        because: "the tracer knows no clock; the commands around it do",
    },
    Ban {
        folder: "reference/src",
        words: FILES,
        except: &["reference/src/cli", "reference/src/vary/folder.rs"],
        because: "the tracer reads and writes no file; the commands around it do",
    },
    Ban {
        folder: "grader/src/sandbox",
        words: &[
            "cases::",
            "image::",
            "crate::judge",
            "crate::score",
            "crate::record",
            "crate::exam",
            "crate::grade",
        ],
        except: &[],
        because: "the sandbox knows nothing of cases, images or scores",
    },
    Ban {
        folder: "grader/src",
        words: &["pixel", "Image", "film::"],
        except: &[
            "grader/src/arguments.rs",
            "grader/src/commands",
            "grader/src/diagnose",
            "grader/src/exam",
            "grader/src/exercise",
            "grader/src/grade",
            "grader/src/judge",
            "grader/src/lint",
            "grader/src/main.rs",
            "grader/src/record.rs",
            "grader/src/report",
        ],
        because: "scores, batches, builds and the sandbox never see pixels",
    },
    Ban {
        folder: "grader/src",
        words: &["sandbox::run("],
        except: &[
            "grader/src/build/own.rs",
            "grader/src/build/rustc.rs",
            "grader/src/exercise/attempt.rs",
        ],
        because: "a failure counts only after `sandbox::blame` has looked at the machine, as \
            these do",
    },
    Ban {
        folder: "grader/src/report",
        words: &[
            "crate::judge",
            "crate::score",
            "crate::sandbox",
            "crate::build",
            "crate::exercise",
        ],
        except: &[],
        because: "a report decides nothing",
    },
    Ban {
        folder: "grader/src",
        words: &["answers_to_string", ".encode()"],
        except: &[],
        because: "only `reference expect` writes answers",
    },
    Ban {
        folder: "reference/src/shapes",
        words: &["aterial", "Light", "trace", ".sqrt()"],
        except: &[],
        because: "shapes know no materials and no light, and leave quadratics to `roots`",
    },
    Ban {
        folder: "reference/src",
        words: &["t_min"],
        except: &["reference/src/ray.rs", "reference/src/bvh/slab.rs"],
        because: "only `ray` says where an interval begins and ends; boxes only prune",
    },
];

/// Files, each with words that must not stand in its code.
const KEPT_APART: &[(&str, &[&str])] = &[
    ("reference/src/shade.rs", &["World", "Kernel", "nearest("]),
    ("reference/src/lights.rs", &["World", "Kernel", "nearest("]),
    ("reference/src/optics.rs", &["World", "Kernel", "nearest("]),
    ("reference/src/camera.rs", &["World", "Kernel", "nearest("]),
    ("reference/src/bvh/mod.rs", &["aterial", "Light"]),
    ("reference/src/bvh/build.rs", &["aterial", "Light"]),
    ("reference/src/bounds.rs", &["aterial", "Light"]),
    ("grader/src/score.rs", &["film", "Image", "pixels"]),
];

#[test]
fn formulas_cast_no_rays_and_trees_know_no_materials() {
    for (file, words) in KEPT_APART {
        for (number, line) in code_lines(&workspace().join(file)) {
            let found = words.iter().find(|word| line.contains(**word));
            assert_eq!(found, None, "{file}:{number}");
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

/// These calls create, fill or move a file. One module makes them for every file that others read.
const WRITES: &[&str] = &["fs::write", "File::create", "fs::rename", "fs::copy", ".persist("];

/// These files make such a call too, each for a reason.
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
    ("grader/src/sandbox/place.rs", "fills a folder of one run"),
    ("grader/src/submission/archive/unpacking.rs", "unpacks into a fresh folder"),
];

#[test]
fn files_are_written_in_one_place() {
    let mut found = BTreeSet::new();
    for folder in ["cases/src", "reference/src", "grader/src"] {
        for path in files(folder, "rs").iter().filter(|path| !path.ends_with("tests.rs")) {
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

/// The only files with code that the compiler cannot prove sound.
const UNSAFE: &[&str] =
    &["reference/src/bvh/lanes.rs", "grader/src/sandbox/sys.rs", "tests/src/performance/child.rs"];

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
                "{} has {n_lines} lines: one story, or a reason?",
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
        if path != "tests/tests/tidy.rs" {
            let found = places.iter().find(|place| text.contains(**place));
            assert_eq!(found, None, "{path} names a place on somebody's machine");
        }
    }
}
