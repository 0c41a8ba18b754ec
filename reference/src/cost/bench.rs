//! A scene made ready once for every setting.

use cases::film::Image;
use cases::{Effect, Effects, Scene, effects};

use super::setting::Setting;
use crate::real::Real;
use crate::render::{self, Options, Stats};
use crate::rules::Rules;
use crate::variations::Precision;
use crate::world::World;

/// The worlds of a scene in both precisions, each made when it is first asked for, and the rules by
/// which it is rendered.
#[derive(Debug)]
pub struct Bench {
    rules: Rules,
    scene: Scene,
    single: Worlds<f32>,
    double: Worlds<f64>,
}

/// Worlds, each with what it keeps of [`OF_THE_SCENE`].
type Worlds<T> = Vec<(Effects, World<T>)>;

/// What belongs to objects and lights: a picture without it is one of another scene.
const OF_THE_SCENE: Effects = Effects::NONE.with(Effect::Transforms).with(Effect::Attenuation);

impl Bench {
    /// Makes `scene` ready, to be rendered by `rules` but for their style.
    pub fn new(scene: &Scene, rules: &Rules) -> Self {
        Self { rules: *rules, scene: scene.clone(), single: Vec::new(), double: Vec::new() }
    }

    /// The rules, in whatever style.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The picture by a setting, and what it took. Runs in the current `rayon` pool.
    pub fn render(&mut self, setting: &Setting) -> (Image, Stats) {
        match setting.precision {
            Precision::F32 => {
                render(ready(&mut self.single, &self.scene, setting.effects), &self.rules, setting)
            }
            Precision::F64 => {
                render(ready(&mut self.double, &self.scene, setting.effects), &self.rules, setting)
            }
        }
    }

    /// Bytes that a setting takes: the scene made ready for rays, and the picture in the scalars it
    /// is computed with.
    pub fn bytes(&mut self, setting: &Setting) -> usize {
        let n_pixels = self.scene.render.width as usize * self.scene.render.height as usize;
        match setting.precision {
            Precision::F32 => {
                ready(&mut self.single, &self.scene, setting.effects).bytes()
                    + n_pixels * 3 * size_of::<f32>()
            }
            Precision::F64 => {
                ready(&mut self.double, &self.scene, setting.effects).bytes()
                    + n_pixels * 3 * size_of::<f64>()
            }
        }
    }
}

/// The world of `scene` without the matrices or the attenuation that it calls for and `effects`
/// does not have.
fn ready<'a, T: Real>(
    worlds: &'a mut Worlds<T>,
    scene: &Scene,
    effects: Effects,
) -> &'a mut World<T> {
    let is_left_out = |effect: &Effect| scene.effects.has(*effect) && !effects.has(*effect);
    let kept: Effects = OF_THE_SCENE.iter().filter(|effect| !is_left_out(effect)).collect();
    let at = worlds.iter().position(|(of, _)| *of == kept).unwrap_or_else(|| {
        let mut scene = scene.clone();
        effects::simulate_only(&mut scene, kept);
        worlds.push((kept, World::new(&scene)));
        worlds.len() - 1
    });
    &mut worlds[at].1
}

fn render<T: Real>(world: &mut World<T>, rules: &Rules, setting: &Setting) -> (Image, Stats) {
    world.render.max_depth = setting.max_depth;
    world.render.threshold = setting.threshold;
    let options =
        Options { effects: setting.simulated(), samples: setting.samples, ..Options::of(world) };
    render::render_by(world, &setting.formula.rules(rules), &options, |_| {})
}
