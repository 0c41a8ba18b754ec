//! Our own side of the measurements, which runs as a separate process like every peer and prints
//! JSON.

use std::fs;
use std::path::Path;
use std::time::Instant;

use cases::Scene;
use reference::rays::ray::Ray;
use reference::rules::{Lecture, Rules};
use reference::trace::render::{Options, render_by};
use reference::world::World;
use reference::world::packet;
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};

use super::rays::{self, Set};
use super::scenes;

/// Runs the job in `words`, and returns its results. Jobs are `render SCENE THREADS`,
/// `search MESH RAYS ANSWERS PASSES`, and `search-together` with the arguments of `search`.
///
/// # Errors
/// Returns an error if the job is unknown, or if a file cannot be read or written.
pub fn work(words: &[String]) -> Result<Value, String> {
    match words {
        [job, scene, threads] if job == "render" => render(Path::new(scene), number(threads)?),
        [job, mesh, rays, answers, passes] if job == "search" || job == "search-together" => {
            let by_packets = job == "search-together";
            search(
                Path::new(mesh),
                Path::new(rays),
                Path::new(answers),
                number(passes)?,
                by_packets,
            )
        }
        _ => Err(format!("there is no job `{}`", words.join(" "))),
    }
}

fn number(word: &str) -> Result<usize, String> {
    word.parse().map_err(|why| format!("{word}: {why}"))
}

/// Returns the CPU seconds of this process so far, over all threads.
fn cpu_s() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

/// Returns the result of `work`, and its CPU seconds.
fn timed<A>(work: impl FnOnce() -> A) -> (A, f64) {
    let begun = cpu_s();
    let result = work();
    (result, cpu_s() - begun)
}

/// Renders one picture like `reference render`, and returns the times of reading, preparing and
/// rendering.
fn render(path: &Path, threads: usize) -> Result<Value, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|why| why.to_string())?;
    let (scene, read_s) = timed(|| load(path));
    let scene = scene?;
    let (world, prepare_s) = timed(|| pool.install(|| World::<f64>::new(&scene)));
    let begun = Instant::now();
    let ((_, stats), render_cpu_s) =
        timed(|| pool.install(|| render_by(&world, &Rules::LECTURE, &Options::of(&world), |_| {})));
    let render_wall_s = begun.elapsed().as_secs_f64();
    let bytes = world.bytes();
    let rays = stats.rays;
    Ok(json!({
        "read_s": read_s, "prepare_s": prepare_s, "render_cpu_s": render_cpu_s,
        "render_wall_s": render_wall_s,
        "bytes": bytes, "eye": rays.eye, "shadow": rays.shadow,
        "reflected": rays.reflected, "refracted": rays.refracted,
    }))
}

fn load(path: &Path) -> Result<Scene, String> {
    cases::stage::load_scene(path, &cases::Course::default()).map_err(|why| why.to_string())
}

/// Returns a scene with only the mesh of that file, untransformed.
fn mesh_alone(path: &Path) -> Result<Scene, String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let text = format!(
        "[render]\nsize = [1, 1]\n[scene.camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n\
            up = [0, 1, 0]\nfov_y_deg = 40\n\
         [scene.materials]\nstone = {{}}\n[[scene.objects]]\nmesh = {{ file = {name:?} }}\n\
         material = \"stone\"\n"
    );
    let folder = path.parent().unwrap_or(Path::new("."));
    cases::scene::parse(&name, &text, folder, &cases::Course::default())
        .map_err(|why| why.to_string())
}

/// Traces the rays one at a time on one thread, and the primary rays in packets if `by_packets`.
/// The first pass over each set warms up and is not counted.
fn search(
    mesh: &Path,
    from: &Path,
    to: &Path,
    n_passes: usize,
    by_packets: bool,
) -> Result<Value, String> {
    let wrong = |path: &Path, why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let bytes = fs::read(from).map_err(|why| wrong(from, &why))?;
    let sets = rays::decode(&bytes).ok_or_else(|| wrong(from, &"not a file of rays"))?;
    let (scene, read_s) = timed(|| mesh_alone(mesh));
    let scene = scene?;
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|why| why.to_string())?;
    let (world, build_s) = timed(|| pool.install(|| World::<f64>::new(&scene)));
    let blocks = rays::in_blocks(scenes::SIZE);
    let (mut all, mut seconds) = (vec![], vec![]);
    for set in &sets {
        let rays: Vec<Ray<f64>> = set.rays.iter().map(rays::ray).collect();
        let mut answers = vec![0.0; rays.len()];
        let mut asked = || match by_packets && set.name == rays::NAMES[0] {
            true => trace_packets(&world, &blocks, &rays, &mut answers),
            false => trace_single(&world, set, &rays, &mut answers),
        };
        let times: Vec<f64> = (0..=n_passes).map(|_| timed(&mut asked).1).collect();
        seconds.push(times[1..].to_vec());
        all.extend(answers.iter().flat_map(|t| t.to_le_bytes()));
    }
    fs::write(to, all).map_err(|why| wrong(to, &why))?;
    Ok(json!({ "read_s": read_s, "build_s": build_s, "bytes": world.bytes(), "seconds": seconds }))
}

/// Traces a set, and writes the answers in the form that [`rays::n_different`] compares.
fn trace_single(world: &World<f64>, set: &Set, rays: &[Ray<f64>], answers: &mut [f32]) {
    for (ray, answer) in rays.iter().zip(answers) {
        *answer = match set.is_any_hit {
            true if world.occluded(Lecture, ray, &mut ()) => 0.0,
            true => f32::INFINITY,
            false => {
                world.first(Lecture, ray, &mut ()).map_or(f32::INFINITY, |(_, hit)| hit.t as f32)
            }
        };
    }
}

/// Traces the primary rays of a picture by packets, and writes the answers like [`trace_single`].
fn trace_packets(world: &World<f64>, blocks: &[usize], rays: &[Ray<f64>], answers: &mut [f32]) {
    for places in blocks.as_chunks::<{ packet::MOST }>().0 {
        let rays = places.map(|place| rays[place]);
        for (place, found) in places.iter().zip(world.first_of_packet(&rays, &mut ())) {
            answers[*place] = found.map_or(f32::INFINITY, |(_, hit)| hit.t as f32);
        }
    }
}
