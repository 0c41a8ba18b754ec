//! The words that are banned from the code of a folder, each with its reason.

/// Words that must not occur in the code below `folder`, except in files with names that begin as
/// listed.
pub(super) struct Ban {
    pub(super) folder: &'static str,
    pub(super) words: &'static [&'static str],
    pub(super) except: &'static [&'static str],
    pub(super) because: &'static str,
}

const CLOCK: &[&str] =
    &["std::time", "Instant::", "SystemTime", "std::env", "env::var", "env::args"];
const FILES: &[&str] = &["std::fs", "File::", "fs::"];

/// Each of these macros and calls panics or fails if its reader is gone, and prints its argument
/// unguarded.
const PRINTS: &[&str] =
    &["println!", "print!", "eprintln!", "eprint!", "io::stdout()", "io::stderr()"];
const PRINTS_BECAUSE: &str = "only `pages::say` prints: it guards text and outlives its reader";

pub(super) const BANS: &[Ban] = &[
    Ban {
        folder: "grader/src",
        words: PRINTS,
        // A progress bar draws on the error stream by itself if that is a terminal.
        except: &["grader/src/cli/commands/compare.rs", "grader/src/cli/progress.rs"],
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
        because: "what is printed is passed on; programs write files",
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
        folder: "grader/src",
        words: &["Instant::", "SystemTime", "std::env", "env::"],
        except: &[
            "grader/src/cli/arguments",
            "grader/src/build/own.rs",
            "grader/src/build/workshop.rs",
            "grader/src/cli/commands/doctor.rs",
            "grader/src/sandbox",
            "grader/src/submission/error.rs",
            "grader/src/tracer.rs",
        ],
        because: "only what runs programs reads the clock, and only what finds folders the \
            environment",
    },
    Ban {
        folder: "grader/src",
        words: FILES,
        except: &[
            "grader/src/cli/arguments/tests.rs",
            "grader/src/batch",
            "grader/src/build",
            "grader/src/cli/commands",
            "grader/src/exercise",
            "grader/src/files.rs",
            "grader/src/grade/tests.rs",
            "grader/src/input.rs",
            "grader/src/leftovers",
            "grader/src/report/html/tests.rs",
            "grader/src/sandbox",
            "grader/src/submission",
        ],
        because: "judges, scores and reports read and write no file",
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
            "grader/src/cli",
            "grader/src/diagnose",
            "grader/src/exam",
            "grader/src/exercise",
            "grader/src/grade",
            "grader/src/judge",
            "grader/src/lint",
            "grader/src/record.rs",
            "grader/src/report",
            "grader/src/tracer.rs",
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
        except: &["reference/src/rays/ray.rs", "reference/src/bvh/slab.rs"],
        because: "only `ray` says where an interval begins and ends; boxes only prune",
    },
];
