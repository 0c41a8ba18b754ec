//! Tests of the templates in C++ and in Python: their points and those of their solutions, their
//! texts beside that of the Rust template, and the three calls of the protocol.
//!
//! After a change of a given file in `student_template/cpp` or `student_template/python`,
//! `BLESS=1 cargo test -p tests --test languages` copies it to the solution.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use cases::film;
use cases::probe::Reply;
use cases::scene::{self, Scene};
use grader::functions::{FUNCTIONS, Function};
use grader::grade::{Bench, Silent};
use grader::record::{FindingKind, Record, Verdict};
use grader::submission::{Language, Template};
use tempfile::TempDir;
use tests::{grade_all, public_stages, tracked, workspace};

/// A template beside the one in Rust.
struct Handout {
    language: Language,
    name: &'static str,
    /// The code before and behind the message in the body of a function that is still to be
    /// written.
    todo: (&'static str, &'static str),
    /// The command that runs the program, in its folder.
    command: &'static [&'static str],
}

const CPP: Handout = Handout {
    language: Language::Cpp,
    name: "cpp",
    todo: ("    todo(\"", "\");"),
    command: &["./tracer"],
};

const PYTHON: Handout = Handout {
    language: Language::Python,
    name: "python",
    todo: ("    raise NotImplementedError(\"", "\")"),
    command: &["python3", "-B", "main.py"],
};

const ALL: [&Handout; 2] = [&CPP, &PYTHON];

impl Handout {
    fn template(&self) -> String {
        format!("student_template/{}", self.name)
    }

    fn solution(&self) -> String {
        format!("tests/solution_{}", self.name)
    }
}

fn text(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

/// Returns the tracked files of a folder, relative to it.
fn files(folder: &str) -> BTreeSet<String> {
    let prefix = format!("{folder}/");
    tracked().iter().filter_map(|path| path.strip_prefix(&prefix).map(str::to_owned)).collect()
}

/// Returns the stems of the files that students write, such as `sphere`.
fn stems() -> BTreeSet<String> {
    let paths = Template::carried().student.into_keys();
    paths.map(|path| path.trim_start_matches("src/").trim_end_matches(".rs").to_owned()).collect()
}

/// Returns the messages of the functions in a file of the Rust template that are still to be
/// written, such as `reflect [rule 7]: src/reflection.rs`.
fn messages(stem: &str) -> Vec<String> {
    let source = &Template::carried().student[&Language::Rust.path(stem)];
    let messages = source.split("todo!(\"").skip(1).filter_map(|rest| rest.split('"').next());
    messages.map(str::to_owned).collect()
}

/// Returns the contract and the signature of the function of that name.
fn contract(language: Language, source: &str, name: &str) -> String {
    let lines: Vec<&str> = source.lines().collect();
    let is_named =
        |line: &str| !line.starts_with([' ', '/']) && line.contains(&format!(" {name}("));
    let at = lines.iter().position(|line| is_named(line));
    let at = at.unwrap_or_else(|| panic!("there is no function {name}"));
    let (start, end) = match language {
        Language::Python => {
            let is_last = |n: &usize| lines[*n].trim_end().ends_with("\"\"\"");
            let opens_and_goes_on = !lines[at + 1].trim_start()[3..].contains("\"\"\"");
            (at, (at + 1 + usize::from(opens_and_goes_on)..lines.len()).find(is_last))
        }
        _ => {
            let start = (0..at).rev().take_while(|n| lines[*n].starts_with("//")).last();
            (start.expect("a comment"), (at..lines.len()).find(|n| lines[*n].ends_with(") {")))
        }
    };
    lines[start..=end.expect("an end")].join("\n")
}

#[test]
fn a_template_is_its_solution_without_the_bodies() {
    for handout in ALL {
        let (template, solution) = (handout.template(), handout.solution());
        let students: BTreeSet<String> =
            stems().iter().map(|stem| handout.language.path(stem)).collect();
        let mut given = files(&template);
        assert!(given.remove("README.md"), "{template} has no README.md");
        assert_eq!(given, files(&solution), "the files of {template} and {solution}");
        for file in given.difference(&students) {
            let (from, to) = (format!("{template}/{file}"), format!("{solution}/{file}"));
            if std::env::var_os("BLESS").is_some() {
                fs::write(workspace().join(&to), text(&from)).expect("a given file");
            }
            assert_eq!(text(&from), text(&to), "{from} and {to} differ");
        }
        for stem in stems() {
            let file = handout.language.path(&stem);
            let handed_out = text(&format!("{template}/{file}"));
            let solved = text(&format!("{solution}/{file}"));
            let (before, behind) = handout.todo;
            let messages = messages(&stem);
            assert_eq!(handed_out.matches(before).count(), messages.len(), "{template}/{file}");
            assert!(!solved.contains(before), "{solution}/{file} is not finished");
            for message in messages {
                let body = message.replace(&Language::Rust.path(&stem), &file);
                assert!(
                    handed_out.contains(&format!("{before}{body}{behind}\n")),
                    "{file}: {body}"
                );
                let name = message.split(' ').next().expect("a name");
                let contract = |source| contract(handout.language, source, name);
                assert_eq!(contract(&handed_out), contract(&solved), "{file}: {name}");
            }
        }
    }
}

#[test]
fn lines_have_at_most_100_columns() {
    for folder in ALL.iter().flat_map(|handout| [handout.template(), handout.solution()]) {
        for file in files(&folder).iter().filter(|file| !file.ends_with(".md")) {
            let path = format!("{folder}/{file}");
            let long = text(&path).lines().position(|line| line.chars().count() > 100);
            assert_eq!(long, None, "{path}, counted from 0");
        }
    }
}

/// Reports take the names and files of functions from this table.
#[test]
fn the_functions_that_reports_name_are_where_the_table_says() {
    for handout in ALL {
        for Function { name, stem, .. } in FUNCTIONS {
            let file = format!("{}/{}", handout.template(), handout.language.path(stem));
            assert!(text(&file).contains(&format!(" {name}(")), "{file} has no function {name}");
        }
    }
}

fn check_template(handout: &Handout) {
    let record = grade_all(&workspace().join(handout.template())).record;
    assert_eq!(record.build.verdict, Verdict::Pass, "{:?}", record.build);
    assert_eq!(record.score.earned, 0);
    let file = |stem| handout.language.path(stem);
    for check in record.stages.iter().flat_map(|stage| &stage.checks) {
        let finding = check.finding.as_ref().expect("a finding");
        assert_eq!(finding.kind, FindingKind::Todo, "{}: {finding:?}", check.id);
        let names_a_file = FUNCTIONS.iter().any(|one| finding.message.contains(&file(one.stem)));
        assert!(names_a_file, "{}: {}", check.id, finding.message);
    }
}

fn check_solution(handout: &Handout) {
    let record: Record = grade_all(&workspace().join(handout.solution())).record;
    assert_eq!(record.build.verdict, Verdict::Pass, "{:?}", record.build);
    let lost: Vec<_> = record
        .stages
        .iter()
        .flat_map(|stage| &stage.checks)
        .filter(|check| check.earned != check.possible)
        .map(|check| format!("{}: {:?}", check.id, check.finding))
        .collect();
    assert!(lost.is_empty(), "{}", lost.join("\n"));
    assert_eq!((record.score.earned, record.stages.len()), (record.score.possible, 6));
}

#[test]
fn the_untouched_template_in_cpp_scores_nothing_and_crashes_nowhere() {
    check_template(&CPP);
}

#[test]
fn the_untouched_template_in_python_scores_nothing_and_crashes_nowhere() {
    check_template(&PYTHON);
}

#[test]
fn the_solution_in_cpp_earns_everything() {
    check_solution(&CPP);
}

#[test]
fn the_solution_in_python_earns_everything() {
    check_solution(&PYTHON);
}

/// Returns a copy of a folder. Sources in C++ are compiled in it, and must give no warning.
fn built(folder: &str) -> TempDir {
    let copy = tempfile::tempdir().expect("a temporary folder");
    for file in files(folder) {
        let to = copy.path().join(&file);
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(workspace().join(folder).join(&file), to).expect("a tracked file");
    }
    if copy.path().join("Makefile").is_file() {
        let make = Command::new("make")
            .args(["-j2", "CXXFLAGS=-O0 -Werror"])
            .current_dir(copy.path())
            .output()
            .expect("make");
        assert!(make.status.success(), "{folder}:\n{}", String::from_utf8_lossy(&make.stderr));
    }
    copy
}

#[test]
fn the_template_in_cpp_compiles_without_a_warning() {
    assert!(built(&CPP.template()).path().join("tracer").is_file());
}

/// A program that was built, in its folder.
struct Program<'a> {
    handout: &'a Handout,
    folder: TempDir,
}

impl Program<'_> {
    fn call(&self, args: &[&str], input: &str) -> Output {
        let mut child = Command::new(self.handout.command[0])
            .args(&self.handout.command[1..])
            .args(args)
            .current_dir(self.folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        // A program that refuses the first line does not read the rest.
        let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
        child.wait_with_output().expect("the program ends")
    }

    /// Writes the scene to a file in the folder, and returns its name.
    fn scene(&self, scene: &Scene) -> &'static str {
        fs::write(self.folder.path().join("scene.json"), scene::json::to_string(scene))
            .expect("a scene");
        "scene.json"
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

/// Questions whose JSON is easy to misread, each with the reply.
const ODD: [(&str, &str); 4] = [
    (
        r#" { "fn" : "indices", "index":15E-1, "inside":false, "id":"a\u00e9\n\"\\\ud83d\ude00" } "#,
        r#"{"id":"aé\n\"\\😀","indices":{"eta_i":1.0003,"eta_t":1.5}}"#,
    ),
    (
        r#"{"id":"","fn":"attenuation","light":{"directional":{"direction":[0,-1,0],"colour":[1,1,1],"ambient":[0,0,0]}},"r":"inf"}"#,
        r#"{"id":"","value":1.0}"#,
    ),
    (
        r#"{"id":"b","fn":"to_light","light":{"directional":{"direction":[0,-1,0],"colour":[1,1,1],"ambient":[0,0,0]}},"point":[0,0,-0]}"#,
        r#"{"id":"b","to_light":{"direction":[0,1,0],"t":"inf"}}"#,
    ),
    (
        r#"{"id":"c","fn":"reflect","direction":[1e-300,-1,0.1],"normal":[0,1,0],"more":[{},[],null,true]}"#,
        r#"{"id":"c","vector":[1e-300,1,0.1]}"#,
    ),
];

/// Lines that are no questions.
const REFUSED: [&str; 9] = [
    "{",
    "[1,2]",
    r#"{"id":"a"}"#,
    r#"{"id":"a","fn":"fly"}"#,
    r#"{"id":"a","fn":"indices","inside":false,"index":01}"#,
    r#"{"id":"a","fn":"indices","inside":1,"index":1}"#,
    r#"{"id":"a","fn":"indices","inside":false,"index":1} {}"#,
    r#"{"id":"a","fn":"reflect","direction":[1,0],"normal":[0,1,0]}"#,
    r#"{"id":"a","fn":"reflect","direction":[1,0,0],"normal":[0,"\x",0]}"#,
];

fn check_probe(program: &Program) {
    let questions: String = ODD.iter().map(|(question, _)| format!("{question}\n\n")).collect();
    let output = program.call(&["probe"], &questions);
    assert!(output.status.success(), "{output:?}");
    let replies = String::from_utf8(output.stdout).expect("UTF-8");
    let read = |line: &str| serde_json::from_str::<Reply>(line).expect("a reply");
    assert_eq!(
        replies.lines().map(read).collect::<Vec<_>>(),
        ODD.map(|(_, reply)| read(reply)).to_vec()
    );
    let deep = "[".repeat(100_000);
    for line in REFUSED.iter().copied().chain([deep.as_str()]) {
        let output = program.call(&["probe"], &format!("{line}\n"));
        assert_eq!(output.status.code(), Some(2), "{line}: {output:?}");
        assert_eq!(output.stdout, b"", "{line}");
    }
    for args in [&[][..], &["fly"], &["render", "none.json", "out.png"], &["render", "none.json"]] {
        assert_eq!(program.call(args, "").status.code(), Some(2), "{args:?}");
    }
}

/// Compares a picture as bytes with the same one as floats.
fn check_pictures(program: &Program, scene: &Scene) {
    let mut scene = scene.clone();
    (scene.render.width, scene.render.height) = (9, 5);
    let file = program.scene(&scene);
    let [bytes, floats] = ["out.png", "out.pfm"].map(|name| {
        let output = program.call(&["render", file, name], "");
        assert!(output.status.success(), "{name}: {output:?}");
        film::read_exact(&fs::read(program.path(name)).expect("a picture"), 9, 5).expect(name)
    });
    for (byte, float) in bytes.pixels().iter().zip(floats.pixels()) {
        for (byte, float) in byte.to_array().into_iter().zip(float.to_array()) {
            let levels = 255.0 * (byte - float.clamp(0.0, 1.0));
            assert!(levels.abs() < 0.501, "{byte} and {float}");
        }
    }
}

/// A pixel with several kinds of rays.
const PIXEL: (&str, [u32; 2]) = ("06_smooth_normals/soap", [70, 50]);

#[test]
fn programs_in_all_languages_answer_the_three_calls_alike() {
    let bench = Bench::open(&public_stages()).expect("the public exam");
    let (id, [x, y]) = PIXEL;
    let rust = &workspace().join("tests/solution");
    let expected = grader::grade::explain(&bench, rust, id, [x, y], &Silent)
        .expect("an explanation")
        .expect("a ray tree");
    assert!(expected.contains("refracted ray") && expected.contains("reflected ray"), "{expected}");
    let mut cases = bench.exam.stages.iter().flat_map(|questions| &questions.stage.cases);
    let scene = &cases.find(|case| case.id == id).expect("the case").scene;
    for handout in ALL {
        let program = Program { handout, folder: built(&handout.solution()) };
        check_probe(&program);
        check_pictures(&program, scene);
        let explain = |x: &str, y: &str| program.call(&["explain", program.scene(scene), x, y], "");
        let output = explain(&x.to_string(), &y.to_string());
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected, "{}", handout.name);
        for (x, y) in [("160", "0"), ("0", "120"), ("-1", "0"), ("a", "0")] {
            assert_eq!(explain(x, y).status.code(), Some(2), "{}: {x}, {y}", handout.name);
        }
        assert!(!program.path("tracer/__pycache__").exists(), "byte code was written");
    }
}
