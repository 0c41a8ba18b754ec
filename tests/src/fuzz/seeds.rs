//! Valid files of every format, small enough to be changed and read thousands of times a second.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use cases::answer::{Digest, ImageAnswer, Wrong};
use cases::film::exr::{self, Depth, Part, rgb};
use cases::film::{Image, Kind, encode};
use cases::glam::DVec3;
use cases::probe::Reply;
use cases::{Course, course, scene, stage};

use crate::{files, public_stages};

/// The width and height of the pictures.
pub const SIZE: (u32, u32) = (7, 5);

/// Returns the files below `folder` of the workspace that end in `.ending`, have at most `most`
/// bytes, and have paths that satisfy `is_one`.
fn found(folder: &str, ending: &str, most: usize, is_one: impl Fn(&Path) -> bool) -> Vec<Vec<u8>> {
    let paths = files(folder, ending).into_iter().filter(|path| is_one(path));
    let read =
        paths.map(|path| fs::read(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display())));
    read.filter(|bytes| bytes.len() <= most).collect()
}

/// Returns cases without mesh files, because another parser reads those.
pub fn cases() -> Vec<Vec<u8>> {
    let all = found("cases/stages", "toml", 16 << 10, stage::is_case);
    all.into_iter().filter(|bytes| !bytes.windows(6).any(|at| at == b"file =")).collect()
}

/// Returns files of unit checks without mesh files.
pub fn checks() -> Vec<Vec<u8>> {
    let is_check = |path: &Path| path.parent().is_some_and(|folder| folder.ends_with("checks"));
    let all = found("cases/stages", "toml", 16 << 10, is_check);
    all.into_iter().filter(|bytes| !bytes.windows(6).any(|at| at == b"file =")).collect()
}

/// Returns the `stage.toml` files.
pub fn stages() -> Vec<Vec<u8>> {
    found("cases/stages", "toml", 16 << 10, |path| path.ends_with("stage.toml"))
}

/// Returns a course for each deviation in one key, and one with several.
pub fn courses() -> Vec<Vec<u8>> {
    let several = "# Another course\nhighlight = \"phong\"\nindex_of_air = 1.0\n\
        always_simulated = [\"shadows\"]\n";
    let single = course::deviations().into_iter().map(|deviation| deviation.line + "\n");
    single.chain([several.to_owned()]).map(String::into_bytes).collect()
}

/// Returns manifests of submissions, without one that is wrong on purpose.
pub fn manifests() -> Vec<Vec<u8>> {
    let is_right = |path: &Path| {
        path.ends_with("submission.toml") && !path.ends_with("bad_toml/submission.toml")
    };
    found("tests/submissions", "toml", 4 << 10, is_right)
}

/// Returns resolved scenes as JSON.
pub fn scenes() -> Vec<Vec<u8>> {
    let paths = files("cases/stages", "toml").into_iter().filter(|path| stage::is_case(path));
    let scenes = paths.filter_map(|path| stage::load_scene(&path, &Course::default()).ok());
    scenes
        .map(|scene| scene::json::to_string(&scene).into_bytes())
        .filter(|json| json.len() < 16 << 10)
        .collect()
}

/// Returns outputs of `probe` with a few correct answers each.
pub fn replies() -> Vec<Vec<u8>> {
    let all = answers();
    let lines = all.iter().map(|answer| {
        let reply = Reply { id: answer.0.clone(), answer: answer.1.answer.clone() };
        serde_json::to_string(&reply).expect("a reply is JSON") + "\n"
    });
    let lines: Vec<String> = lines.collect();
    lines.chunks(5).map(|lines| lines.concat().into_bytes()).collect()
}

/// Returns the stored answers to the unit checks of the first stage, by id.
pub fn answers() -> std::collections::BTreeMap<String, cases::answer::CheckAnswer> {
    let exam = grader::exam::Exam::load(&public_stages()).unwrap_or_else(|why| panic!("{why}"));
    exam.stages[0].units.clone()
}

fn picture() -> Image {
    Image::from_fn(SIZE.0, SIZE.1, |i, j| {
        DVec3::new(f64::from(i * j) / 24.0, f64::from(i) / 6.0, 0.5)
    })
}

/// Returns PNG files of 8 and 16 bits.
pub fn pngs() -> Vec<Vec<u8>> {
    [Kind::Png, Kind::DeepPng]
        .map(|kind| encode(kind, &picture()).expect("a picture is written"))
        .into()
}

/// Returns a PFM file.
pub fn pfms() -> Vec<Vec<u8>> {
    vec![encode(Kind::Pfm, &picture()).expect("a picture is written")]
}

/// Returns stored answers to an image case, and a plain EXR file.
pub fn exrs() -> Vec<Vec<u8>> {
    let answer = ImageAnswer::exact(picture(), 2.0, 3);
    let digest = Digest::of_mistakes(&Course::default());
    let n = (SIZE.0 * SIZE.1) as usize;
    let wrong = Wrong::new("no_shadows", (0..n).map(|at| (at % 5 == 0).then_some([9; 3])));
    let part = Part {
        name: "colour".to_owned(),
        planes: rgb("", &picture(), Depth::Half).into(),
        attached: vec![],
    };
    vec![
        answer.encode(&digest, &[]).expect("an answer is written"),
        answer.encode(&digest, &[wrong]).expect("an answer is written"),
        exr::encode(SIZE, &[part], "").expect("a picture is written"),
    ]
}

fn meshes(ending: &str) -> Vec<Vec<u8>> {
    let is_read = |path: &Path| {
        path.parent().is_some_and(|folder| folder.ends_with("read") || folder.ends_with("same"))
    };
    found("cases/tests/meshes", ending, 4 << 10, is_read)
}

/// Returns Wavefront files.
pub fn objs() -> Vec<Vec<u8>> {
    meshes("obj")
}

/// Returns PLY files, text and binary.
pub fn plys() -> Vec<Vec<u8>> {
    meshes("ply")
}

/// The files of a submission.
const FILES: [(&str, &str); 4] = [
    ("mine/submission.toml", "[run]\ncommand = [\"sh\", \"./tracer.sh\"]\n"),
    ("mine/tracer.sh", "exit 0\n"),
    ("mine/notes/readme.txt", "Read me.\n"),
    ("mine/.git/config", "[core]\n"),
];

/// Returns archives of a submission, stored and deflated.
pub fn zip() -> Vec<Vec<u8>> {
    let archive = |method| {
        let options = zip::write::SimpleFileOptions::default().compression_method(method);
        let mut writer = zip::ZipWriter::new(Cursor::new(vec![]));
        for (name, text) in FILES {
            writer.start_file(name, options).expect("an entry is begun");
            writer.write_all(text.as_bytes()).expect("an entry is written");
        }
        writer.finish().expect("an archive is ended").into_inner()
    };
    [zip::CompressionMethod::Stored, zip::CompressionMethod::Deflated].map(archive).into()
}

/// Returns a tar archive of a submission.
pub fn tar() -> Vec<Vec<u8>> {
    let mut builder = tar::Builder::new(vec![]);
    for (name, text) in FILES {
        let mut header = tar::Header::new_gnu();
        header.set_size(text.len() as u64);
        header.set_mode(0o644);
        builder.append_data(&mut header, name, text.as_bytes()).expect("an entry is written");
    }
    vec![builder.into_inner().expect("an archive is ended")]
}

/// Returns the tar archive of a submission, compressed.
pub fn tar_gz() -> Vec<Vec<u8>> {
    let compressed = |bytes: Vec<u8>| {
        let mut encoder = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
        encoder.write_all(&bytes).expect("bytes are compressed");
        encoder.finish().expect("the end is written")
    };
    tar().into_iter().map(compressed).collect()
}

/// Returns stored answers to unit checks.
pub fn check_answers() -> Vec<Vec<u8>> {
    let all: Vec<_> = answers().into_values().collect();
    let text =
        |answers: &[_]| cases::answer::check_answers_to_string(answers).expect("answers are JSON");
    all.chunks(8).map(|answers| text(answers).into_bytes()).collect()
}

/// Returns the lists of mistakes.
pub fn mistakes() -> Vec<Vec<u8>> {
    found("cases/stages", "json", 256 << 10, |path| path.ends_with("mistakes.answers.json"))
}

/// Returns the stored costs of accuracy.
pub fn fronts() -> Vec<Vec<u8>> {
    found("cases/stages", "json", 256 << 10, |path| path.ends_with("fronts.json"))
}

/// Returns grade records.
pub fn records() -> Vec<Vec<u8>> {
    found("tests/submissions", "json", 64 << 10, |path| path.ends_with("record.json"))
}
