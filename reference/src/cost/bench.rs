//! A scene that is prepared once for all settings.

use cases::film::Image;
use cases::{Effect, Effects, Scene, effects};

use super::setting::Setting;
use crate::expect::variations::Precision;
use crate::numbers::real::Real;
use crate::rules::Rules;
use crate::trace::render::{self, Options, Stats};
use crate::world::{Search, World};

/// The worlds of a scene in both precisions, each built at its first use, and the rules by which
/// the scene is rendered.
#[derive(Debug)]
pub struct Bench {
    rules: Rules,
    scene: Scene,
    single: Worlds<f32>,
    double: Worlds<f64>,
}

/// Worlds, each with the effects of [`OF_THE_SCENE`] that it keeps, and whether it has trees.
type Worlds<T> = Vec<((Effects, bool), World<T>)>;

/// The effects that are properties of objects and lights. A picture without one of them shows
/// another scene, so it needs a world of its own.
const OF_THE_SCENE: Effects = Effects::NONE.with(Effect::Transforms).with(Effect::Attenuation);

impl Bench {
    /// Prepares `scene`. It is rendered by `rules`, except for their style, which each setting
    /// chooses.
    pub fn new(scene: &Scene, rules: &Rules) -> Self {
        Self { rules: *rules, scene: scene.clone(), single: Vec::new(), double: Vec::new() }
    }

    /// Returns the rules. Their style is irrelevant.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// Returns the picture by a setting, and the statistics of its rays. Runs in the current
    /// `rayon` pool.
    pub fn render(&mut self, setting: &Setting) -> (Image, Stats) {
        match setting.precision {
            Precision::F32 => {
                render(ready(&mut self.single, &self.scene, setting), &self.rules, setting)
            }
            Precision::F64 => {
                render(ready(&mut self.double, &self.scene, setting), &self.rules, setting)
            }
        }
    }

    /// Returns the bytes that a setting takes: the world that rays search, and the picture in the
    /// scalars of the setting.
    pub fn bytes(&mut self, setting: &Setting) -> usize {
        let n_pixels = self.scene.render.width as usize * self.scene.render.height as usize;
        match setting.precision {
            Precision::F32 => {
                ready(&mut self.single, &self.scene, setting).bytes()
                    + n_pixels * 3 * size_of::<f32>()
            }
            Precision::F64 => {
                ready(&mut self.double, &self.scene, setting).bytes()
                    + n_pixels * 3 * size_of::<f64>()
            }
        }
    }
}

/// Returns the world of `scene` for a setting, built at the first call. Transforms and attenuation
/// that the scene calls for are left out if the setting lacks them.
fn ready<'a, T: Real>(
    worlds: &'a mut Worlds<T>,
    scene: &Scene,
    setting: &Setting,
) -> &'a mut World<T> {
    let Setting { effects, trees, .. } = *setting;
    let is_left_out = |effect: &Effect| scene.effects.has(*effect) && !effects.has(*effect);
    let kept: Effects = OF_THE_SCENE.iter().filter(|effect| !is_left_out(effect)).collect();
    let at = worlds.iter().position(|(of, _)| *of == (kept, trees)).unwrap_or_else(|| {
        let mut scene = scene.clone();
        effects::simulate_only(&mut scene, kept);
        let search = if trees { Search::Tree } else { Search::Scan };
        worlds.push(((kept, trees), World::with_search(&scene, search)));
        worlds.len() - 1
    });
    &mut worlds[at].1
}

fn render<T: Real>(world: &mut World<T>, rules: &Rules, setting: &Setting) -> (Image, Stats) {
    world.render.max_depth = setting.max_depth;
    world.render.threshold = setting.threshold;
    let options = Options {
        effects: setting.simulated(),
        samples: setting.samples,
        adaptive: setting.adaptive,
        light_cutoff: setting.light_cutoff,
        ..Options::of(world)
    };
    let rules = setting.formula.rules(rules);
    match setting.alike {
        true => render::render_alike(world, &rules, &options, |_| {}),
        false => render::render_by(world, &rules, &options, |_| {}),
    }
}
