//! Measures whole scenes with all renderers.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use cases::Scene;
use serde::Serialize;

use super::bench::Bench;
use super::renderers::{Renderer, Took};
use super::series::{median, times_as_fast};
use super::{child, rays};

/// The names of the files of the scenes.
pub const SCENES: [&str; 5] = ["whitted", "spheres", "mesh_82k", "mesh_1m", "glass"];

/// The number of threads of a whole process.
pub const WHOLE_THREADS: usize = 2;

/// A renderer and a scene, with medians over the rounds.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The scene, one of [`SCENES`].
    pub scene: String,
    /// The name of the renderer for people.
    pub renderer: &'static str,
    /// The precision of its arithmetic.
    pub precision: &'static str,
    /// The CPU seconds of rendering alone, on one thread.
    pub render_s: f64,
    /// The seconds of reading the scene.
    pub read_s: Option<f64>,
    /// The wall time in seconds from start to picture on disk, on [`WHOLE_THREADS`]. `None` for a
    /// renderer that renders several times in a process.
    pub whole_s: Option<f64>,
    /// The number of eye rays, shadow rays, reflected rays and refracted rays.
    pub rays: Option<[u64; 4]>,
    /// True if the renderer counts its rays itself; otherwise they are derived from its algorithm.
    pub is_counted: bool,
    /// The reason why the renderer does less work than we do, if it does.
    pub easier: Option<&'static str>,
    /// The factor by which we render faster.
    pub times: Option<f64>,
    /// The factor by which our whole process is faster.
    pub whole_times: Option<f64>,
}

/// The results of one renderer in all rounds.
#[derive(Default)]
struct Rounds {
    one: Vec<Took>,
    whole_s: Vec<f64>,
}

/// Renders every scene with every renderer, round by round, ours first.
///
/// # Errors
/// Returns an error if a scene cannot be read, or a renderer is missing or fails.
pub fn measure(bench: &Bench) -> Result<Vec<Row>, String> {
    let mut rows = vec![];
    for name in SCENES {
        let path = bench.scenes.join(format!("{name}.toml"));
        let scene = cases::stage::load_scene(&path, &cases::Course::default())
            .map_err(|why| why.to_string())?;
        let mut rounds: BTreeMap<Renderer, Rounds> = BTreeMap::new();
        let asked: Vec<Renderer> =
            Renderer::ALL.into_iter().filter(|renderer| renderer.is_run(&scene)).collect();
        asked.iter().try_for_each(|renderer| put(bench, name, *renderer, &scene))?;
        for round in 0..bench.n_rounds {
            for renderer in asked.iter().copied() {
                bench.say(&format!("{name}, round {}: {}", round + 1, renderer.name()));
                let folder = bench.folder(name, renderer.name());
                let of = rounds.entry(renderer).or_default();
                of.one.push(renderer.render(&bench.peers, &path, &folder, 1)?);
                of.whole_s.extend(whole_s(bench, renderer, &path, &folder)?);
            }
        }
        rows.extend(table(name, &scene, &rounds));
    }
    Ok(rows)
}

/// Writes the scene in the renderer's own format.
fn put(bench: &Bench, name: &str, renderer: Renderer, scene: &Scene) -> Result<(), String> {
    let folder = bench.folder(name, renderer.name());
    let wrong = |why: std::io::Error| format!("{}: {why}", folder.display());
    fs::create_dir_all(&folder).map_err(wrong)?;
    renderer
        .export(scene)?
        .into_iter()
        .try_for_each(|(file, bytes)| fs::write(folder.join(file), bytes))
        .map_err(wrong)
}

/// Returns the wall time in seconds of a process that makes one picture. `None` for Mitsuba.
fn whole_s(
    bench: &Bench,
    renderer: Renderer,
    scene: &Path,
    folder: &Path,
) -> Result<Option<f64>, String> {
    match renderer {
        Renderer::Ours => {
            let mut command = Command::new(bench.program("reference"));
            command.arg("render").arg(scene).args([
                "-q",
                "-o",
                "out.png",
                "--threads",
                &WHOLE_THREADS.to_string(),
            ]);
            child::run(command.current_dir(folder), folder).map(|spent| Some(spent.wall_s))
        }
        Renderer::Pov | Renderer::Tachyon => renderer
            .render(&bench.peers, scene, folder, WHOLE_THREADS)
            .map(|took| Some(took.spent.wall_s)),
        Renderer::MitsubaLlvm | Renderer::MitsubaScalar => Ok(None),
    }
}

fn table(name: &str, scene: &Scene, rounds: &BTreeMap<Renderer, Rounds>) -> Vec<Row> {
    let ours = &rounds[&Renderer::Ours];
    let own_rays = ours.one[0].rays;
    let [own_s, own_whole_s] = [render_s(ours), median(&ours.whole_s)];
    let row = |(renderer, of): (&Renderer, &Rounds)| {
        let easier = renderer.easier(scene);
        let counted = of.one[0].rays;
        let rays = counted
            .or_else(|| if easier.is_none() { derived(*renderer, scene, own_rays) } else { None });
        let both = own_rays.zip(rays).map(|(a, b)| (a.iter().sum(), b.iter().sum()));
        let is_peer = *renderer != Renderer::Ours;
        let read: Vec<f64> = of.one.iter().filter_map(|took| took.read_s).collect();
        Row {
            scene: name.to_owned(),
            renderer: renderer.name(),
            precision: renderer.precision(),
            render_s: render_s(of),
            read_s: (!read.is_empty()).then(|| median(&read)),
            whole_s: (!of.whole_s.is_empty()).then(|| median(&of.whole_s)),
            rays,
            is_counted: counted.is_some(),
            easier,
            times: is_peer.then(|| times_as_fast(own_s, render_s(of), both)),
            whole_times: (is_peer && !of.whole_s.is_empty())
                .then(|| times_as_fast(own_whole_s, median(&of.whole_s), None)),
        }
    };
    rounds.iter().map(row).collect()
}

fn render_s(of: &Rounds) -> f64 {
    median(&of.one.iter().map(|took| took.render_s).collect::<Vec<_>>())
}

/// Returns the number of rays of a renderer that does not count them, on a scene without mirrors
/// and glass. Tachyon casts a shadow ray if a light is in front of the surface, as we do. Mitsuba
/// casts one to each light, wherever it is.
fn derived(renderer: Renderer, scene: &Scene, ours: Option<[u64; 4]>) -> Option<[u64; 4]> {
    match renderer {
        Renderer::MitsubaLlvm | Renderer::MitsubaScalar => {
            let n_eye = u64::from(scene.render.width) * u64::from(scene.render.height);
            Some([n_eye, rays::n_hits(scene) * scene.lights.len() as u64, 0, 0])
        }
        _ => ours,
    }
}
