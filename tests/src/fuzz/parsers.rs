//! The parsers of foreign bytes, and the promises of each.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::sync::LazyLock;

use cases::answer::{CheckAnswer, ImageAnswer, Wrong, check_answers_from_str, mistakes_from_str};
use cases::film::{Rows, most_bytes, read_exact};
use cases::problem::Problems;
use cases::{Course, Effect, Effects, Scene, course, front, scene, stage};
use grader::exercise::replies::{self, Got};
use grader::grade::Graded;
use grader::judge;
use grader::plain::{is_hidden, printable};
use grader::record::Record;
use grader::report::class::{self, Entry};
use grader::report::{html, junit, terminal};
use grader::submission::{self, SubmissionError, Template};
use pages::say;

use super::mutate::{no_repair, png_crcs, tar_sums};
use super::scraps::{ARCHIVE, EXR, JSON, OBJ, PFM, PLY, PNG, TOML};
use super::{Parser, Read, seeds};

/// The maximum length of a message in bytes, however long the file is.
const MOST_SAID: usize = 128 << 10;

/// Returns all parsers.
pub fn all() -> [Parser; 19] {
    let text = |name, seeds, scraps, read| Parser { name, seeds, scraps, repair: no_repair, read };
    [
        text("case", seeds::cases, TOML, case),
        text("unit_checks", seeds::checks, TOML, checks),
        text("stage", seeds::stages, TOML, about_stage),
        text("course", seeds::courses, TOML, of_course),
        text("submission", seeds::manifests, TOML, manifest),
        text("scene_json", seeds::scenes, JSON, scene_json),
        text("replies", seeds::replies, JSON, of_probe),
        Parser { name: "png", seeds: seeds::pngs, scraps: PNG, repair: png_crcs, read: picture },
        text("pfm", seeds::pfms, PFM, picture),
        text("exr", seeds::exrs, EXR, exr),
        text("obj", seeds::objs, OBJ, obj),
        text("ply", seeds::plys, PLY, ply),
        text("zip", seeds::zip, ARCHIVE, zip),
        Parser { name: "tar", seeds: seeds::tar, scraps: ARCHIVE, repair: tar_sums, read: tar },
        text("tar_gz", seeds::tar_gz, ARCHIVE, tar_gz),
        text("check_answers", seeds::check_answers, JSON, check_answers),
        text("mistakes", seeds::mistakes, JSON, mistakes),
        text("fronts", seeds::fronts, JSON, fronts),
        text("record", seeds::records, JSON, record),
    ]
}

/// Turns the result of a parser into [`Read`]. A refusal must have a message of bounded length that
/// is harmless to print.
fn outcome<T>(result: Result<T, Problems>) -> Read {
    match result {
        Ok(_) => Read::Accepted,
        Err(problems) => refused(&printable(&problems.render(false))),
    }
}

fn refused(message: &str) -> Read {
    assert!(!message.trim().is_empty(), "a refusal without a message");
    assert!(message.len() <= MOST_SAID, "a message of {} bytes: {:.300}", message.len(), message);
    let hidden = message.chars().find(|c| !['\n', '\t'].contains(c) && is_hidden(*c));
    assert_eq!(hidden, None, "in {message:?}");
    Read::Refused
}

/// Writes the file and returns its path.
fn put(folder: &Path, name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder around the file"))
        .expect("a folder can be made");
    fs::write(&path, bytes).expect("a file can be written");
    path
}

/// The text of a stage that allows every effect.
static STAGE: LazyLock<String> = LazyLock::new(|| {
    let allows: Vec<&str> = Effects::ALL.iter().map(Effect::name).collect();
    format!("title = \"T\"\nabout = \"A.\"\nallows = {allows:?}\nneeds = []\nunit_points = 10\n")
});

fn case(bytes: &[u8], folder: &Path) -> Read {
    put(folder, "case/stage.toml", STAGE.as_bytes());
    let path = put(folder, "case/x.toml", bytes);
    let loaded = stage::load_case(&path, &Course::default());
    if let Ok(case) = &loaded {
        is_kept(&case.scene);
    }
    outcome(loaded)
}

/// Checks that an accepted scene is accepted again in the JSON form that programs get.
fn is_kept(scene: &Scene) {
    let json = scene::json::to_string(scene);
    let again =
        scene::parse_json("again", &json).unwrap_or_else(|problems| panic!("{problems}\n{json}"));
    assert_eq!(scene::json::to_string(&again), json);
}

fn checks(bytes: &[u8], folder: &Path) -> Read {
    put(folder, "checks/01_x/stage.toml", STAGE.as_bytes());
    put(folder, "checks/01_x/checks/sphere.toml", bytes);
    outcome(stage::load_all(&folder.join("checks"), &Course::default()))
}

fn about_stage(bytes: &[u8], folder: &Path) -> Read {
    put(folder, "stage/01_x/stage.toml", bytes);
    outcome(stage::allowed_at(&put(folder, "stage/01_x/x.toml", b"")))
}

fn of_course(bytes: &[u8], folder: &Path) -> Read {
    outcome(course::load(&put(folder, "course.toml", bytes)))
}

fn manifest(bytes: &[u8], folder: &Path) -> Read {
    put(folder, "manifest/submission.toml", bytes);
    handed_in(&folder.join("manifest"))
}

/// Reads a submission. No hand-in may be reported as a failure of the machine.
fn handed_in(path: &Path) -> Read {
    match submission::read(path, &TEMPLATE) {
        Ok(_) => Read::Accepted,
        Err(why @ (SubmissionError::Machine { .. } | SubmissionError::Folder(_))) => {
            panic!("{}", say::chain(&why))
        }
        Err(why) => refused(&say::chain(&why)),
    }
}

static TEMPLATE: LazyLock<Template> = LazyLock::new(Template::carried);

fn zip(bytes: &[u8], folder: &Path) -> Read {
    handed_in(&put(folder, "mine.zip", bytes))
}

fn tar(bytes: &[u8], folder: &Path) -> Read {
    handed_in(&put(folder, "mine.tar", bytes))
}

fn tar_gz(bytes: &[u8], folder: &Path) -> Read {
    handed_in(&put(folder, "mine.tar.gz", bytes))
}

fn scene_json(bytes: &[u8], folder: &Path) -> Read {
    let loaded = stage::load_scene(&put(folder, "scene.json", bytes), &Course::default());
    if let Ok(scene) = &loaded {
        is_kept(scene);
    }
    outcome(loaded)
}

/// Judges every answer that can be read.
fn of_probe(bytes: &[u8], _folder: &Path) -> Read {
    static ANSWERS: LazyLock<BTreeMap<String, CheckAnswer>> = LazyLock::new(seeds::answers);
    let asked: BTreeSet<&str> = ANSWERS.keys().map(String::as_str).collect();
    let replies = replies::parse(bytes, &asked);
    let mut read = if replies.got.is_empty() { Read::Refused } else { Read::Accepted };
    for (id, got) in &replies.got {
        match got {
            Got::Answer(answer) => {
                let function = id.split('/').nth(1).unwrap_or("sphere");
                if let Some(finding) = judge::unit(answer, &ANSWERS[id], function).finding {
                    refused(&finding.message);
                }
            }
            Got::Malformed(why) => read = refused(why),
            Got::Twice => {}
        }
    }
    read
}

/// Reads a picture whole, as the judge does, and row by row, as `compare` does. Both must agree.
fn picture(bytes: &[u8], _folder: &Path) -> Read {
    let (width, height) = seeds::SIZE;
    let is_small = most_bytes(&bytes[..bytes.len().min(4096)]).is_ok();
    let exact = read_exact(bytes, width, height);
    let rows = Rows::open(Cursor::new(bytes))
        .and_then(|rows| (rows.size() == seeds::SIZE).then(|| rows.into_image()).transpose());
    match (exact, rows) {
        (Ok(exact), rows) => {
            let rows = rows.expect("read whole, but not row by row").expect("the size demanded");
            assert_eq!(format!("{rows:?}"), format!("{exact:?}")); // NaN is like NaN
            assert!(is_small, "read, but refused as too large");
            Read::Accepted
        }
        (Err(why), rows) => {
            assert!(!matches!(rows, Ok(Some(_))), "refused whole ({why}), but read row by row");
            refused(&why.to_string())
        }
    }
}

/// Reads a picture, or an answer with its mistakes.
fn exr(bytes: &[u8], _folder: &Path) -> Read {
    let (width, height) = seeds::SIZE;
    let rows = Rows::open(Cursor::new(bytes)).and_then(Rows::into_image).map(drop);
    let answer = ImageAnswer::decode(bytes, width, height).map(|answer| {
        let _ = (answer.share(&answer.out(&answer.expected)), answer.contested_share());
    });
    let others = [
        Wrong::ids(bytes).map(drop),
        Wrong::decode_all(bytes, width, height).map(drop),
        ImageAnswer::made_from(bytes).map(drop),
    ];
    let is_read = rows.is_ok() || answer.is_ok();
    for why in [rows, answer].into_iter().chain(others).filter_map(Result::err) {
        refused(&printable(&why.to_string()));
    }
    if is_read { Read::Accepted } else { Read::Refused }
}

fn obj(bytes: &[u8], folder: &Path) -> Read {
    mesh(bytes, folder, "mesh.obj")
}

fn ply(bytes: &[u8], folder: &Path) -> Read {
    mesh(bytes, folder, "mesh.ply")
}

/// Reads a mesh with its normals and without them.
fn mesh(bytes: &[u8], folder: &Path, name: &str) -> Read {
    put(folder, name, bytes);
    let load = |smooth: &str| {
        let text = format!(
            "render = {{ size = [1, 1] }}\n[scene]\nmaterials = {{ m = {{}} }}\n\
             camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
             objects = [{{ mesh = {{ file = \"{name}\"{smooth} }}, material = \"m\" }}]\n"
        );
        let scene = scene::parse("mesh", &text, folder, &Course::default());
        if let Ok(scene) = &scene {
            is_sound(&scene.meshes[0]);
        }
        outcome(scene)
    };
    let (smooth, flat) = (load(""), load(", smooth = false"));
    assert!(smooth == Read::Refused || flat == Read::Accepted, "its normals make a mesh readable");
    flat
}

/// Checks that a mesh keeps the promises of a scene.
fn is_sound(mesh: &cases::Mesh) {
    let n = mesh.vertices.len();
    assert!(!mesh.triangles.is_empty() && mesh.vertices.iter().all(|vertex| vertex.is_finite()));
    assert!(mesh.triangles.iter().flatten().all(|index| (*index as usize) < n));
    let is_unit = |normal: &cases::glam::DVec3| (normal.length() - 1.0).abs() < 1e-9;
    assert!(
        mesh.normals
            .as_ref()
            .is_none_or(|normals| normals.len() == n && normals.iter().all(is_unit))
    );
}

fn json<T>(bytes: &[u8], read: impl Fn(&str) -> Result<T, serde_json::Error>) -> Read {
    match std::str::from_utf8(bytes).map_err(|why| why.to_string()).map(read) {
        Ok(Ok(_)) => Read::Accepted,
        Ok(Err(why)) => refused(&grader::plain::shown(&why.to_string())),
        Err(why) => refused(&why),
    }
}

fn check_answers(bytes: &[u8], _folder: &Path) -> Read {
    json(bytes, check_answers_from_str)
}

fn mistakes(bytes: &[u8], _folder: &Path) -> Read {
    json(bytes, mistakes_from_str)
}

fn fronts(bytes: &[u8], _folder: &Path) -> Read {
    json(bytes, front::fronts_from_str)
}

/// Checks that a readable record can be shown in every form.
fn record(bytes: &[u8], _folder: &Path) -> Read {
    let record = match serde_json::from_slice::<Record>(bytes) {
        Ok(record) => record,
        Err(_) => return Read::Refused,
    };
    let again: Record = serde_json::from_str(&record.to_json()).expect("its own JSON");
    assert_eq!(again, record);
    let look = terminal::Look { is_verbose: true, columns: 80 };
    let shown = terminal::render(&record, look) + &junit::to_string(&record).expect("JUnit");
    assert!(!shown.is_empty());
    let entry = Entry { id: "a".to_owned(), name: "a".to_owned(), record: Some(record.clone()) };
    assert!(
        !class::csv(std::slice::from_ref(&entry), None).is_empty()
            && !class::page(&[entry], &[], None).is_empty()
    );
    assert!(!html::render(&Graded { record, pictures: BTreeMap::new() }).is_empty());
    Read::Accepted
}
