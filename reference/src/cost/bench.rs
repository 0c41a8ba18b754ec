//! A scene made ready once for every setting.

use cases::Scene;
use cases::film::Image;

use super::setting::Setting;
use crate::real::Real;
use crate::render::{self, Options, Stats};
use crate::rules::Rules;
use crate::variations::Precision;
use crate::world::World;

/// The worlds of a scene in both precisions, and the rules by which it is rendered.
#[derive(Debug)]
pub struct Bench {
    rules: Rules,
    single: World<f32>,
    double: World<f64>,
}

impl Bench {
    /// Makes `scene` ready, to be rendered by `rules` but for their style.
    pub fn new(scene: &Scene, rules: &Rules) -> Self {
        Self { rules: *rules, single: World::new(scene), double: World::new(scene) }
    }

    /// The rules, in whatever style.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The picture by a setting, and what it took. Runs in the current `rayon` pool.
    pub fn render(&mut self, setting: &Setting) -> (Image, Stats) {
        match setting.precision {
            Precision::F32 => render(&mut self.single, &self.rules, setting),
            Precision::F64 => render(&mut self.double, &self.rules, setting),
        }
    }

    /// Bytes that a setting takes: the scene made ready for rays, and the picture in the scalars it is computed with.
    pub fn bytes(&self, setting: &Setting) -> usize {
        let n_pixels = self.double.render.width as usize * self.double.render.height as usize;
        match setting.precision {
            Precision::F32 => self.single.bytes() + n_pixels * 3 * size_of::<f32>(),
            Precision::F64 => self.double.bytes() + n_pixels * 3 * size_of::<f64>(),
        }
    }
}

fn render<T: Real>(world: &mut World<T>, rules: &Rules, setting: &Setting) -> (Image, Stats) {
    world.render.max_depth = setting.max_depth;
    world.render.threshold = setting.threshold;
    let options = Options { effects: setting.simulated(), samples: setting.samples, ..Options::of(world) };
    render::render_by(world, &setting.formula.rules(rules), &options, |_| {})
}
