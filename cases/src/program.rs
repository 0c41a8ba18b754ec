//! `main` of a submission written in Rust: the three calls of `docs/protocol.md` around the student's functions.
//!
//! The boundary is a trait object, so nothing heavy is compiled with the student's code. A function whose body is still
//! `todo!()` answers a probe with `todo` and ends a render with [`EXIT_TODO`]; it never looks like a crash.

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

/// Exit code of `render` and `explain` where a function they need is still to be written.
pub const EXIT_TODO: u8 = 75;

const USAGE: &str = "usage: PROGRAM render SCENE.json OUT.png|OUT.pfm
       PROGRAM probe
       PROGRAM explain SCENE.json X Y";

/// A tracer behind the protocol.
pub trait Tracer {
    /// The colour of pixel (i, j): column from the left, row from the top. [rule 1]
    fn pixel(&self, scene: &Scene, i: u32, j: u32) -> DVec3;

    /// The answer to a question of the unit checks.
    fn answer(&self, ask: &Ask) -> Answer;
}

/// Carries out the call on the command line. Exit codes: 0 done, 1 the tracer panicked, 2 usage or unreadable input,
/// [`EXIT_TODO`] a function is still to be written.
pub fn run(tracer: &dyn Tracer) -> ExitCode {
    remember_panics();
    let args: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match args.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["render", scene, out] => render(tracer, Path::new(scene), Path::new(out)),
        ["probe"] => probe(tracer),
        ["explain", scene, x, y] => explain(tracer, Path::new(scene), x, y),
        _ => Err(Stop::Input(USAGE.to_owned())),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Stop::Panicked) => ExitCode::from(1),
        Err(Stop::Input(message)) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
        Err(Stop::Todo(function)) => {
            eprintln!("todo: {function}");
            ExitCode::from(EXIT_TODO)
        }
    }
}

/// Why a call ended early.
enum Stop {
    Todo(String),
    Panicked,
    Input(String),
}

fn render(tracer: &dyn Tracer, scene: &Path, out: &Path) -> Result<(), Stop> {
    let scene = read(scene)?;
    let image = guarded(|| Image::from_fn(scene.render.width, scene.render.height, |i, j| tracer.pixel(&scene, i, j)))?;
    film::write(out, &image).map_err(|why| Stop::Input(format!("cannot write {}: {why}", out.display())))
}

fn explain(tracer: &dyn Tracer, scene: &Path, x: &str, y: &str) -> Result<(), Stop> {
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
    match tree {
        Some(tree) => print!("{tree}"),
        None => println!("no ray was recorded"),
    }
    Ok(())
}

fn probe(tracer: &dyn Tracer) -> Result<(), Stop> {
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
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
    scene::json::from_str(&text).map_err(|why| Stop::Input(format!("cannot understand {}: {why}", path.display())))
}

thread_local! {
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// What `todo!()` puts before its message.
const TODO: &str = "not yet implemented";

/// Keeps the message and place of a panic for the reply; prints it unless it is a `todo!()`.
fn remember_panics() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.payload_as_str().unwrap_or("panic without a message");
        let place = info.location().map(|at| format!(" ({}:{})", at.file(), at.line())).unwrap_or_default();
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
