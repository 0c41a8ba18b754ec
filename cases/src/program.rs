//! `main` of a submission written in Rust: the three calls of `docs/protocol.md`, which run the
//! student's functions.
//!
//! The boundary is a trait object, so that nothing heavy is compiled with the student's code. A
//! function whose body is still `todo!()` answers a probe with `todo` and ends a render with
//! [`EXIT_TODO`], so that it never looks like a crash.

use std::cell::RefCell;
use std::io::{BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;

use glam::DVec3;

use crate::film::{self, Image};
use crate::probe::{Answer, Ask, Question, Reply};
use crate::ray_tree;
use crate::scene::{self, Scene};

/// Exit code of `render` and `explain` if a function that they need is still to be written.
pub const EXIT_TODO: u8 = 75;

const USAGE: &str = "usage: PROGRAM render SCENE.json OUT.png|OUT.pfm
       PROGRAM probe
       PROGRAM explain SCENE.json X Y";

/// A tracer that answers the calls of the protocol.
pub trait Tracer {
    /// Returns the colour of pixel (i, j): column from the left, row from the top. [rule 1]
    fn pixel(&self, scene: &Scene, i: u32, j: u32) -> DVec3;

    /// Returns the answer to a question of the unit checks.
    fn answer(&self, ask: &Ask) -> Answer;
}

/// Runs the call on the command line.
///
/// Exit codes: 0 success, 1 the tracer panicked, 2 wrong usage or unreadable input, [`EXIT_TODO`] a
/// function is still to be written.
pub fn run(tracer: &dyn Tracer) -> ExitCode {
    remember_panics();
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let outcome = call(tracer, &args, &mut std::io::stdin().lock(), &mut std::io::stdout().lock());
    let Err(stop) = outcome else { return ExitCode::SUCCESS };
    match &stop {
        Stop::Panicked => {}
        Stop::Input(message) => eprintln!("{message}"),
        Stop::Todo(function) => eprintln!("todo: {function}"),
    }
    ExitCode::from(stop.exit_code())
}

/// The reason why a call ended early.
#[derive(Debug)]
enum Stop {
    Todo(String),
    Panicked,
    Input(String),
}

impl Stop {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Panicked => 1,
            Self::Input(_) => 2,
            Self::Todo(_) => EXIT_TODO,
        }
    }
}

/// Runs the call that `args` describe; `input` and `out` are its standard streams.
fn call(
    tracer: &dyn Tracer,
    args: &[&str],
    input: &mut dyn BufRead,
    out: &mut dyn Write,
) -> Result<(), Stop> {
    match args {
        ["render", scene, picture] => render(tracer, Path::new(scene), Path::new(picture)),
        ["probe"] => probe(tracer, input, out),
        ["explain", scene, x, y] => explain(tracer, Path::new(scene), x, y, out),
        _ => Err(Stop::Input(USAGE.to_owned())),
    }
}

fn render(tracer: &dyn Tracer, scene: &Path, out: &Path) -> Result<(), Stop> {
    let scene = read(scene)?;
    let image = guarded(|| {
        Image::from_fn(scene.render.width, scene.render.height, |i, j| tracer.pixel(&scene, i, j))
    })?;
    film::write(out, &image).map_err(|why| Stop::Input(why.to_string()))
}

fn explain(
    tracer: &dyn Tracer,
    scene: &Path,
    x: &str,
    y: &str,
    out: &mut dyn Write,
) -> Result<(), Stop> {
    let scene = read(scene)?;
    let inside = |text: &str, size: u32| text.parse().ok().filter(|n: &u32| *n < size);
    let (Some(i), Some(j)) = (inside(x, scene.render.width), inside(y, scene.render.height)) else {
        let size = format!("{}×{}", scene.render.width, scene.render.height);
        return Err(Stop::Input(format!("pixel ({x}, {y}) does not lie in a picture of {size}")));
    };
    let tree = guarded(|| {
        ray_tree::record(|| {
            tracer.pixel(&scene, i, j);
        })
    })?;
    let text = tree.map_or_else(|| "no ray was recorded\n".to_owned(), |tree| tree.to_string());
    write!(out, "{text}").map_err(|why| Stop::Input(format!("cannot write the ray tree: {why}")))
}

/// Answers the questions of `input`. Answers are flushed one by one, so that a function that never
/// returns costs no earlier answer.
fn probe(tracer: &dyn Tracer, input: &mut dyn BufRead, out: &mut dyn Write) -> Result<(), Stop> {
    for line in input.lines() {
        let line = line.map_err(|why| Stop::Input(format!("cannot read a question: {why}")))?;
        if line.trim().is_empty() {
            continue;
        }
        let question: Question = serde_json::from_str(&line)
            .map_err(|why| Stop::Input(format!("cannot understand the question {line}: {why}")))?;
        let answer = guarded(|| tracer.answer(&question.ask)).unwrap_or_else(|stop| match stop {
            Stop::Todo(_) => Answer::Todo(true),
            Stop::Panicked | Stop::Input(_) => Answer::Panic(last_panic()),
        });
        let reply = serde_json::to_string(&Reply { id: question.id, answer })
            .map_err(|why| Stop::Input(format!("cannot write an answer: {why}")))?;
        writeln!(out, "{reply}")
            .and_then(|()| out.flush())
            .map_err(|why| Stop::Input(format!("cannot write an answer: {why}")))?;
    }
    Ok(())
}

fn read(path: &Path) -> Result<Scene, Stop> {
    let text = std::fs::read_to_string(path)
        .map_err(|why| Stop::Input(format!("cannot read the scene {}: {why}", path.display())))?;
    scene::json::from_str(&text)
        .map_err(|why| Stop::Input(format!("cannot understand {}: {why}", path.display())))
}

thread_local! {
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// The text that `todo!()` puts before its message.
const TODO: &str = "not yet implemented";

/// Stores the message and place of every panic for the reply. Prints it unless it is a `todo!()`.
fn remember_panics() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.payload_as_str().unwrap_or("panic without a message");
        let place =
            info.location().map(|at| format!(" ({}:{})", at.file(), at.line())).unwrap_or_default();
        if !message.starts_with(TODO) {
            eprintln!("panic: {message}{place}");
        }
        LAST_PANIC.set(format!("{message}{place}"));
    }));
}

fn last_panic() -> String {
    LAST_PANIC.with_borrow(Clone::clone)
}

fn guarded<T>(call: impl FnOnce() -> T) -> Result<T, Stop> {
    catch_unwind(AssertUnwindSafe(call)).map_err(|_| {
        let message = last_panic();
        match message.strip_prefix(TODO) {
            Some(function) => Stop::Todo(function.trim_start_matches(": ").to_owned()),
            None => Stop::Panicked,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray_tree::RayKind;
    use crate::{Effects, Ray};

    /// A tracer controlled by the red of the scene's background, or by the function that is called.
    struct Mixed;

    #[expect(clippy::todo, reason = "functions still to be written are what is tested")]
    impl Tracer for Mixed {
        fn pixel(&self, scene: &Scene, i: u32, j: u32) -> DVec3 {
            match scene.background.x {
                0.0 => todo!("eye_ray [rule 1]: src/camera.rs"),
                1.0 => panic!("index out of bounds"),
                _ => {
                    ray_tree::enter(RayKind::Eye, 0, &Ray::new(DVec3::ZERO, DVec3::NEG_Z));
                    ray_tree::leave(DVec3::new(f64::from(i), f64::from(j), 0.5))
                }
            }
        }

        fn answer(&self, ask: &Ask) -> Answer {
            match ask {
                Ask::Reflect { direction, .. } => Answer::Vector(-*direction),
                Ask::Indices { .. } => panic!("no such index"),
                _ => todo!(),
            }
        }
    }

    fn scene(red: f64) -> String {
        let camera = scene::Camera {
            eye: DVec3::ZERO,
            right: DVec3::X,
            up: DVec3::Y,
            forward: DVec3::NEG_Z,
            fov_y_deg: 45.0,
        };
        scene::json::to_string(&Scene {
            render: scene::Render { width: 2, height: 1, max_depth: 0, threshold: 0.0 },
            effects: Effects::NONE,
            camera,
            background: DVec3::new(red, 0.0, 0.0),
            lights: vec![],
            materials: vec![],
            meshes: vec![],
            objects: vec![],
        })
    }

    /// Returns the output of the call, or the exit code with which it ends.
    fn check(args: &[&str], input: &str) -> Result<String, u8> {
        remember_panics();
        let mut out = Vec::new();
        match call(&Mixed, args, &mut input.as_bytes(), &mut out) {
            Ok(()) => Ok(String::from_utf8(out).unwrap()),
            Err(stop) => Err(stop.exit_code()),
        }
    }

    /// Runs [`check`] for a scene with that much red, in a temporary folder. Also returns the
    /// picture `out.pfm`, if the call has written it there.
    fn check_scene(
        red: f64,
        args: impl FnOnce(&str, &str) -> Vec<String>,
    ) -> (Result<String, u8>, Option<Vec<u8>>) {
        let folder = tempfile::tempdir().unwrap();
        let (file, picture) = (folder.path().join("scene.json"), folder.path().join("out.pfm"));
        std::fs::write(&file, scene(red)).unwrap();
        let args = args(file.to_str().unwrap(), picture.to_str().unwrap());
        let outcome = check(&args.iter().map(String::as_str).collect::<Vec<_>>(), "");
        (outcome, std::fs::read(picture).ok())
    }

    fn render(red: f64) -> (Result<String, u8>, Option<Vec<u8>>) {
        check_scene(red, |scene, picture| ["render", scene, picture].map(str::to_owned).to_vec())
    }

    fn explain(red: f64, x: &'static str, y: &'static str) -> Result<String, u8> {
        check_scene(red, |scene, _| ["explain", scene, x, y].map(str::to_owned).to_vec()).0
    }

    #[test]
    fn a_question_is_answered_or_todo_or_a_panic_and_the_next_one_still_answered() {
        let questions = r#"{"id":"a","fn":"indices","inside":true,"index":1.5}

{"id":"b","fn":"goes_on","depth":0,"max_depth":1,"weight":[1,1,1],"threshold":0}
{"id":"c","fn":"reflect","direction":[0,-1,0],"normal":[0,1,0]}
"#;
        let replies = check(&["probe"], questions).unwrap();
        let replies: Vec<Reply> =
            replies.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(
            replies.iter().map(|reply| reply.id.as_str()).collect::<Vec<_>>(),
            ["a", "b", "c"]
        );
        assert!(
            matches!(&replies[0].answer, Answer::Panic(why) if why.starts_with("no such index (")),
            "{replies:?}"
        );
        assert_eq!(replies[1].answer, Answer::Todo(true));
        assert_eq!(replies[2].answer, Answer::Vector(DVec3::Y));
    }

    #[test]
    fn a_line_that_is_no_question_ends_the_probe() {
        assert_eq!(check(&["probe"], "{\"id\":\"a\",\"fn\":\"fly\"}\n"), Err(2));
        assert_eq!(check(&["probe"], ""), Ok(String::new()));
    }

    #[test]
    fn a_picture_is_written_whole_or_not_at_all() {
        let (outcome, picture) = render(2.0);
        assert_eq!(outcome, Ok(String::new()));
        let image = film::read_exact(&picture.unwrap(), 2, 1).unwrap();
        assert_eq!(image.pixels(), [DVec3::new(0.0, 0.0, 0.5), DVec3::new(1.0, 0.0, 0.5)]);
        assert_eq!(render(0.0), (Err(EXIT_TODO), None));
        assert_eq!(render(1.0), (Err(1), None));
    }

    #[test]
    fn a_pixel_is_explained_if_there_is_one() {
        let tree = explain(2.0, "1", "0").unwrap();
        assert!(
            tree.starts_with("eye ray, depth 0\n") && tree.contains("colour (1, 0, 0.5)"),
            "{tree}"
        );
        assert_eq!(explain(0.0, "0", "0"), Err(EXIT_TODO));
        for (x, y) in [("2", "0"), ("0", "1"), ("-1", "0"), ("a", "0")] {
            assert_eq!(explain(2.0, x, y), Err(2));
        }
    }

    #[test]
    fn other_calls_are_refused() {
        for args in [
            &[][..],
            &["probe", "x"],
            &["render", "scene.json"],
            &["render", "no such scene.json", "out.png"],
        ] {
            assert_eq!(check(args, ""), Err(2), "{args:?}");
        }
    }
}
