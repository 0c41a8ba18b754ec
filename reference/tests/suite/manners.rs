//! Tests of the program from outside: the exit codes that `--help` promises, streams whose reader
//! is gone, scenes on standard input.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCENE: &str = "[render]\nsize = [8, 6]\nmax_depth = 1\n[scene.camera]\neye = [0, 0, 4]\n\
    look_at = [0, 0, 0]\n\
    up = [0, 1, 0]\nfov_y_deg = 40\n[scene.materials]\nm = { kd = [0.5, 0.5, 0.5] }\n\
    [[scene.lights]]\n\
    directional = { direction = [0, 0, -1], colour = [1, 1, 1] }\n[[scene.objects]]\nsquare = {}\n\
    material = \"m\"\n";

/// Returns a folder with scenes, courses, and the stage `stages/01_one`, which has a case without
/// its answer.
fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = place.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let stage = "title = \"One\"\nabout = \"a\"\nallows = []\nneeds = []\nunit_points = 0\n";
    let case = format!("title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n{SCENE}");
    write("scene.toml", SCENE);
    write("mirror.toml", &SCENE.replace("kd =", "kr = [1, 1, 1], kd ="));
    write("bad.toml", &SCENE.replace("fov_y_deg", "fov"));
    write("course.toml", "index_of_air = 1.0\n");
    write("bad_course.toml", "index_of_air = 2\n");
    write("stages/01_one/stage.toml", stage);
    write("stages/01_one/card.toml", &case);
    write("file", "");
    place
}

fn call(place: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_reference"));
    command.current_dir(place).args(args).env("NO_COLOR", "1");
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn run(place: &Path, args: &[&str], input: &str) -> Output {
    let mut child = call(place, args).spawn().unwrap();
    // A program that reads nothing may have ended.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// The calls, in order, each with its exit code and a part of what it prints.
const CALLS: &[(&str, i32, &str)] = &[
    ("render scene.toml a.png", 0, ""),
    ("render missing.toml a.png", 2, "there is no file `missing.toml`"),
    ("render bad.toml a.png", 2, "bad.toml:8:1"),
    ("render scene.toml", 2, "required"),
    (
        "render scene.toml unwritten.png --max-rays 47",
        1,
        "more than 47 rays, the limit of --max-rays",
    ),
    ("effects scene.toml", 0, "shadows"),
    ("effects scene.toml --max-rays 1", 0, "not called for: no object's material has kr > 0"),
    ("effects --page x.md", 2, "no file `docs/showcase.toml`"),
    ("effects scene.toml --measure --rounds 1", 0, "pixels changed"),
    ("effects scene.toml --rounds 1", 2, "--measure"),
    ("effects bad.toml", 2, "bad.toml"),
    ("cost scene.toml --rounds 1 --samples 1 --precisions f32 --no-effects", 0, "f32"),
    ("cost bad.toml", 2, "bad.toml"),
    ("explain scene.toml 4 3", 0, "eye ray"),
    ("explain mirror.toml 4 3 --max-rays 1", 1, "more than 1 rays, the limit of --max-rays"),
    ("explain scene.toml 8 3", 2, "pixel (8, 3)"),
    ("probe", 0, ""),
    ("probe --course bad_course.toml", 2, "bad_course.toml"),
    ("expect stages --check", 1, "card.answer.exr is missing"),
    ("expect stages", 0, "written"),
    ("expect stages --check", 0, "as stored"),
    ("expect nowhere", 2, "no case, no stage"),
    ("course --course course.toml", 0, "# What this course decides"),
    ("course --course missing.toml", 2, "missing.toml"),
    ("vary stages", 2, "--seed"),
    ("vary nowhere --seed 1", 2, "nowhere"),
    ("schema", 0, "\"title\""),
    ("schema nothing", 2, "nothing"),
    ("completions bash", 0, "_reference"),
    ("completions", 2, ""),
    ("man", 0, "reference"),
    ("man render", 0, "picture"),
    ("man ./pages", 0, ""),
    ("man dance", 2, "there is no command `dance`"),
    ("man file/x", 2, "cannot write file/x"),
    ("--help", 0, "130  interrupted"),
    ("", 2, "Usage"),
    ("dance", 2, "unrecognized"),
];

#[test]
fn every_call_ends_as_help_says() {
    let place = place();
    for (line, code, part) in CALLS {
        let args: Vec<&str> = line.split_whitespace().collect();
        let output = run(place.path(), &args, "");
        let text = String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(*code), "reference {line}: {text}");
        assert!(text.contains(part), "reference {line}: no {part:?} in\n{text}");
    }
    assert!(place.path().join("pages/reference-man.1").is_file(), "a page is missing");
    assert!(
        !place.path().join("unwritten.png").exists(),
        "a picture was written in spite of its rays"
    );
}

#[test]
fn every_command_and_every_code_of_its_help_is_in_the_table() {
    let place = tempfile::tempdir().unwrap();
    // These need a disk that fails, or minutes.
    let excused = [
        ("render", 3),
        ("effects", 3),
        ("cost", 3),
        ("expect", 3),
        ("vary", 3),
        ("vary", 0),
        ("vary", 1),
    ];
    let help = String::from_utf8(run(place.path(), &["--help"], "").stdout).unwrap();
    let commands = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names: Vec<&str> =
        commands.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).collect();
    let names: Vec<&str> =
        names.into_iter().filter(|name| !name.is_empty() && *name != "help").collect();
    assert!(names.len() > 9, "{names:?}");
    for name in names {
        let help = String::from_utf8(run(place.path(), &[name, "--help"], "").stdout).unwrap();
        let promised = help
            .split("Exit codes:")
            .nth(1)
            .unwrap_or_else(|| panic!("{name} --help names no exit code"));
        let is_code = |word: &&str| ["0", "1", "2", "3"].contains(word);
        for code in
            promised.split_whitespace().filter(is_code).map(|code| code.parse::<i32>().unwrap())
        {
            let is_called = CALLS
                .iter()
                .any(|(call, ends, _)| call.split(' ').next() == Some(name) && *ends == code);
            let is_excused = excused.contains(&(name, code));
            assert!(
                is_called != is_excused,
                "{name} ends with {code}: there is no call, or a needless excuse"
            );
        }
    }
}

#[test]
fn no_output_panics_where_its_reader_has_gone() {
    let place = place();
    let table: [(&[&str], i32); 9] = [
        (&["completions", "fish"], 0),
        (&["man"], 0),
        (&["schema"], 0),
        (&["course", "--course", "course.toml"], 0),
        (&["effects", "scene.toml"], 0),
        (&["explain", "scene.toml", "4", "3"], 0),
        (&["render", "scene.toml", "-o", "-", "--stats"], 0),
        (&["render", "missing", "-o", "-"], 2),
        (
            &[
                "cost",
                "scene.toml",
                "--rounds",
                "1",
                "--samples",
                "1",
                "--precisions",
                "f32",
                "--no-effects",
            ],
            0,
        ),
    ];
    for (args, code) in table {
        let mut child = call(place.path(), args).spawn().unwrap();
        drop((child.stdin.take(), child.stdout.take(), child.stderr.take()));
        assert_eq!(child.wait().unwrap().code(), Some(code), "{args:?}");
    }
}

#[test]
fn a_full_disk_behind_the_output_stream_is_the_machines_failure() {
    let place = place();
    for args in [
        &["schema"][..],
        &["man"],
        &["effects", "scene.toml"],
        &["explain", "scene.toml", "4", "3"],
    ] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = call(place.path(), args).stdout(full).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {text}");
        assert!(text.contains("cannot write to the output stream"), "{args:?}: {text}");
    }
}

#[test]
fn a_scene_may_come_on_standard_input() {
    let place = place();
    let picture = |args: &[&str], input: &str| {
        let output = run(place.path(), &[&["render"], args, &["-o", "-"]].concat(), input);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{args:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        output.stdout
    };
    let expected = picture(&["scene.toml"], "");
    assert_eq!(picture(&["-"], SCENE), expected);
    assert_eq!(picture(&["-", "--max-depth", "0"], SCENE), expected, "the square reflects nothing");
    let explained = run(place.path(), &["explain", "-", "4", "3"], SCENE);
    assert!(String::from_utf8_lossy(&explained.stdout).starts_with("eye ray"), "{explained:?}");
    for (input, part) in
        [("", "standard input"), ("[render", "standard input"), ("{", "standard input:1")]
    {
        let output = run(place.path(), &["effects", "-"], input);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{input:?}: {text}");
        assert!(text.contains(part), "{input:?}: {text}");
    }
}
