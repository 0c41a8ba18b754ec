//! Checks that no input makes `grader compare` wait for ever, and that a damaged file is an error
//! beside any other.

#[path = "shared/forms.rs"]
mod forms;
mod shared;

use std::fs::{self, File};
use std::os::unix::net::UnixListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use cases::film::{self, Image};
use cases::glam::DVec3;
use forms::Form;
use shared::{CASE, dark_exam};

/// A folder with pictures.
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a picture of 4 × 3 pixels of the same light. The name decides the format.
    fn put(&self, name: &str, light: f64) {
        self.put_sized(name, 4, light);
    }

    fn put_sized(&self, name: &str, width: u32, light: f64) {
        let image = Image::from_fn(width, 3, |_, _| DVec3::splat(light));
        let form = match name {
            _ if name.ends_with("16.png") => Form::DeepPng,
            _ if name.ends_with(".png") => Form::Png,
            _ if name.ends_with(".pfm") => Form::Pfm,
            _ => Form::Exr,
        };
        fs::write(self.at(name), form.bytes(&image)).unwrap();
    }

    /// Runs `grader compare` with these words, and with the file `input` as standard input.
    fn run(&self, words: &[&str], input: &str) -> Output {
        let mut command = Command::new("timeout");
        command
            .args(["100", env!("CARGO_BIN_EXE_grader"), "compare"])
            .args(words)
            .current_dir(self.0.path());
        command.stdin(File::open(self.at(input)).unwrap()).output().unwrap()
    }

    /// Checks the exit code, and a part of the text on either stream.
    fn check(&self, words: &[&str], code: i32, part: &str) {
        self.check_fed(words, "/dev/null", code, part);
    }

    fn check_fed(&self, words: &[&str], input: &str, code: i32, part: &str) {
        let output = self.run(words, input);
        let text = String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{words:?}: {text}");
        assert!(text.contains(part), "{words:?}: no {part:?} in\n{text}");
    }

    /// Checks both orders of the pictures.
    fn check_both(&self, a: &str, b: &str, tolerance: &str, code: i32, part: &str) {
        self.check(&[a, b, "--tolerance", tolerance], code, part);
        self.check(&[b, a, "--tolerance", tolerance], code, part);
    }
}

#[test]
fn pictures_are_compared() {
    let home = Home::new();
    for name in ["a.png", "a16.png", "a.pfm", "a.exr"] {
        home.put(name, 0.2);
    }
    home.put("b.png", 0.2 + 3.0 / 255.0);
    home.put("off16.png", 0.2 + 1.0 / 65535.0);
    home.put_sized("wide.png", 5, 0.2);
    fs::write(home.at("text.png"), "no picture").unwrap();
    home.check_both("a.png", "a.png", "0", 0, "they agree");
    home.check_both("a.png", "a16.png", "0", 0, "they agree");
    home.check_both("a.pfm", "a.exr", "0", 0, "they agree");
    home.check_both("a.png", "a.pfm", "0", 1, "by 7.60e-7 levels"); // f32 has no 0.2
    home.check_both("a.png", "a.pfm", "0.5", 0, "they agree");
    home.check_both("a.png", "b.png", "0", 1, "12 pixels of 12 differ");
    home.check_both("a.png", "b.png", "2.99", 1, "by 3 levels");
    home.check_both("a.png", "b.png", "3", 0, "they agree");
    home.check_both(
        "a.png",
        "off16.png",
        "0",
        1,
        "12 pixels of 12 differ, most at (0, 0) by 3.89e-3 levels",
    );
    home.check_both("a16.png", "off16.png", "0.0039", 0, "they agree");
    home.check(&["a.png", "b.png", "--tolerance", "nan"], 2, "from 0 to 255");
    home.check(&["a.png", "b.png", "--tolerance", "-1"], 2, "");
    home.check(&["a.png", "wide.png"], 2, "nothing to compare");
    home.check(&["a.png", "text.png"], 2, "not a PNG, PFM or EXR image");
    home.check(&["a.png", "missing.png"], 2, "missing.png: there is no such file");
    home.check(&["a.png"], 2, "required");
}

#[test]
fn light_counts_as_it_is_and_what_is_no_number_agrees_with_nothing() {
    let home = Home::new();
    for (name, light) in [("one", 1.0), ("two", 2.0), ("black", 0.0), ("below", -1.0)] {
        home.put(&format!("{name}.pfm"), light);
    }
    home.put("white.png", 1.0);
    home.put("nan.pfm", f64::NAN);
    home.put("infinite.exr", f64::INFINITY);
    home.check_both("one.pfm", "two.pfm", "254.9", 1, "by 255 levels");
    home.check_both("one.pfm", "two.pfm", "255", 0, "they agree");
    home.check_both("white.png", "two.pfm", "0", 1, "12 pixels of 12 differ");
    home.check_both("white.png", "one.pfm", "0", 0, "they agree");
    home.check_both("black.pfm", "below.pfm", "0", 1, "12 pixels of 12 differ");
    for other in ["black.pfm", "white.png", "nan.pfm", "infinite.exr"] {
        home.check_both(other, "nan.pfm", "255", 1, "12 of them hold NaN or infinity");
        home.check_both(other, "infinite.exr", "255", 1, "12 of them hold NaN or infinity");
    }
}

#[test]
fn a_damaged_file_is_an_error_whatever_stands_beside_it() {
    let home = Home::new();
    home.put("a.png", 0.2);
    home.put("a16.png", 0.2);
    home.put("a.pfm", 0.2);
    let whole = fs::read(home.at("a.png")).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() - 14] ^= 1; // in the CRC of the pixels
    fs::write(home.at("crc.png"), flipped).unwrap();
    fs::write(home.at("cut.png"), &whole[..whole.len() - 12]).unwrap();
    let float = fs::read(home.at("a.pfm")).unwrap();
    fs::write(home.at("long.pfm"), [&float[..], b"\n"].concat()).unwrap();
    for other in ["a.png", "a16.png", "a.pfm"] {
        home.check_both(
            "crc.png",
            other,
            "0",
            2,
            "crc.png: it cannot be decoded: the PNG is damaged: CRC error",
        );
        home.check_both(
            "cut.png",
            other,
            "0",
            2,
            "cut.png: it cannot be decoded: the PNG ends early",
        );
        home.check_both("long.pfm", other, "0", 2, "1 too many; the header is the likely cause");
    }
}

#[test]
fn a_picture_is_judged_by_an_answer() {
    let home = Home::new();
    home.put("a.png", 0.0);
    home.put("b.pfm", 0.5);
    let answer = "stages/01_ray_casting/dark.answer.exr";
    dark_exam(&home.at("stages"));
    home.check(&["a.png", "--answer", answer], 0, "they agree");
    home.check(&["b.pfm", "--answer", answer], 1, "12 pixels of 12 differ");
    home.check(&["b.pfm", "--answer", answer, "--tolerance", "128"], 0, "they agree");
    home.check_fed(&["-", "--answer", answer], "a.png", 0, "they agree");
    home.check_both("a.png", answer, "0", 0, "they agree");
    home.check(
        &["a.png", "--answer", "b.pfm"],
        2,
        "b.pfm: a stored answer is a file that is called",
    );
    home.check(&["a.png", "--answer", "-"], 2, "-: a stored answer is a file that is called");
    home.check(
        &["a.png", "--answer", "/dev/zero"],
        2,
        "/dev/zero: a stored answer is a file that is called",
    );
    home.check(&["a.png", answer, "--answer", answer], 2, "cannot be used with");
    home.put_sized("wide.png", 5, 0.2);
    home.check(&["wide.png", "--answer", answer], 2, "is the answer to a picture of 4×3, not 5×3");
    std::os::unix::fs::symlink("/dev/zero", home.at("zero.answer.exr")).unwrap();
    home.check(
        &["a.png", "--answer", "zero.answer.exr"],
        2,
        "a stored answer is a file that is called",
    );
}

/// An answer is refused if nothing shows that it is current.
#[test]
fn a_picture_is_not_judged_by_an_answer_to_another_case() {
    let home = Home::new();
    home.put("a.png", 0.0);
    dark_exam(&home.at("stages"));
    let answer = "stages/01_ray_casting/dark.answer.exr";
    fs::copy(home.at(answer), home.at("dark.answer.exr")).unwrap();
    home.check(
        &["a.png", "--answer", "dark.answer.exr"],
        2,
        "dark.toml beside it, so nothing shows that the answer is current",
    );
    let case = home.at("stages/01_ray_casting/dark.toml");
    fs::write(&case, CASE.replace("Nothing is there", "It is dark")).unwrap();
    home.check(&["a.png", "--answer", answer], 0, "they agree");
    fs::write(&case, CASE.replace("fov_y_deg = 40", "fov_y_deg = 40.5")).unwrap();
    home.check(&["a.png", "--answer", answer], 2, "help: `reference expect ");
    fs::write(&case, CASE).unwrap();
    fs::write(home.at("stages/course.toml"), "highlight = \"phong\"").unwrap();
    home.check(&["a.png", "--answer", answer], 2, "help: `reference expect ");
}

#[test]
fn an_input_that_may_never_end_is_refused_at_once() {
    let home = Home::new();
    home.put("a.png", 0.2);
    fs::create_dir(home.at("folder")).unwrap();
    assert!(Command::new("mkfifo").arg(home.at("pipe")).status().unwrap().success());
    std::os::unix::fs::symlink("/dev/zero", home.at("zero.png")).unwrap();
    home.put_sized("wide.png", 5, 0.2);
    fs::write(home.at("cut.png"), &fs::read(home.at("a.png")).unwrap()[..50]).unwrap();
    let _socket = UnixListener::bind(home.at("socket")).unwrap();
    for (name, says) in [
        ("/dev/zero", "it is a device"),
        ("zero.png", "it is a device"),
        ("/dev/null", "it is a device"),
        ("folder", "it is a folder"),
        ("pipe", "it is a named pipe"),
        ("socket", "it is a socket"),
        ("a.png/x", "there is no such file"),
    ] {
        let says = format!("{name}: {says}");
        home.check_both("a.png", name, "0", 2, &says);
        home.check(&["a.png", "--answer", name], 2, "a stored answer is a file that is called");
    }
    home.check_fed(&["a.png", "-"], "/dev/zero", 2, "standard input: not a PNG, PFM or EXR image");
    home.check_fed(&["-", "a.png"], "wide.png", 2, "standard input is 5×3 pixels, a.png is 4×3");
    home.check_fed(
        &["-", "a.png"],
        "cut.png",
        2,
        "standard input: it cannot be decoded: the PNG ends early",
    );
    home.check_fed(&["-", "a.png"], "/dev/null", 2, "the file is empty");
    home.check_fed(&["-", "-"], "a.png", 2, "a stream can be read only once");
    home.check_fed(&["/dev/fd/0", "-"], "a.png", 2, "a stream can be read only once");
}

/// Runs a shell line in the folder of the pictures. The variable `grader` is the program.
fn shell(home: &Home, line: &str) -> Output {
    let mut command = Command::new("timeout");
    command.args(["100", "sh", "-c", line]).env("grader", env!("CARGO_BIN_EXE_grader"));
    command.current_dir(home.0.path()).stdin(Stdio::null()).output().unwrap()
}

#[test]
fn pipes_are_read_once() {
    let home = Home::new();
    home.put("a.png", 0.2);
    home.put("a.pfm", 0.2);
    home.put("b.pfm", 0.9);
    assert!(Command::new("mkfifo").arg(home.at("pipe")).status().unwrap().success());
    for (line, code, says) in [
        ("cat a.png | $grader compare - a.png", 0, "they agree"),
        ("cat b.pfm | $grader compare a.png -", 1, "12 pixels of 12 differ"),
        (
            "cat a.png | { exec 4<&0 < /dev/null; $grader compare /dev/fd/4 a.png; }",
            0,
            "they agree",
        ),
        (
            "cat a.png | { exec 4<&0 < a.pfm; $grader compare /dev/fd/4 - --tolerance 1; }",
            0,
            "they agree",
        ),
        ("exec 4< a.png; $grader compare /proc/self/fd/4 a.png", 0, "they agree"),
        ("cat a.png > pipe & $grader compare a.png - < pipe", 0, "they agree"),
        ("exec 4< /dev/zero; $grader compare a.png /dev/fd/4", 2, "/dev/fd/4: it is a device"),
        ("exec 4<> pipe; $grader compare a.png /dev/fd/4", 2, "/dev/fd/4: it is a named pipe"),
        ("{ cat a.png; cat /dev/zero; } | $grader compare a.pfm a.pfm", 0, "they agree"),
        ("{ cat a.pfm; cat /dev/zero; } | $grader compare - a.pfm", 2, "bytes, which is the limit"),
        (
            "$grader compare a.png b.pfm > /dev/full",
            3,
            "cannot write to standard output: No space left",
        ),
        ("$grader compare a.png b.pfm 2>&1 | true", 0, ""),
    ] {
        let output = shell(&home, line);
        let text = String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{line}: {text}");
        assert!(
            text.contains(says) && !text.contains("panicked"),
            "{line}: no {says:?} in\n{text}"
        );
    }
}

#[test]
fn a_signal_ends_a_wait_for_input() {
    let home = Home::new();
    home.put("a.png", 0.2);
    for signal in ["INT", "TERM"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.args(["compare", "-", "a.png"]).current_dir(home.0.path());
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // The reading thread starts after the signal handlers are set.
        let tasks = PathBuf::from(format!("/proc/{}/task", child.id()));
        while fs::read_dir(&tasks).unwrap().count() < 2 {
            assert_eq!(child.try_wait().unwrap(), None, "it did not wait");
        }
        assert!(
            Command::new("kill")
                .args(["-s", signal, &child.id().to_string()])
                .status()
                .unwrap()
                .success()
        );
        let _open = child.stdin.take(); // `wait` would close it
        assert_eq!(child.wait().unwrap().code(), Some(130), "{signal}");
    }
}

#[test]
fn pictures_too_large_for_memory_are_refused_or_compared_in_little() {
    let home = Home::new();
    fs::write(home.at("wide.pfm"), "PF\n16384 16384\n-1.0\n").unwrap();
    home.check(&["wide.pfm", "wide.pfm"], 2, "it is 16384×16384 pixels; at most 67108864 pixels");
    let image = Image::from_fn(4096, 4096, |i, j| DVec3::splat(f64::from((i ^ j) % 256) / 255.0));
    film::write(&home.at("large.png"), &image).unwrap();
    let output =
        shell(&home, "ulimit -v 300000; RAYON_NUM_THREADS=2 $grader compare large.png large.png");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn names_are_read_from_where_the_command_runs() {
    let home = Home::new();
    home.put("a.png", 0.2);
    std::os::unix::fs::symlink("a.png", home.at("link")).unwrap();
    home.check(&["link", "./a.png"], 0, "they agree");
    let absolute = home.at("a.png");
    assert!(Path::new(&absolute).is_absolute());
    home.check(&["link", absolute.to_str().unwrap()], 0, "they agree");
}
