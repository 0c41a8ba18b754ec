//! Checks that reports go to files, streams and devices, and that files that are no pictures cost
//! only points.

mod shared;

use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use cases::film::{self, Image};
use cases::glam::DVec3;
use shared::dark_exam;

/// A folder with the exam in `stages` and the correct picture in `pictures`.
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        let home = Self(tempfile::tempdir().unwrap());
        dark_exam(&home.at("stages"));
        fs::create_dir_all(home.at("pictures/01_ray_casting")).unwrap();
        film::write(&home.at(PICTURE), &Image::from_fn(4, 3, |_, _| DVec3::ZERO)).unwrap();
        symlink("/proc/self/fd/1", home.at("stdout")).unwrap(); // /dev/stdout is such a link
        home
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs a shell line in the folder. The word `$images` stands for judging the picture.
    fn run(&self, line: &str) -> Output {
        let images = format!("{} images pictures --cases stages", env!("CARGO_BIN_EXE_grader"));
        let line = line.replace("$images", &images);
        let mut command = Command::new("timeout");
        command.args(["100", "sh", "-c", &line]).current_dir(self.0.path()).stdin(Stdio::null());
        command.output().unwrap()
    }

    /// Checks the exit code, and a part of the text on either stream. Returns standard output.
    fn check(&self, line: &str, code: i32, part: &str) -> String {
        let output = self.run(line);
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        let text = printed.clone() + &String::from_utf8_lossy(&output.stderr);
        let text = text.replace("\n    ", " "); // Long lines are wrapped.
        assert_eq!(output.status.code(), Some(code), "{line}: {text}");
        assert!(text.contains(part), "{line}: no {part:?} in\n{text}");
        printed
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap()
    }
}

const PICTURE: &str = "pictures/01_ray_casting/dark.png";
/// Each report begins with this text.
const REPORTS: [(&str, &str); 5] = [
    ("--json", "{"),
    ("--html", "<!DOCTYPE html>"),
    ("--junit", "<?xml"),
    ("--gradescope", "{"),
    ("--prairielearn", "{"),
];

#[test]
fn reports_go_to_files_and_streams_alike() {
    let home = Home::new();
    let files = ["a.json", "a.html", "a.xml", "gradescope.json", "prairielearn.json"];
    let named: Vec<String> =
        REPORTS.iter().zip(files).map(|((report, _), file)| format!("{report} {file}")).collect();
    let printed = home.check(&format!("$images {}", named.join(" ")), 0, "");
    assert!(!printed.is_empty(), "nothing was printed for people");
    for ((report, begin), file) in REPORTS.into_iter().zip(files) {
        let stored = home.text(file);
        assert!(stored.trim_start().starts_with(begin), "{report}");
        for name in ["-", "stdout"] {
            assert_eq!(
                home.check(&format!("$images {report} {name}"), 0, ""),
                stored,
                "{report} {name}"
            );
        }
        // The pipe is refused until its reader has opened it.
        let until = format!("until $images {report} pipe; do :; done");
        let line = format!("rm -f pipe; mkfifo pipe; cat pipe > piped & {until}; wait");
        home.check(&line, 0, "");
        assert_eq!(home.text("piped"), stored, "{report} to a pipe");
        home.check(&format!("exec 3> by_number; $images {report} /dev/fd/3"), 0, "");
        assert_eq!(home.text("by_number"), stored, "{report} to a descriptor");
        home.check(&format!("$images {report} /dev/null"), 0, "");
        home.check(&format!("$images {report} - | head -c 1"), 0, "");
    }
    assert!(fs::symlink_metadata(home.at("stdout")).unwrap().is_symlink(), "a link was replaced");
}

#[test]
fn a_name_that_cannot_be_written_is_said_before_anything_is_judged() {
    let home = Home::new();
    fs::create_dir(home.at("folder")).unwrap();
    for (words, says) in [
        (
            "--json no/such/a.json",
            "cannot write no/such/a.json: there is no folder `no/such`; nothing was changed",
        ),
        ("--html folder", "cannot write folder: it is a folder"),
        ("--junit stages/", "it is a folder"),
        ("--json - --html -", "only one report can go to standard output"),
        ("--json stdout --junit -", "only one report can go to standard output"),
        ("--json a.txt --junit a.txt", "two reports cannot be the same file"),
        ("--json a.txt --html stages/../a.txt", "two reports cannot be the same file"),
        ("--html - --open", "--open shows a file"),
    ] {
        home.check(&format!("$images {words}"), 2, says);
    }
    home.check("$images --json a.json --html no/such/a.html", 2, "there is no folder");
    assert!(!home.at("a.json").exists(), "a report was written all the same");
}

#[test]
fn a_full_disk_is_code_3_and_costs_no_other_report() {
    let home = Home::new();
    for (report, _) in REPORTS {
        let line = format!("$images {report} /dev/full");
        let printed = home.check(&line, 3, "cannot write /dev/full: No space left on device");
        assert!(printed.contains("2 of 2 points"), "the report for people is lost: {printed}");
    }
    assert!(
        fs::metadata("/dev/full").unwrap().file_type().is_char_device(),
        "the device was replaced"
    );
    home.check("$images --json /dev/full --html a.html --junit a.xml", 3, "No space left");
    assert!(home.text("a.html").len() > 1000 && home.text("a.xml").len() > 100);
    home.check(
        "$images > /dev/full",
        3,
        "cannot write to standard output: No space left on device",
    );
    home.check(
        "$images --json - > /dev/full",
        3,
        "cannot write to standard output: No space left on device",
    );
}

#[test]
fn a_report_that_does_not_fit_leaves_the_old_one() {
    let home = Home::new();
    fs::write(home.at("a.html"), "old").unwrap();
    // The limit on a file is 512 bytes, and the page is longer.
    let says = "cannot write a.html: File too large (os error 27); nothing was changed";
    home.check("trap '' XFSZ; ulimit -f 1; $images --html a.html", 3, says);
    assert_eq!(home.text("a.html"), "old");
    let names = fs::read_dir(home.0.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(
        !names.into_iter().any(|name| name.to_string_lossy().starts_with(".part-")),
        "a part stayed behind"
    );
}

#[test]
fn what_is_no_picture_costs_its_points_and_no_time() {
    let home = Home::new();
    home.check("$images", 0, "2 of 2 points");
    for (line, says) in [
        ("mkfifo PICTURE", "the picture is no regular file"),
        ("mkdir PICTURE", "the picture is no regular file"),
        ("ln -s /dev/zero PICTURE", "the picture is a link"),
        ("head -c 40 SAVED > PICTURE", "ends early, before its end mark (IEND)"),
        (
            "printf 'PF\\r\\n4 3\\r\\n-1.0\\r\\n' > PICTURE",
            "demands 144 bytes of floats, 0 follow: 144 too few",
        ),
        ("true", "there is no picture"),
    ] {
        let line = format!(
            "mv PICTURE SAVED; {line}; $images; code=$?; rm -rf PICTURE; mv SAVED PICTURE; exit \
                $code"
        );
        home.check(&line.replace("PICTURE", PICTURE).replace("SAVED", "saved.png"), 1, says);
    }
    let crlf =
        "{ printf 'PF\\r\\n4 3\\r\\n-1.0\\r\\n'; head -c 144 /dev/zero; } > PICTURE; $images";
    home.check(&crlf.replace("PICTURE", PICTURE), 0, "2 of 2 points");
}

#[test]
fn what_is_no_folder_of_pictures_is_code_2() {
    let home = Home::new();
    for (folder, says) in [
        ("nowhere", "nowhere: there is no such folder"),
        ("/dev/zero", "/dev/zero: it is not a folder"),
        ("stages/01_ray_casting/stage.toml", "it is not a folder"),
    ] {
        home.check(
            &"$images".replace(
                "$images",
                &format!("{} images {folder} --cases stages", env!("CARGO_BIN_EXE_grader")),
            ),
            2,
            says,
        );
    }
}
