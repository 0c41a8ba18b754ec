//! Measures whole commands, for which a user waits.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cases::film::{self, Image, Kind};
use cases::glam::DVec3;
use serde::Serialize;

use super::bench::{Bench, made};
use super::child::{self, Spent};
use super::series::median;
use crate::workspace;

/// The number of runs of a short command in each round.
const N_SHORT: usize = 20;

/// The case that represents all cases of 160 × 120 pixels.
const CASE: &str = "04_refraction/crystal_ball";

/// The side of the large pictures that are compared.
const SIDE: u32 = 4096;

/// A command, with medians over its runs.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The task, one of [`what`].
    pub what: &'static str,
    /// The program.
    pub who: &'static str,
    /// The CPU seconds of the process.
    pub cpu_s: f64,
    /// The wall time in seconds.
    pub wall_s: f64,
    /// The difference from our work, if there is one.
    pub note: Option<&'static str>,
}

/// The names of the tasks.
pub mod what {
    #![allow(missing_docs, reason = "their values say it")]
    pub const CASE: &str = "a case of 160×120, from start to PNG on disk";
    pub const EXPECT: &str = "all answers of the public cases (`expect --check`)";
    pub const VARY: &str = "a hidden set (`vary`) with its answers (`expect`)";
    pub const EQUAL: &str = "compare two equal PNGs of 4096×4096";
    pub const DIFFERENT: &str = "compare two PNGs of 4096×4096, one pixel of a thousand different";
    pub const PAIR: &str = "compare two PNGs of 320×240";
}

/// The name of our own programs in [`Row::who`].
pub const OURS: &str = "ours";

/// A command that is measured.
struct Task {
    what: &'static str,
    who: &'static str,
    command: Command,
    /// The accepted exit codes; empty if all are accepted.
    codes: &'static [i32],
    n_runs: usize,
    note: Option<&'static str>,
}

/// Runs every command, round by round, and returns medians.
///
/// # Errors
/// Returns an error if a program is missing or fails.
pub fn measure(bench: &Bench) -> Result<Vec<Row>, String> {
    let folder = bench.folder("small", "small");
    let mut tasks = tasks(bench, made(&folder)?)?;
    let mut spent: Vec<Vec<Spent>> = tasks.iter().map(|_| vec![]).collect();
    for round in 0..bench.n_rounds {
        for (task, spent) in tasks.iter_mut().zip(&mut spent) {
            bench.say(&format!("{}, round {}: {}", task.what, round + 1, task.who));
            for _ in 0..task.n_runs {
                spent.push(child::run_to(&mut task.command, &folder, task.codes)?);
            }
        }
    }
    let row = |(task, spent): (&Task, &Vec<Spent>)| {
        let middle = |of: fn(&Spent) -> f64| median(&spent.iter().map(of).collect::<Vec<_>>());
        Row {
            what: task.what,
            who: task.who,
            cpu_s: middle(|s| s.cpu_s),
            wall_s: middle(|s| s.wall_s),
            note: task.note,
        }
    };
    let mut rows: Vec<Row> = tasks.iter().zip(&spent).map(row).collect();
    rows.extend(long(bench, &folder)?);
    Ok(rows)
}

/// Measures the commands that take a minute, once each.
fn long(bench: &Bench, folder: &Path) -> Result<[Row; 2], String> {
    let reference = |words: &[&str]| {
        let mut command = Command::new(bench.program("reference"));
        command.current_dir(workspace()).args(words);
        child::run(&mut command, folder)
    };
    bench.say(what::EXPECT);
    let expect = reference(&["expect", "--check", "-q"])?;
    bench.say(what::VARY);
    let hidden = folder.join("hidden");
    if hidden.exists() {
        fs::remove_dir_all(&hidden).map_err(|why| format!("{}: {why}", hidden.display()))?;
    }
    let hidden = hidden.to_string_lossy().into_owned();
    let drawn = reference(&["vary", "-q", "--seed", "2026", "--out", &hidden])?;
    let answered = reference(&["expect", "-q", &hidden])?;
    let row = |what, cpu_s, wall_s| Row { what, who: OURS, cpu_s, wall_s, note: None };
    Ok([
        row(what::EXPECT, expect.cpu_s, expect.wall_s),
        row(what::VARY, drawn.cpu_s + answered.cpu_s, drawn.wall_s + answered.wall_s),
    ])
}

fn tasks(bench: &Bench, folder: &Path) -> Result<Vec<Task>, String> {
    let task =
        |what, who, command, codes, n_runs| Task { what, who, command, codes, n_runs, note: None };
    let mut render = Command::new(bench.program("reference"));
    render.current_dir(workspace()).args(["render", CASE, "-q", "-o"]).arg(folder.join("case.png"));
    let mut tasks = vec![task(what::CASE, OURS, render, &[0][..], N_SHORT)];
    let [base, same, other] = pictures(bench, folder, SIDE, SIDE)?;
    let [small, _, small_other] = pictures(bench, folder, 320, 240)?;
    let ours = |a: &Path, b: &Path| with(bench.program("grader"), &["compare"], a, b, folder);
    let odiff = |a: &Path, b: &Path| with(bench.peers.join("odiff"), &[], a, b, folder);
    let dify = |a: &Path, b: &Path| {
        with(bench.peers.join("dify/bin/dify"), &["-o", "dify.png"], a, b, folder)
    };
    // The exit code of dify is the number of different pixels, cut to a byte.
    let (odiff_codes, dify_codes) = (&[0, 21, 22][..], &[][..]);
    for (what, a, b, n_runs) in [
        (what::EQUAL, &base, &same, 2),
        (what::DIFFERENT, &base, &other, 2),
        (what::PAIR, &small, &small_other, N_SHORT),
    ] {
        tasks.push(task(what, OURS, ours(a, b), &[0, 1], n_runs));
        tasks.push(task(what, "ODiff", odiff(a, b), odiff_codes, n_runs));
        let writes = (what != what::EQUAL)
            .then_some("writes a picture of the difference, which cannot be switched off");
        tasks.push(Task { note: writes, ..task(what, "dify", dify(a, b), dify_codes, n_runs) });
    }
    Ok(tasks)
}

fn with(program: PathBuf, words: &[&str], a: &Path, b: &Path, folder: &Path) -> Command {
    let mut command = Command::new(program);
    command.args(words).arg(a).arg(b).current_dir(folder);
    command
}

/// Writes three pictures of `width` × `height` pixels, and returns their paths. The first is tiled
/// from a rendered one, the second is a copy of it, and in the third every thousandth pixel is
/// inverted.
fn pictures(bench: &Bench, folder: &Path, width: u32, height: u32) -> Result<[PathBuf; 3], String> {
    let paths = ["base", "same", "other"].map(|name| folder.join(format!("{name}_{width}.png")));
    let [base, same, other] = &paths;
    let tile = folder.join("tile.png");
    let mut render = Command::new(bench.program("reference"));
    render
        .arg("render")
        .arg(bench.scenes.join("whitted.toml"))
        .args(["-q", "--size", "256x192", "-o"])
        .arg(&tile);
    child::run(&mut render, folder)?;
    let wrong = |path: &Path, why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let bytes = fs::read(&tile).map_err(|why| wrong(&tile, &why))?;
    let tile = film::read_exact(&bytes, 256, 192).map_err(|why| wrong(&tile, &why))?;
    let put = |path: &Path, image: &Image| {
        let bytes = film::encode(Kind::Png, image).map_err(|why| wrong(path, &why))?;
        fs::write(path, bytes).map_err(|why| wrong(path, &why))
    };
    let picture = Image::from_fn(width, height, |i, j| tile.pixel(i % 256, j % 192));
    put(base, &picture)?;
    put(same, &picture)?;
    let is_other =
        |i: u32, j: u32| (u64::from(j) * u64::from(width) + u64::from(i)).is_multiple_of(1000);
    put(
        other,
        &Image::from_fn(width, height, |i, j| {
            if is_other(i, j) { DVec3::ONE - picture.pixel(i, j) } else { picture.pixel(i, j) }
        }),
    )?;
    Ok(paths)
}

/// Returns the row of a program and its task, if it was measured.
pub fn find<'a>(rows: &'a [Row], what: &str, who: &str) -> Option<&'a Row> {
    rows.iter().find(|row| row.what == what && row.who == who)
}
