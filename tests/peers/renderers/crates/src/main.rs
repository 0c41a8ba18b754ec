//! Traces rays with other crates on one thread, and prints times and sizes as JSON.
//!
//! ```text
//! crates obvhs|parry3d|bvh MESH.ply RAYS ANSWERS PASSES
//! ```
//!
//! RAYS is the file that the benchmark writes; ANSWERS becomes a float a ray: the distance,
//! anything finite for something in the way of an any-hit ray, infinity for a miss.

mod bvh_crate;
mod input;
mod obvhs_crate;
mod parry_crate;

use input::{Mesh, Set};

/// A library with its tree built.
trait Searcher {
    /// Returns the distance to the nearest hit, or to any hit for an any-hit ray; infinite for a
    /// miss.
    fn trace(&self, ray: &[f32; 7], is_any_hit: bool) -> f32;
    /// Returns the bytes of the tree and what it points to, if the library reports them.
    fn bytes(&self) -> Option<usize>;
}

/// CPU seconds of this process so far.
fn cpu_s() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

/// What a library does with a mesh and rays. One instance a library, so that each search is
/// compiled into its loop.
fn measure<S: Searcher>(
    version: &str,
    build: fn(Mesh) -> S,
    mesh: Mesh,
    sets: &[Set],
    passes: usize,
) -> Vec<f32> {
    let begun = cpu_s();
    let searcher = build(mesh);
    let build_s = cpu_s() - begun;
    let (mut all, mut seconds) = (vec![], vec![]);
    for set in sets {
        let mut answers = vec![f32::INFINITY; set.rays.len()];
        let mut taken = vec![];
        // the first pass warms up
        for pass in 0..=passes {
            let begun = cpu_s();
            for (ray, answer) in set.rays.iter().zip(&mut answers) {
                *answer = searcher.trace(ray, set.is_any_hit);
            }
            if pass > 0 {
                taken.push(cpu_s() - begun);
            }
        }
        seconds.push(taken);
        all.extend(answers);
    }
    let bytes = searcher.bytes().map_or("null".to_owned(), |bytes| bytes.to_string());
    println!(
        "{{\"version\": \"{version}\", \"build_s\": {build_s}, \"bytes\": \
        {bytes}, \"seconds\": {seconds:?}}}"
    );
    all
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [library, mesh, rays, answers, passes] = &arguments[..] else {
        eprintln!("crates obvhs|parry3d|bvh MESH.ply RAYS ANSWERS PASSES");
        std::process::exit(2);
    };
    let (mesh, sets) = (input::mesh(mesh), input::sets(rays));
    let passes = passes.parse().expect("a number of passes");
    let found = match library.as_str() {
        "obvhs" => measure("0.4.0", obvhs_crate::build, mesh, &sets, passes),
        "parry3d" => measure("0.30.2", parry_crate::build, mesh, &sets, passes),
        "bvh" => measure("0.13.0", bvh_crate::build, mesh, &sets, passes),
        other => panic!("no library called {other}"),
    };
    let bytes: Vec<u8> = found.iter().flat_map(|t| t.to_le_bytes()).collect();
    std::fs::write(answers, bytes).expect("answers can be written");
}
