//! What an effect costs where a scene does not call for it: the scene rendered by a kernel that could and by one that cannot.

use cases::Effects;
use reference::render::{Options, render_by};
use reference::rules::Rules;
use reference::world::World;
use rustix::time::{ClockId, clock_gettime};
use serde::Serialize;

use super::bench::Bench;
use super::series::median;

/// Scenes that call for few effects.
const SCENES: [&str; 2] = ["mesh_82k", "spheres"];

/// A scene: medians over the rounds, one thread.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Its name.
    pub scene: &'static str,
    /// What it calls for.
    pub called_for: String,
    /// CPU seconds with the effects that it calls for.
    pub own_s: f64,
    /// CPU seconds with every effect there is.
    pub all_s: f64,
    /// Rays either way; the same, since what is not in the scene casts none.
    pub n_rays: [u64; 2],
}

/// Renders each scene both ways, in turn.
///
/// # Errors
/// A scene that cannot be read.
pub fn measure(bench: &Bench) -> Result<Vec<Row>, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|why| why.to_string())?;
    let mut rows = vec![];
    for name in SCENES {
        let path = bench.scenes.join(format!("{name}.toml"));
        let scene = cases::scene::load(&path).map_err(|why| why.to_string())?;
        bench.say(&format!("{name} with every effect and with its own"));
        let world = World::<f64>::new(&scene);
        let both = [Options::of(&world), Options { effects: Effects::all(), ..Options::of(&world) }];
        let (mut times, mut n_rays) = ([vec![], vec![]], [0; 2]);
        // the first round warms up
        for round in 0..=4 * bench.n_rounds {
            for (k, options) in both.iter().enumerate() {
                let begun = cpu_s();
                let (_, stats) = pool.install(|| render_by(&world, &Rules::LECTURE, options, |_| {}));
                n_rays[k] = stats.rays.total();
                if round > 0 {
                    times[k].push(cpu_s() - begun);
                }
            }
        }
        let called_for = scene.effects.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(", ");
        rows.push(Row { scene: name, called_for, own_s: median(&times[0]), all_s: median(&times[1]), n_rays });
    }
    Ok(rows)
}

fn cpu_s() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}
